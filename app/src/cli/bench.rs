//! `majorant bench`: efficiency per estimator and scene at equal time.

mod subjects;
mod table;

use super::{Failure, print_line, progress};
use majorant_core::bench::{self, Plan, Row};
use majorant_core::estimator::{self, Entry, REGISTRY};
use majorant_core::session::Budget;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
Every estimator is run on every scene for the same time, repeatedly and in alternation, so that variations of
the machine's speed affect all estimators alike. Scenes are files or embedded scenes; the default is all embedded
scenes. Size, sampler and thread count are those of the scene; --set changes any key.

Errors are measured against a converged reference: the EXR of --reference, reference.exr in the folder of the
scene file if it exists, or a separate run by Uni+NEE MIS without biasing settings, eight times as long as a
trial (--reference-seconds). Errors are corrected for the noise of the reference where it is known. A reference
that shows a different image, has the seed of a trial (render.seed and the following), or has biasing settings is
rejected.

  relMSE       mean over pixels and channels of (I − R)² / (R² + 0.01)
  efficiency   1 / (relMSE · CPU seconds of all threads): twice the efficiency needs half the time
  look-ups     look-ups of the medium for a relMSE of 1: independent of the machine
  speed-up     efficiency relative to the first estimator

Intervals have 95 % confidence, from the scatter of the repeats. A star marks rows in which one run has more
than half of the error: rare bright paths dominate, and the interval is too narrow.

--json prints one line per row: scene, estimator, repeats, threads, spp, wall_seconds, cpu_seconds,
paths_per_second, lookups_per_path, relmse, efficiency, lookups_to_unit_error, speedup (each with mean, lo,
hi), heavy_tailed, reference. --csv prints the same as columns. Non-finite values are null or inf.

Examples:
  majorant bench first-light --seconds 4
  majorant bench assets/oracle/S2/scene.toml --estimators uni-nee-mis,nee --seconds 5 --repeats 8 --json")]
pub(super) struct Arguments {
    /// Scene files, or names of embedded scenes.
    scenes: Vec<String>,
    /// `all`, or comma-separated ids as listed by `majorant estimators`.
    #[arg(long, value_name = "IDS", value_delimiter = ',', default_value = "all")]
    estimators: Vec<String>,
    /// Wall-clock seconds of each run.
    #[arg(long, value_name = "S", value_parser = parse_seconds, default_value = "2")]
    seconds: f64,
    /// Samples per pixel of each run, instead of seconds.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), conflicts_with = "seconds")]
    spp: Option<u64>,
    /// Number of runs per estimator.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(2..))]
    repeats: u32,
    /// Reference image (EXR) that errors are measured against; requires a single scene.
    #[arg(long, value_name = "FILE", conflicts_with = "reference_seconds")]
    reference: Option<PathBuf>,
    /// Seconds of the separate run for the reference.
    #[arg(long, value_name = "S", value_parser = parse_seconds)]
    reference_seconds: Option<f64>,
    /// Number of worker threads; one per core by default.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Set any key of the scenes, as listed by `majorant keys`. Repeatable.
    #[arg(long, value_name = "KEY=VALUE", num_args = 1..)]
    set: Vec<String>,
    /// Print one line of JSON per row.
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print comma-separated values.
    #[arg(long)]
    csv: bool,
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("`{text}` is not a number of seconds"))?;
    if (0.01..=1e6).contains(&seconds) {
        Ok(seconds)
    } else {
        Err(format!("{text} seconds: choose a number from 0.01 to a million"))
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
