//! Command line that reproduces the image of a view exactly.

use super::gather::Shown;
use super::words::quoted;
use crate::scene::{Limits, SceneDoc};
use std::collections::BTreeMap;

/// `majorant render scene.toml …` for the image of a view. `None` if the view lacks a value of the scene,
/// which no option can remove.
pub(super) fn command(view: &Shown<'_>, scene: &SceneDoc) -> Option<String> {
    let (doc, snapshot) = (&view.view.doc, &view.view.snapshot);
    let mut words = vec!["majorant render scene.toml".to_owned()];
    let (scene, own) = (keys(&scene.view_doc(0)?)?, keys(doc)?);
    if scene.keys().any(|key| !own.contains_key(key)) {
        return None;
    }
    for (key, value) in own.iter().filter(|(key, value)| scene.get(*key) != Some(value)) {
        words.push(match key.as_str() {
            "estimator.id" => format!("--estimator {}", doc.estimator.id),
            "render.seed" => format!("--seed {}", doc.render.seed),
            _ => format!("--set {}", quoted(&format!("{key}={value}"))),
        });
    }
    words.push(format!("--spp {} -o {}.exr", snapshot.spp, view.name));
    Some(words.join(" "))
}

/// Every value of a document by its dotted key, without limits.
fn keys(doc: &SceneDoc) -> Option<BTreeMap<String, toml::Value>> {
    let mut doc = doc.clone();
    doc.render.set_limits(Limits::default());
    let mut found = BTreeMap::new();
    flatten(String::new(), toml::Value::try_from(&doc).ok()?, &mut found);
    Some(found)
}

fn flatten(path: String, value: toml::Value, found: &mut BTreeMap<String, toml::Value>) {
    match value {
        toml::Value::Array(media) if path == "media" => {
            let is_only = media.len() == 1;
            for medium in media {
                let name = medium.get("name").and_then(toml::Value::as_str).unwrap_or_default();
                let path = if is_only { "medium".to_owned() } else { format!("media.{name}") };
                flatten(path, medium, found);
            }
        }
        toml::Value::Table(table) => {
            for (key, value) in table {
                let path = if path.is_empty() { key } else { format!("{path}.{key}") };
                flatten(path, value, found);
            }
        }
        value => {
            found.insert(path, value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::report::fixture;
    use crate::compare::report::gather::Gathered;

    #[test]
    fn a_view_is_reproduced_by_its_differences_from_the_scene() {
        let mut experiment = fixture::experiment("A cloud");
        let gathered = Gathered::of(&experiment);
        let commands: Vec<_> = gathered.views.iter().map(|v| command(v, &experiment.doc).unwrap()).collect();
        assert_eq!(commands[0], "majorant render scene.toml --spp 8 -o A-spectral-mis.exr");
        assert!(commands[1].contains("--estimator nee") && commands[1].contains("--seed 1"), "{commands:?}");
        assert!(commands[2].contains("--set medium.majorant.factor=0.5"), "{commands:?}");
        let mut doc = (*experiment.doc).clone();
        doc.estimator.max_depth = Some(2);
        experiment.doc = doc.into();
        assert_eq!(command(&Gathered::of(&experiment).views[1], &experiment.doc), None);
    }
}
