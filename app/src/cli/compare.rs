//! `majorant compare`: which estimator wins on a scene, by how much, and is it true?

mod plan;
mod table;

use super::{Failure, options, print_line, progress, source};
use clap::builder::PossibleValuesParser;
use majorant_core::compare::{self, Experiment, LEAST_SAMPLES, report};
use majorant_core::measure::MEASURES;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
Without --estimators the scene's own comparison is run, or every estimator if it has none. With it, the
estimators are run in that order, each with random numbers of its own (seed, seed + 1, …); the first is
the baseline. The same estimator may be named twice.

--seconds are CPU seconds of path tracing per estimator, all threads together: on 8 cores, 4 estimators
of 20 seconds each take about 10 seconds, and a reference as long as it takes. Nobody is billed for it.

Without a reference every view is held against the mean of the other unbiased views. `agrees` and
`biased` come from the pictures' own noise; a difference that chance makes once in 100 000 is called
biased. That is a finding, not a failure: the exit code is 0.

-o writes pictures and maps (.png), results (.exr, all of them in compare.exr), ranking.csv, curves.csv,
compare.json and scene.toml; --html adds index.html, a page that needs no other file.

--json prints one line per estimator: estimator, label, spp, seconds (CPU), wall_seconds, lookups,
lookups_per_path, relmse, variance, chroma_variance, efficiency (1/(variance·seconds)), speedup,
speedup_ci [lo, hi], bias_z, p, verdict (agrees, biased, undecided), against, declared_bias, seed, mode,
excluded. What is not finite is null.

Examples:
  majorant compare cloud-backlit --estimators spectral-mis,nee --seconds 20 -o report --html
  majorant compare first-light --spp 64 --reference-estimator uni-nee-mis --reference-spp 4096 --json")]
#[command(group(clap::ArgGroup::new("budget").required(true).args(["seconds", "spp"])))]
pub(super) struct Arguments {
    /// A scene file, or the name of an embedded scene.
    scene: String,
    /// Ids that `majorant estimators` lists, with commas between them.
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    estimators: Vec<String>,
    /// CPU seconds of path tracing per estimator.
    #[arg(long, value_name = "S", value_parser = plan::parse_seconds)]
    seconds: Option<f32>,
    /// Samples per pixel per estimator.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(LEAST_SAMPLES..))]
    spp: Option<u64>,
    /// An EXR picture of the same scene that errors are measured against.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["reference_estimator", "reference_spp"])]
    reference: Option<PathBuf>,
    /// Renders the reference, beside the others, with this estimator.
    #[arg(long, value_name = "ID", requires = "reference_spp")]
    reference_estimator: Option<String>,
    /// Samples per pixel of the rendered reference.
    #[arg(long, value_name = "N", requires = "reference_estimator",
          value_parser = clap::value_parser!(u64).range(LEAST_SAMPLES..))]
    reference_spp: Option<u64>,
    /// The estimator, or the view (A, B, …), that speed-ups are relative to.
    #[arg(long, value_name = "ID")]
    baseline: Option<String>,
    /// What every estimator gets as much of while it runs.
    #[arg(long, value_name = "WHAT", value_parser = PossibleValuesParser::new(["time", "samples", "lookups"]))]
    fair: Option<String>,
    /// Image size in pixels.
    #[arg(long, value_name = "WxH", value_parser = options::parse_size)]
    size: Option<[u32; 2]>,
    /// Worker threads; by default one per core.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// The first estimator's random numbers; the others follow.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Sets any key of the scene; `majorant keys` lists them. Repeatable.
    #[arg(long, value_name = "KEY=VALUE", num_args = 1..)]
    set: Vec<String>,
    /// The measure of error that curves and table show beside relMSE.
    #[arg(long, value_name = "ID", value_parser = PossibleValuesParser::new(MEASURES.iter().map(|m| m.id)))]
    measure: Option<String>,
    /// The folder that the report goes into.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Add a page that shows it all, index.html.
    #[arg(long, requires = "output")]
    html: bool,
    /// Print one line of JSON per estimator instead of the table.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = source::load(&arguments.scene)?;
    let doc = plan::plan(&source.doc, arguments)?;
    if let Some(folder) = &arguments.output {
        report::make_folder(folder)?;
    }
    let bar = progress::bar(1000);
    let finished = compare::run(&doc, source.resources, |p| {
        bar.set_position((1000.0 * p.fraction) as u64);
        let spp = p.spp.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
        bar.set_message(format!("{spp} spp"));
    })?;
    bar.finish_and_clear();
    options::print_notes(&finished.notes);
    let experiment = finished.experiment;
    print(&experiment, arguments)?;
    if let Some(folder) = &arguments.output {
        let what = report::Formats {
            page: arguments.html,
            command: Some(plan::command(std::env::args().skip(1), &experiment)),
            notes: finished.notes,
            ..report::Formats::all()
        };
        let files = report::write(&experiment, folder, &what)?;
        if !arguments.json {
            print_line(&format!("\n{} files in {}", files.len(), folder.display()))?;
        }
    }
    Ok(())
}

fn print(experiment: &Experiment, arguments: &Arguments) -> Result<(), Failure> {
    if arguments.json {
        for row in report::rows(experiment) {
            print_line(&serde_json::to_string(&row)?)?;
        }
        return Ok(());
    }
    table::lines(experiment).iter().try_for_each(|line| print_line(line))
}
