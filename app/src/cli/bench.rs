//! `majorant bench`: how much certainty does a second buy, per estimator and scene?

mod subjects;
mod table;

use super::{Failure, print_line, progress};
use majorant_core::bench::{self, Plan, Row};
use majorant_core::estimator::{self, Entry, REGISTRY};
use majorant_core::session::Budget;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
Every estimator is run on every scene for the same time, several times over, estimators taking turns so
that a machine's moods meet all alike. Scenes are files or embedded ones; without any, the embedded scenes
are run. A scene's own size, sampler and thread count hold; --set changes any key.

Errors are measured against a picture that converged before: an EXR by --reference, reference.exr beside the
scene file if there is one, or a run of its own, eight times as long as a trial (--reference-seconds), by
Uni+NEE MIS without any setting that biases. What the reference's own noise adds is subtracted where the noise is
known. A picture of another image, with the seed of a trial (render.seed and those after it), or with settings that bias
is refused.

  relMSE       mean over pixels and channels of (I − R)² / (R² + 0.01)
  efficiency   1 / (relMSE · CPU seconds of all threads): twice as much means half the time
  look-ups     look-ups of the medium to a relMSE of 1: the same whatever the machine
  speed-up     efficiency relative to the first estimator

Intervals are 95 %, from the scatter of the repeats. A star marks errors of which one run has more than
half: rare bright paths decide, and the interval is too narrow.

--json prints one line per row: scene, estimator, repeats, threads, spp, wall_seconds, cpu_seconds,
paths_per_second, lookups_per_path, relmse, efficiency, lookups_to_unit_error, speedup (each with mean, lo,
hi), heavy_tailed, reference. --csv prints the same as columns. What is not finite is null or inf.

Examples:
  majorant bench first-light --seconds 4
  majorant bench assets/oracle/S2/scene.toml --estimators uni-nee-mis,nee --seconds 5 --repeats 8 --json")]
pub(super) struct Arguments {
    /// Scene files, or names of embedded scenes.
    scenes: Vec<String>,
    /// `all`, or ids that `majorant estimators` lists, with commas between them.
    #[arg(long, value_name = "IDS", value_delimiter = ',', default_value = "all")]
    estimators: Vec<String>,
    /// Wall-clock seconds of each run.
    #[arg(long, value_name = "S", value_parser = parse_seconds, default_value = "2")]
    seconds: f64,
    /// Samples per pixel of each run, instead of seconds.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), conflicts_with = "seconds")]
    spp: Option<u64>,
    /// Runs of each estimator.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(2..))]
    repeats: u32,
    /// An EXR picture that errors are measured against; for one scene.
    #[arg(long, value_name = "FILE", conflicts_with = "reference_seconds")]
    reference: Option<PathBuf>,
    /// Seconds of the reference's own run.
    #[arg(long, value_name = "S", value_parser = parse_seconds)]
    reference_seconds: Option<f64>,
    /// Worker threads; by default one per core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Sets any key of the scenes; `majorant keys` lists them. Repeatable.
    #[arg(long, value_name = "KEY=VALUE", num_args = 1..)]
    set: Vec<String>,
    /// Print one line of JSON per row.
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print columns with commas between them.
    #[arg(long)]
    csv: bool,
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("`{text}` is not a number of seconds"))?;
    if (0.01..=1e6).contains(&seconds) {
        Ok(seconds)
    } else {
        Err(format!("{text} seconds: between 0.01 and a million make sense"))
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let budget = arguments.spp.map_or(Budget::Seconds(arguments.seconds), Budget::Samples);
    let plan = Plan {
        subjects: subjects::load(arguments, &estimators(&arguments.estimators)?)?,
        budget,
        repeats: arguments.repeats,
        threads: arguments.threads.map(usize::from),
    };
    let bar = progress::bar(1);
    let mut printed = Ok(());
    if !arguments.json && !arguments.csv {
        print_line(&table::heading())?;
    }
    let rows = bench::run(&plan, |p| {
        bar.set_length(p.of as u64);
        bar.set_position(p.done as u64);
        bar.set_message(p.next.clone());
        if !arguments.csv && printed.is_ok() {
            printed = bar.suspend(|| p.rows.iter().try_for_each(|row| print(row, arguments.json)));
        }
    })?;
    bar.finish_and_clear();
    printed?;
    if arguments.csv {
        return print_line(bench::csv(&rows)?.trim_end());
    }
    if !arguments.json {
        table::notes(&rows).iter().try_for_each(|note| print_line(note))?;
    }
    Ok(())
}

fn print(row: &Row, json: bool) -> Result<(), Failure> {
    if json { print_line(&serde_json::to_string(row)?) } else { print_line(&table::line(row)) }
}

fn estimators(ids: &[String]) -> Result<Vec<&'static Entry>, Failure> {
    if ids.iter().any(|id| id == "all") {
        return Ok(REGISTRY.iter().collect());
    }
    let find = |id: &String| {
        estimator::find(id.trim()).ok_or_else(|| {
            let known: Vec<_> = REGISTRY.iter().map(|e| e.id).collect();
            Failure::Message(format!("`{id}` is not an estimator: choose all, {}", known.join(", ")))
        })
    };
    ids.iter().map(find).collect()
}
