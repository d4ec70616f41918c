//! `majorant contributions`: separation of an image into contributions.

use super::{Failure, print_line, source};
use majorant_core::inspect::Split;
use majorant_core::io::export;
use majorant_core::transport::CancelToken;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
Every path is traced as for the image, and its contributions are sorted by technique, scattering order, number of
null collisions or hero wavelength. The contributions sum to the image; their shares of the variance of one sample,
Cov(contribution, image) / Var(image), sum to one. A contribution with a negative share is bright where the others
are dark.

--json prints one line: by, spp, and parts (the contributions) with name, mean [r,g,b] and variance_share.

`majorant parts` is an alias of this command.")]
pub(super) struct Arguments {
    #[command(flatten)]
    traced: source::Traced,
    /// Criterion: technique, order, nulls or hero.
    #[arg(long, value_name = "WHAT", default_value = "technique", value_parser = parse_split)]
    by: Split,
    /// Samples per pixel.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u64).range(2..))]
    spp: u64,
    /// Directory for a tone-mapped image of each contribution.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
}

fn parse_split(text: &str) -> Result<Split, String> {
    let known: Vec<_> = Split::ALL.iter().map(|split| split.id()).collect();
    let found = Split::ALL.into_iter().find(|split| split.id() == text);
    found.ok_or_else(|| format!("`{text}` is not one of {}", known.join(", ")))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let frozen = arguments.traced.frozen()?;
    let probe = frozen.probe(arguments.spp)?;
    let parts = probe.strategies(arguments.by, 0..arguments.spp, CancelToken::NEVER);
    let Some(parts) = parts else { return Ok(()) };
    let shares = parts.variance_shares(|_, _| true);
    let share = |k: usize| shares.as_ref().map(|s| s[k]);
    if arguments.json {
        let list = parts.layers.iter().enumerate().map(|(k, layer)| {
            serde_json::json!({ "name": layer.name, "mean": layer.whole(), "variance_share": share(k) })
        });
        let list: Vec<_> = list.collect();
        let all = serde_json::json!({ "by": arguments.by.id(), "spp": arguments.spp, "parts": list });
        print_line(&all.to_string())?;
    } else {
        print_line(&format!(
            "{:<16} {:>10} {:>10} {:>10}  {:>8}",
            arguments.by.name(),
            "R",
            "G",
            "B",
            "variance"
        ))?;
        for (k, layer) in parts.layers.iter().enumerate() {
            let [r, g, b] = layer.whole();
            let share = share(k).map_or("–".to_owned(), |s| format!("{:.1} %", 100.0 * s));
            print_line(&format!("{:<16} {r:>10.5} {g:>10.5} {b:>10.5}  {share:>8}", layer.name))?;
        }
    }
    let Some(directory) = &arguments.output else { return Ok(()) };
    std::fs::create_dir_all(directory).map_err(|e| {
        Failure::Message(format!("{}: {e}; choose a writable directory", directory.display()))
    })?;
    for layer in &parts.layers {
        let path = directory.join(format!("{}.png", layer.name.replace(' ', "-")));
        export::write_png_of(&path, &layer.mean, [parts.width, parts.height], &frozen.doc.view)?;
    }
    Ok(())
}
