//! `majorant check`: validation of the estimators.

use super::{Failure, print_line, progress, source};
use majorant_core::check::{self, Answer, Case, Check, Effort, FAMILIES, Report, Row};
use majorant_core::io::embedded;
use majorant_core::scene::Mode;
use majorant_core::transport::CancelToken;
use std::path::Path;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
Without SCENE the built-in cases are checked, against closed forms, quadrature and each other (--list
lists them). A family or a single case can be named: `majorant check furnace half-space/weighted`. The
expected image of your own scene is unknown: all estimators that are unbiased for it are compared with each
other, on a small image of the scene, in about 45 seconds.

One line per scene and estimator: measured and expected mean of the image, the z of their difference, the
largest |z| of any block and channel and its critical value, the bias of the mean that is detected with 95 %
probability, and the verdict. --deep detects a bias of 1 % instead of 3 %, adds the images by independent
renderers, and takes minutes.

--json prints one line: passes, seconds, notes, and rows of scene, estimator, mode, measured, error,
expected, z, worst_z, critical_z, detectable, paths, verdict (agrees, undecided: too
noisy to tell, differs with from, not-finite).

Exit code 1 if anything differs.")]
pub(super) struct Arguments {
    /// Scene files, embedded scenes, or built-in families and cases.
    scenes: Vec<String>,
    /// Run the thorough check, which takes minutes instead of seconds.
    #[arg(long)]
    deep: bool,
    /// Print the result as one line of JSON.
    #[arg(long)]
    json: bool,
    /// List the built-in families and cases.
    #[arg(long, conflicts_with_all = ["scenes", "deep", "json"])]
    list: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        return list();
    }
    let check = plan(arguments)?;
    let bar = progress::bar(check.cases.iter().map(|c| c.estimators().len() as u64).sum());
    let width = check.cases.iter().map(|c| c.name.chars().count()).max().unwrap_or(0);
    let mut printed = Ok(());
    if !arguments.json {
        print_line(&heading(width))?;
    }
    let report = check.run(CancelToken::NEVER, |p| {
        bar.set_position(p.done as u64);
        bar.set_message(format!("{}  {}", p.scene, p.estimator));
        if !arguments.json && printed.is_ok() {
            printed = bar.suspend(|| p.rows.iter().try_for_each(|row| print_line(&line(row, width))));
        }
    })?;
    bar.finish_and_clear();
    printed?;
    // The token is never cancelled, so that there is a report.
    finish(&report.unwrap_or_default(), arguments.json)
}

fn finish(report: &Report, json: bool) -> Result<(), Failure> {
    if json {
        let mut value = serde_json::to_value(report)?;
        value["passes"] = report.passes().into();
        print_line(&value.to_string())?;
    } else {
        for note in &report.notes {
            print_line(&format!("note: {note}"))?;
        }
        let (agree, undecided) = report.agreeing_and_undecided();
        let noisy =
            if undecided > 0 { format!(", {undecided} are too noisy to tell") } else { String::new() };
        print_line(&format!("{agree} of {} agree{noisy}, in {:.1} s", report.rows.len(), report.seconds))?;
    }
    let failures: Vec<_> = report.failures().map(|r| format!("{} {}", r.scene, r.estimator)).collect();
    if failures.is_empty() {
        return Ok(());
    }
    Err(Failure::Message(format!("not the expected image: {}", failures.join(", "))))
}

/// Creates the check that the arguments request, as one family of comparisons.
fn plan(arguments: &Arguments) -> Result<Check, Failure> {
    let effort = if arguments.deep { Effort::DEEP } else { Effort::QUICK };
    if arguments.scenes.is_empty() {
        return Ok(Check { cases: check::built_in(arguments.deep)?, effort });
    }
    let mut cases: Vec<Case> = Vec::new();
    let mut own = 0;
    for name in &arguments.scenes {
        let is_scene = Path::new(name).exists() || embedded::find(name).is_some();
        let built_in = if is_scene { Vec::new() } else { check::named(name)? };
        if built_in.is_empty() {
            let source = match source::load(name) {
                Err(Failure::Message(m)) if !is_scene => {
                    return Err(Failure::Message(format!(
                        "{m}; `majorant check --list` lists built-in cases"
                    )));
                }
                loaded => loaded?,
            };
            if let Some(problem) = majorant_core::estimator::validate(&source.doc).first() {
                return Err(Failure::Message(format!("{name}: {problem}")));
            }
            let case = check::own_scene(name, &source.doc, source.resources);
            own += case.estimators().len();
            cases.push(case);
        } else {
            cases.extend(built_in);
        }
    }
    let effort = if own > 0 { Effort::own_scenes(arguments.deep, own) } else { effort };
    Ok(Check { cases, effort })
}

fn heading(width: usize) -> String {
    format!(
        "{:width$}  {:13} {:8}  {:>10} ± {:<8}  {:>10}  {:>6}  {:>13}  {:>7}  verdict",
        "scene", "estimator", "mode", "measured", "error", "expected", "z", "worst |z|", "detects"
    )
}

fn line(row: &Row, width: usize) -> String {
    let mark = if row.passes() { ' ' } else { '!' };
    let mode = if row.mode == Mode::Rgb { "rgb" } else { "spectral" };
    let sees = if row.detectable < 10.0 { format!("{:.1} %", 100.0 * row.detectable) } else { "–".into() };
    format!(
        "{:width$}  {:13} {mode:8}  {:>10.5} ± {:<8.5}  {:>10.5}  {:>6.2}  {:>5.2} of {:<4.2}  {sees:>7} {mark}{}",
        row.scene,
        row.estimator,
        row.measured,
        row.error,
        row.expected,
        row.z,
        row.worst_z,
        row.critical_z,
        row.verdict
    )
}

fn list() -> Result<(), Failure> {
    for family in FAMILIES {
        let deep = if family.deep_only { " (--deep only)" } else { "" };
        print_line(&format!("{}{deep}: {}", family.id, family.about))?;
        for case in (family.cases)()? {
            let known = matches!(case.answer, Answer::Known(_));
            let against = if known { "a known answer" } else { "each other" };
            print_line(&format!(
                "  {:36} {} estimators against {against}",
                case.name,
                case.estimators().len()
            ))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::check::Verdict;

    fn row(verdict: Verdict) -> Row {
        Row {
            scene: "furnace/thin".into(),
            estimator: "nee",
            mode: Mode::Rgb,
            measured: 1.1,
            error: 0.01,
            expected: 1.0,
            z: 10.0,
            worst_z: 10.0,
            critical_z: 5.0,
            detectable: 0.02,
            paths: 1000,
            verdict,
        }
    }

    #[test]
    fn a_difference_is_an_error_that_names_the_row() {
        let differs = Verdict::Differs { from: vec!["the answer".into()] };
        assert!(line(&row(differs.clone()), 20).ends_with("!differs from the answer"));
        let report = Report { rows: vec![row(Verdict::Agrees), row(differs)], ..Report::default() };
        for json in [false, true] {
            let Err(Failure::Message(message)) = finish(&report, json) else {
                panic!("the check should have failed")
            };
            assert!(message.contains("furnace/thin nee"), "{message}");
        }
        let noisy = Report { rows: vec![row(Verdict::Undecided)], ..Report::default() };
        assert!(finish(&noisy, false).is_ok());
        assert!(line(&row(Verdict::NotFinite { x: 3, y: 4, sample: 5 }), 20).contains("(3, 4), sample 5"));
    }
}
