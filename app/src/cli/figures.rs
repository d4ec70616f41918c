//! `majorant figures`: reproduction of the report's figures, with the study that it leaves to future work.

use super::{Failure, options, print_line, progress};
use clap::builder::PossibleValuesParser;
use majorant_core::compare::LEAST_SAMPLES;
use majorant_core::compare::report::words;
use majorant_core::figures::study::Matrix;
use majorant_core::figures::{self, FIGURES, Figure, Options, OwnVolume, Results, Stage, StudyOptions};
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
Renders the figures of Horešovský's report with its settings and the embedded volumes, and runs the study that
the report leaves open: every estimator at equal time on the scene of every figure, repeatedly, with 95 %
intervals, and a conclusion that is derived from these numbers alone.

The full set takes about eleven minutes on two cores: half of it for references, the rest for the study
(scenes × variants × repeats × seconds). Finished figures are kept when the command is stopped by Ctrl-C.

-o receives a PNG and an EXR of every panel and reference, figureN.png in the layout of the report, index.html
(a self-contained page), figures.json with all results, and figures.csv, study.csv, answers.csv.

--volume replaces the embedded plume (figures 1 and 2) or cloud (figure 3) by OpenVDB's smoke and bunny cloud,
or by any density, with the same placement, length and optical thickness. `smoke=` and `bunny=` are synonyms
of `plume=` and `cloud=`.

Examples:
  majorant figures all -o report
  majorant figures 3 -o report --volume bunny=bunny_cloud.vdb --volume smoke=smoke.vdb
  majorant figures 2 4 -o report --size 512x512 --seconds 4 --repeats 8")]
pub(super) struct Arguments {
    /// Figures of the report to render, or `all`.
    #[arg(required = true, value_name = "FIGURE", value_parser = figure_names())]
    figures: Vec<String>,
    /// Output folder.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Density that replaces an embedded one: `plume=FILE` or `smoke=FILE`, `cloud=FILE` or `bunny=FILE`, or
    /// FILE for both. Repeatable.
    #[arg(long, value_name = "FILE", value_parser = parse_volume)]
    volume: Vec<OwnVolume>,
    /// Samples per pixel of the panels.
    #[arg(long, value_name = "N", default_value_t = 64,
          value_parser = clap::value_parser!(u64).range(LEAST_SAMPLES..))]
    spp: u64,
    /// Samples per pixel of the references.
    #[arg(long, value_name = "N", default_value_t = 1024,
          value_parser = clap::value_parser!(u64).range(LEAST_SAMPLES..))]
    reference_spp: u64,
    /// Size of every image in pixels; a fraction of the scene's size by default.
    #[arg(long, value_name = "WxH", value_parser = options::parse_size)]
    size: Option<[u32; 2]>,
    /// Number of worker threads; one per core by default.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Wall-clock seconds of each run of the study; 0 skips the study.
    #[arg(long, value_name = "S", default_value = "1", value_parser = parse_seconds)]
    seconds: f64,
    /// Number of runs per variant of the study.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(2..))]
    repeats: u32,
}

fn figure_names() -> PossibleValuesParser {
    PossibleValuesParser::new(FIGURES.iter().map(|figure| figure.id).chain(["all"]))
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("`{text}` is not a number of seconds"))?;
    if seconds == 0.0 || (0.01..=1e6).contains(&seconds) {
        Ok(seconds)
    } else {
        Err(format!("{text} seconds: choose 0, or a number from 0.01 to a million"))
    }
}

fn parse_volume(text: &str) -> Result<OwnVolume, String> {
    let (stage, file) = match text.split_once('=') {
        Some(("plume" | "smoke", file)) => (Some(Stage::Plume), file),
        Some(("cloud" | "bunny", file)) => (Some(Stage::Cloud), file),
        _ => (None, text),
    };
    if file.is_empty() {
        return Err("the file name is missing: write plume=FILE, cloud=FILE or FILE".into());
    }
    // An absolute path, so that written scenes can be opened from any directory.
    let file = std::path::absolute(file).map_err(|e| e.to_string())?;
    Ok(OwnVolume { stage, file })
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let wanted = |figure: &&Figure| arguments.figures.iter().any(|name| name == figure.id || name == "all");
    let chosen: Vec<&'static Figure> = FIGURES.iter().filter(wanted).collect();
    let command = std::env::args().skip(1).map(|word| words::quoted(&word)).collect::<Vec<_>>();
    let options = Options {
        spp: arguments.spp,
        reference_spp: arguments.reference_spp,
        size: arguments.size,
        threads: arguments.threads.map(usize::from),
        volumes: arguments.volume.clone(),
        study: (arguments.seconds > 0.0)
            .then_some(StudyOptions { seconds: arguments.seconds, repeats: arguments.repeats }),
        command: Some(format!("majorant {}", command.join(" "))),
    };
    let bar = progress::bar(1000);
    let results = figures::run(&chosen, &options, &arguments.output, |p| {
        bar.set_position((1000.0 * p.fraction) as u64);
        bar.set_message(p.doing.clone());
    })?;
    bar.finish_and_clear();
    options::print_notes(&results.notes());
    print(&results)?;
    let (files, folder) = (results.files.len(), arguments.output.display());
    print_line(&format!("\n{files} files in {folder}, after {:.0} s", results.seconds))
}

fn print(results: &Results) -> Result<(), Failure> {
    for numbers in results.rows().flat_map(|rendered| rendered.numbers()) {
        print_line(&format!(
            "{:13}  {:22}  {:>5} spp  {:>7} CPU s  relMSE {}",
            numbers.strip,
            numbers.panel,
            numbers.row.spp,
            words::number(numbers.row.seconds),
            words::quantity(numbers.row.relmse.unwrap_or(f64::NAN), numbers.relmse_error)
        ))?;
    }
    if !results.studies.is_empty() {
        matrix(&Matrix::of(&results.studies))?;
    }
    results.conclusion().iter().try_for_each(|paragraph| print_line(&format!("\n{paragraph}")))
}

/// Prints the ratios of the study, one line per question.
fn matrix(matrix: &Matrix) -> Result<(), Failure> {
    let line = |question: &str, by: &str, cells: &[&str]| {
        let cells: String = cells.iter().map(|cell| format!("  {cell:>19}")).collect();
        print_line(format!("{question:<52}  {by:<16}{cells}").trim_end())
    };
    for (heading, lines) in &matrix.blocks {
        print_line("")?;
        line(heading, "", &matrix.scenes)?;
        for asked in lines {
            let cells: Vec<&str> =
                asked.cells.iter().map(|cell| cell.as_ref().map_or("–", |(ratio, _)| ratio)).collect();
            line(&format!("{} : {}", asked.variant, asked.against), asked.by, &cells)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_volume_argument_has_an_optional_stage() {
        let stage = |text: &str| parse_volume(text).map(|own| own.stage);
        assert_eq!(
            [stage("plume=a.vdb"), stage("smoke=a.vdb")],
            [Ok(Some(Stage::Plume)), Ok(Some(Stage::Plume))]
        );
        assert_eq!(
            [stage("cloud=a.vdb"), stage("bunny=a.vdb")],
            [Ok(Some(Stage::Cloud)), Ok(Some(Stage::Cloud))]
        );
        assert_eq!(stage("a=b.vdb"), Ok(None));
        assert!(
            parse_volume("a=b.vdb").is_ok_and(|own| own.file.is_absolute() && own.file.ends_with("a=b.vdb"))
        );
        assert!(stage("cloud=").is_err());
    }

    #[test]
    fn zero_seconds_skip_the_study() {
        assert_eq!([parse_seconds("0"), parse_seconds("2.5")], [Ok(0.0), Ok(2.5)]);
        assert!(parse_seconds("-1").is_err() && parse_seconds("soon").is_err());
    }
}
