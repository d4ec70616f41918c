//! `majorant compare`: ranking of estimators on a scene, with speed-ups and bias tests.

mod plan;
mod table;

use super::{Failure, options, print_line, progress, source};
use clap::builder::PossibleValuesParser;
use majorant_core::compare::{self, Experiment, LEAST_SAMPLES, report};
use majorant_core::measure::MEASURES;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
Without --estimators the comparison in the scene file is run, or every estimator if there is none. With it, the
estimators are run in that order, each with a different seed (seed, seed + 1, …); the first is the baseline.
An estimator may be named twice.

--seconds are CPU seconds of path tracing per estimator, summed over all threads: on 8 cores, 4 estimators
of 20 seconds each take about 10 seconds. The time for a rendered reference is not charged.

Without a reference every view is compared with the mean of the other unbiased views. `agrees` and `biased`
follow from the noise of the images; a difference with a probability below 1 in 100 000 is called biased.
A bias is a result, not a failure: the exit code is 0.

-o writes images and maps (.png), results (.exr, all of them in compare.exr), ranking.csv, curves.csv,
compare.json and scene.toml; --html adds index.html, a self-contained page.

--json prints one line per estimator: estimator, label, spp, seconds (CPU), wall_seconds, lookups,
lookups_per_path, relmse, variance, chroma_variance, efficiency (1/(variance·seconds)), speedup,
speedup_ci [lo, hi], bias_z, p, verdict (agrees, biased, undecided), against, declared_bias, seed, mode,
excluded. Non-finite values are null.

Examples:
  majorant compare cloud-backlit --estimators spectral-mis,nee --seconds 20 -o report --html
  majorant compare first-light --spp 64 --reference-estimator uni-nee-mis --reference-spp 4096 --json")]
#[command(group(clap::ArgGroup::new("budget").required(true).args(["seconds", "spp"])))]
pub(super) struct Arguments {
    /// A scene file, or the name of an embedded scene.
    scene: String,
    /// Comma-separated ids, as listed by `majorant estimators`.
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    estimators: Vec<String>,
    /// CPU seconds of path tracing per estimator.
    #[arg(long, value_name = "S", value_parser = plan::parse_seconds)]
    seconds: Option<f32>,
    /// Samples per pixel per estimator.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(LEAST_SAMPLES..))]
    spp: Option<u64>,
    /// Reference image (EXR) of the same scene that errors are measured against.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["reference_estimator", "reference_spp"])]
    reference: Option<PathBuf>,
    /// Render the reference with this estimator, along with the views.
    #[arg(long, value_name = "ID", requires = "reference_spp")]
    reference_estimator: Option<String>,
    /// Samples per pixel of the rendered reference.
    #[arg(long, value_name = "N", requires = "reference_estimator",
          value_parser = clap::value_parser!(u64).range(LEAST_SAMPLES..))]
    reference_spp: Option<u64>,
    /// Estimator or view (A, B, …) that speed-ups are relative to.
    #[arg(long, value_name = "ID")]
    baseline: Option<String>,
    /// Quantity that all estimators receive equally during the run.
    #[arg(long, value_name = "WHAT", value_parser = PossibleValuesParser::new(["time", "samples", "lookups"]))]
    fair: Option<String>,
    /// Image size in pixels.
    #[arg(long, value_name = "WxH", value_parser = options::parse_size)]
    size: Option<[u32; 2]>,
    /// Number of worker threads; one per core by default.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Seed of the first estimator; the others get the following seeds.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Set any key of the scene, as listed by `majorant keys`. Repeatable.
    #[arg(long, value_name = "KEY=VALUE", num_args = 1..)]
    set: Vec<String>,
    /// Error measure that curves and table show in addition to relMSE.
    #[arg(long, value_name = "ID", value_parser = PossibleValuesParser::new(MEASURES.iter().map(|m| m.id)))]
    measure: Option<String>,
    /// Folder of the report.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Add an HTML page with all results, index.html.
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
