//! `majorant path`: events of one path of an image.

use super::source::Frozen;
use super::{Failure, print_line, source};
use majorant_core::estimator::PathIndex;
use majorant_core::inspect::{Ledger, Row};
use majorant_core::scene::Scene;
use majorant_core::session::Probe;
use majorant_core::spectrum::Carried;
use majorant_core::transport::CancelToken;
use std::fmt::Write;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
The path is traced again with the same random numbers: its estimate equals that of the film bit by bit.
Without --sample the brightest of the first --of samples is chosen.

Each line is an event, with its random numbers (u) and, for the hero, the contribution (f) and the probability
densities of unidirectional sampling (p_uni) and next-event estimation (p_nee) by their definition. Where a
contribution is added: its value for each component, and the value by definition of the balance heuristic.

--json prints one line: pixel, sample, estimator, carried, film, sum, and rows of all components. All numbers of
a row, including the path weights that the estimator stores (kept), are those after the event of the row.")]
pub(super) struct Arguments {
    #[command(flatten)]
    traced: source::Traced,
    /// Column and row of the pixel, from the upper left.
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel)]
    pixel: (u32, u32),
    /// Index of the sample within the pixel.
    #[arg(long, value_name = "N")]
    sample: Option<u64>,
    /// Number of samples among which the brightest is searched.
    #[arg(long, value_name = "N", default_value_t = 64, conflicts_with = "sample")]
    of: u64,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
}

fn parse_pixel(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(',');
    sides
        .and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)))
        .ok_or_else(|| format!("`{text}` is not a pixel: write COLUMN,ROW, e.g. 64,40"))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let frozen = arguments.traced.frozen()?;
    let (x, y) = arguments.pixel;
    let film = &frozen.doc.film;
    if x >= film.width || y >= film.height {
        let size = format!("{} × {}", film.width, film.height);
        return Err(Failure::Message(format!("pixel {x},{y} is outside of the image of {size}")));
    }
    let entry = frozen.entry;
    let samples = arguments.sample.map_or(arguments.of.max(1), |sample| sample.saturating_add(1));
    let probe = frozen.probe(samples)?;
    let sample = arguments.sample.unwrap_or_else(|| brightest(&probe, (x, y), samples));
    let at = PathIndex { x, y, sample };
    let recording = probe.record(at, CancelToken::NEVER);
    let ledger = Ledger::new(&recording);
    if arguments.json {
        return print_line(&json(&ledger, at, (&frozen, probe.scene())).to_string());
    }
    print_line(&format!("{}, pixel {x} {y}, sample {sample}: {}", entry.name, carried(&ledger.carried)))?;
    print_line(&format!(
        "{:>4}  {:<11} {:<24} {:<28} {:<22} {:>11} {:>11} {:>11}",
        "", "", "", "where", "u", "f", "p_uni", "p_nee"
    ))?;
    for (i, row) in ledger.rows.iter().enumerate() {
        print_line(&line(i, row, ledger.carried.count()))?;
    }
    if !recording.complete {
        print_line("  … truncated: the recording ends here, the path does not")?;
    }
    let film = ledger.film;
    print_line(&format!("on the film: {} {} {} (linear sRGB)", film.x, film.y, film.z))
}

fn brightest(probe: &Probe, (x, y): (u32, u32), of: u64) -> u64 {
    let brightness = |sample: u64| probe.path(x, y, sample, CancelToken::NEVER).rgb.element_sum();
    let samples = (0..of).map(|sample| (sample, brightness(sample)));
    samples.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(sample, _)| sample)
}

fn carried(carried: &Carried) -> String {
    match carried {
        Carried::Wavelengths(nm, n) => {
            let nm: Vec<_> = nm[..*n].iter().map(|nm| format!("{nm:.1}")).collect();
            format!("wavelengths {} nm, the hero first", nm.join(", "))
        }
        Carried::Channels(channels, n) => {
            let names = ["red", "green", "blue"];
            let names: Vec<_> = channels[..*n].iter().map(|c| names[*c as usize]).collect();
            format!("channels {}, the hero first", names.join(", "))
        }
        Carried::Grey => "one weight for all channels, as the scene is grey".to_owned(),
    }
}

fn line(i: usize, row: &Row, count: usize) -> String {
    let mut text = String::new();
    let point = row.point.map_or(String::new(), |p| format!("{:.3} {:.3} {:.3}", p.x, p.y, p.z));
    let numbers: Vec<_> = row.numbers.iter().map(|u| format!("{u:.4}")).collect();
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "{i:>4}  {:<11} {:<24} {point:<28} {:<22} {:>11} {:>11} {:>11}",
        row.branch.name(),
        row.step.to_string(),
        numbers.join(" "),
        row.f[0].to_string(),
        row.uni[0].to_string(),
        row.nee[0].to_string(),
    );
    if let Some(contribution) = &row.contribution {
        let values = |values: &[f32; 4]| {
            let values: Vec<_> = values[..count].iter().map(|v| format!("{v:.5}")).collect();
            values.join(" ")
        };
        let _ = write!(text, "  {} adds {}", contribution.technique.name(), values(&contribution.value));
        if let Some(by_definition) = &contribution.by_definition {
            let _ = write!(text, " (by definition {})", values(by_definition));
        }
    }
    text
}

/// Name of the medium of an event, if it has one.
fn medium<'a>(row: &Row, frozen: &'a Frozen, scene: &Scene) -> Option<&'a str> {
    let medium = scene.media.get(row.found?.medium as usize)?;
    frozen.doc.media.get(medium.index).map(|medium| medium.name.as_str())
}

fn json(ledger: &Ledger, at: PathIndex, (frozen, scene): (&Frozen, &Scene)) -> serde_json::Value {
    let count = ledger.carried.count();
    let lanes = |values: &[f32; 4]| values[..count].to_vec();
    let ln = |products: &[majorant_core::inspect::Product; 4]| -> Vec<f64> {
        products[..count].iter().map(|p| p.ln()).collect()
    };
    let rows: Vec<_> = ledger
        .rows
        .iter()
        .map(|row| {
            serde_json::json!({
                "branch": row.branch.name(),
                "event": row.step.to_string(),
                "point": row.point.map(|p| p.to_array()),
                "medium": medium(row, frozen, scene),
                "u": row.numbers,
                "ln_f": ln(&row.f),
                "ln_p_uni": ln(&row.uni),
                "ln_p_nee": ln(&row.nee),
                "kept": row.kept.map(|k| {
                    k.names.iter().zip(&k.values).map(|(name, v)| (*name, lanes(v))).collect::<Vec<_>>()
                }),
                "credit": row.contribution.map(|c| serde_json::json!({
                    "technique": c.technique.name(),
                    "order": c.order,
                    "null_collisions": c.nulls,
                    "value": lanes(&c.value),
                    "by_definition": c.by_definition.map(|v| lanes(&v)),
                    "film": c.film.to_array(),
                })),
            })
        })
        .collect();
    serde_json::json!({
        "pixel": [at.x, at.y],
        "sample": at.sample,
        "estimator": frozen.entry.id,
        "carried": carried(&ledger.carried),
        "film": ledger.film.to_array(),
        "sum": ledger.sum,
        "rows": rows,
    })
}
