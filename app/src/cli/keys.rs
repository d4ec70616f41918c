//! `majorant keys`: list of all keys of a scene file.

use super::{Failure, print_line};
use majorant_core::estimator::REGISTRY;
use majorant_core::measure::MEASURES;
use majorant_core::scene::keys::{self, Key, Registry};

#[derive(clap::Args, Debug)]
#[command(after_help = "\
Lists the keys of scene files and of --set; `*` stands for the index of a list entry, as in
--set lights.0.scale=3. PREFIX limits the list: `majorant keys medium.majorant`.

--json prints one array of objects: path, type, range, unit, default, label, tip, affects (scene, estimate, limits,
view), biases; kind if only some kinds of the table have the key, values if it is a choice, open if ends of the range
are excluded, absent with the meaning of the absence of an optional key, required if the key is mandatory.")]
pub(super) struct Arguments {
    /// Prefix of the listed keys.
    #[arg(default_value = "")]
    prefix: String,
    /// Print one array of JSON objects.
    #[arg(long, conflicts_with = "markdown")]
    json: bool,
    /// Print a Markdown table, without the keys of additional views.
    #[arg(long)]
    markdown: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let chosen = keys::all().iter().copied().filter(|key| key.path.starts_with(&arguments.prefix));
    let chosen: Vec<Key> = chosen.collect();
    if chosen.is_empty() {
        return Err(Failure::Message(format!("no key begins with `{}`", arguments.prefix)));
    }
    if arguments.json {
        let objects: Vec<_> = chosen.iter().map(|key| keys::json(key, &ids)).collect();
        return print_line(&serde_json::to_string_pretty(&objects)?);
    }
    if arguments.markdown {
        return print_line(keys::markdown(&chosen).trim_end());
    }
    let width = chosen.iter().map(|key| key.path.len()).max().unwrap_or(0);
    chosen.iter().try_for_each(|key| print_line(&line(key, width)))
}

/// Ids of the registries outside of the key table.
fn ids(registry: Registry) -> Vec<&'static str> {
    match registry {
        Registry::Estimators => REGISTRY.iter().map(|entry| entry.id).collect(),
        Registry::Measures => MEASURES.iter().map(|measure| measure.id).collect(),
        Registry::Transmittance => Vec::new(),
    }
}

/// Formats a key as one line.
fn line(key: &Key, width: usize) -> String {
    let default = match key.default {
        keys::Default::Is(text) => format!("default {text}"),
        keys::Default::Absent(meaning) => format!("absent: {meaning}"),
        keys::Default::Required => "required".into(),
    };
    let of = if key.kinds.is_empty() { String::new() } else { format!(" of {}", key.kinds.join(", ")) };
    let value = keys::value_in_words(key, &ids);
    let bias = key.biases.map(|bias| format!(" Biases: {}.", bias.when)).unwrap_or_default();
    format!("{:width$}  {value}{of}; {default}; affects {}. {}.{bias}", key.path, key.affects.id(), key.tip)
}
