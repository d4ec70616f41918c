//! Fingerprints of version 0.1: a digest of the whole document as that version wrote it. Images with such a
//! fingerprint are still recognised.
//!
//! Frozen: the hashed keys, and the fixed values of the other keys.

use super::of_bytes;
use crate::io::scene_file;
use crate::medium::Interpolation;
use crate::scene::keys::{Affects, leaves};
use crate::scene::{MajorantDoc, RenderDoc, SceneDoc};
use toml_edit::{DocumentMut, Item, Table, Value};

/// Values that version 0.1 wrote for keys that do not affect the expected image.
const FROZEN: &[(&str, &str)] = &[
    ("title", "\"Untitled\""),
    ("note", "\"\""),
    ("medium.interpolation", "\"trilinear\""),
    ("medium.majorant.factor", "1.0"),
    ("medium.majorant.shared", "false"),
    ("medium.majorant.when_exceeded", "\"weighted\""),
    ("estimator.id", "\"uni-nee-mis\""),
    ("estimator.sampler", "\"independent\""),
    ("estimator.wavelengths", "\"sensor\""),
    ("estimator.distances", "\"delta\""),
    ("estimator.directions", "\"phase\""),
    ("estimator.absorption", "\"weighted\""),
    ("estimator.heuristics.components", "\"balance\""),
    ("estimator.heuristics.techniques", "\"balance\""),
    ("estimator.bookkeeping", "\"rescaled\""),
    ("estimator.tracking", "\"history\""),
    ("estimator.light_walk", "\"fused\""),
    ("estimator.lights", "\"uniform\""),
    ("estimator.light_sampling", "\"emitter\""),
    ("estimator.transmittance", "\"ratio-hero\""),
    ("estimator.roulette_depth", "16"),
    ("render.spp", "1024"),
    ("render.seed", "0"),
    ("view.exposure_ev", "0.0"),
    ("view.tone", "\"filmic\""),
];

/// Keys of version 0.1 that affect the expected image.
const COUNTED: &[&str] = &[
    "majorant",
    "camera.origin",
    "camera.target",
    "camera.up",
    "camera.fov_deg",
    "film.width",
    "film.height",
    "medium.scale",
    "medium.extinction",
    "medium.albedo",
    "medium.coefficients.kind",
    "medium.coefficients.absorption",
    "medium.coefficients.scattering",
    "medium.coefficients.mean_free_path",
    "medium.coefficients.colour",
    "medium.albedo_grid.file",
    "medium.albedo_grid.grid",
    "medium.density.kind",
    "medium.density.file",
    "medium.density.grid",
    "medium.precision",
    "medium.placement.fit",
    "medium.placement.scale",
    "medium.placement.rotate_deg",
    "medium.placement.translate",
    "medium.placement.matrix",
    "medium.phase.kind",
    "medium.phase.g",
    "medium.phase.g_forward",
    "medium.phase.g_backward",
    "medium.phase.forward",
    "medium.phase.alpha",
    "medium.phase.diameter_um",
    "medium.phase.angle",
    "medium.phase.points",
    "medium.phase.file",
    "medium.emission.temperature.file",
    "medium.emission.temperature.grid",
    "medium.emission.kelvin",
    "medium.emission.scale",
    "lights.*.kind",
    "lights.*.center",
    "lights.*.target",
    "lights.*.up",
    "lights.*.size",
    "lights.*.radius",
    "lights.*.toward",
    "lights.*.angular_diameter_deg",
    "lights.*.radiance",
    "lights.*.irradiance",
    "lights.*.file",
    "lights.*.rotate_deg",
    "lights.*.scale",
    "lights.*.visible",
    "objects.*.kind",
    "objects.*.point",
    "objects.*.normal",
    "objects.*.center",
    "objects.*.size",
    "objects.*.rotate_deg",
    "objects.*.albedo",
    "objects.*.material.albedo",
    "estimator.mode",
    "estimator.max_depth",
];

/// Fingerprint in the format of version 0.1; `None` if that version could not have rendered the document.
pub(super) fn of_scene(doc: &SceneDoc, content: impl FnMut(&str) -> String) -> Option<String> {
    let unknown = leaves(doc).ok()?.into_iter().any(|leaf| {
        let key = leaf.key();
        key.affects == Affects::Scene
            && !key.path.starts_with("compare.")
            && !COUNTED.contains(&key.path)
            && !leaf.is_default()
    });
    if unknown || doc.media.len() != 1 {
        return None;
    }
    let mut written: DocumentMut = text_today(doc, content)?.parse().ok()?;
    restored_values(written.as_table_mut(), "")?;
    Some(of_bytes(written.to_string().as_bytes()))
}

/// Text that version 0.1 would have hashed, but with current keys and defaults; `None` unless there is one
/// medium.
fn text_today(doc: &SceneDoc, mut content: impl FnMut(&str) -> String) -> Option<String> {
    // Sections in the order of version 0.1; keys that were not hashed have their values of version 0.1.
    let mut part = SceneDoc {
        camera: doc.camera.clone(),
        film: doc.film.clone(),
        media: vec![doc.medium().clone()],
        lights: doc.lights.clone(),
        objects: doc.objects.clone(),
        render: RenderDoc { spp: Some(1024), ..RenderDoc::default() },
        ..SceneDoc::default()
    };
    part.medium_mut().majorant = MajorantDoc::default();
    part.medium_mut().interpolation = Interpolation::default();
    part.estimator.mode = doc.estimator.mode;
    part.estimator.max_depth = doc.estimator.max_depth;
    for file in part.files_mut() {
        *file = content(file);
    }
    in_format_1(&scene_file::to_toml(&part))
}

/// The text of a scene with one medium in format 1, which has a table `[medium]` without the keys that several
/// media need, and objects with an albedo in place of a material.
fn in_format_1(text: &str) -> Option<String> {
    let mut written: DocumentMut = text.parse().ok()?;
    let media = written.remove("media")?.into_array_of_tables().ok()?;
    let mut medium = media.iter().next()?.clone();
    for key in ["name", "enabled", "within"] {
        medium.remove(key);
    }
    written.insert("medium", Item::Table(medium));
    let objects = written.get_mut("objects").and_then(Item::as_array_of_tables_mut);
    for object in objects.into_iter().flat_map(|objects| objects.iter_mut()) {
        let albedo = object.remove("material")?.as_table_mut()?.remove("albedo")?;
        object.insert("albedo", albedo);
    }
    if let Some(Item::Value(version)) = written.get_mut("majorant") {
        *version = Value::from(1).decorated(" ", "");
    }
    Some(written.to_string())
}

/// Restores the values of version 0.1 for keys that were not hashed, and removes newer keys.
fn restored_values(table: &mut Table, pattern: &str) -> Option<()> {
    let dot = if pattern.is_empty() { "" } else { "." };
    let names: Vec<String> = table.iter().map(|(name, _)| name.to_owned()).collect();
    for name in names {
        let path = format!("{pattern}{dot}{name}");
        match table.get_mut(&name)? {
            Item::Table(inner) if !COUNTED.contains(&path.as_str()) => {
                restored_values(inner, &path)?;
                if inner.is_empty() {
                    table.remove(&name);
                }
            }
            Item::ArrayOfTables(entries) => {
                for entry in entries.iter_mut() {
                    restored_values(entry, &format!("{path}.*"))?;
                }
            }
            Item::Value(value) => match FROZEN.iter().find(|(frozen, _)| *frozen == path) {
                Some((_, then)) if value.to_string().trim() != *then => {
                    *value = then.parse::<Value>().ok()?.decorated(" ", "");
                }
                Some(_) => {}
                None if COUNTED.contains(&path.as_str()) => {}
                None => _ = table.remove(&name),
            },
            Item::Table(_) | Item::None => {}
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::embedded::SCENES;
    use crate::scene::{
        CoefficientsDoc, CoefficientsKind, DensityDoc, EmissionDoc, GridRef, LightDoc, ObjectDoc, PhaseDoc,
        PlacementDoc,
    };
    use crate::spectrum::{ControlPoint, Outside, SpectrumDoc};

    fn thawed(text: &str) -> String {
        let mut written: DocumentMut = text.parse().unwrap();
        restored_values(written.as_table_mut(), "").unwrap();
        written.to_string()
    }

    /// Documents in which every key of version 0.1 is written.
    fn documents() -> Vec<SceneDoc> {
        let grid = || GridRef { file: "a.vdb".into(), grid: Some("smoke".into()) };
        let mut full = SceneDoc {
            lights: LightDoc::templates().into_iter().map(|(_, light)| light).collect(),
            objects: ObjectDoc::templates().into_iter().take(2).map(|(_, object)| object).collect(),
            ..SceneDoc::default()
        };
        let points = vec![ControlPoint { lambda_nm: 500.0, value: 0.5 }];
        full.medium_mut().extinction = SpectrumDoc::Points { points, outside: Outside::Zero };
        full.medium_mut().albedo = SpectrumDoc::Rgb([0.1, 0.2, 0.3]);
        full.medium_mut().density = DensityDoc::Grid(grid());
        full.medium_mut().albedo_grid = Some(grid());
        full.medium_mut().emission = Some(EmissionDoc { temperature: Some(grid()), kelvin: 2.0, scale: 3.0 });
        full.medium_mut().placement =
            PlacementDoc { fit: Some(2.0), matrix: Some([[0.5; 4]; 3]), ..PlacementDoc::default() };
        full.estimator.max_depth = Some(3);
        let mut documents: Vec<SceneDoc> = PhaseDoc::templates()
            .into_iter()
            .map(|phase| {
                let mut doc = full.clone();
                doc.medium_mut().phase = phase;
                doc
            })
            .collect();
        for kind in [CoefficientsKind::AbsorptionScattering, CoefficientsKind::MeanFreePathColour] {
            let mut doc = full.clone();
            *doc.medium_mut() = doc.medium().given_by(kind, 0.0);
            assert!(matches!(
                doc.medium().coefficients,
                Some(
                    CoefficientsDoc::AbsorptionScattering { .. } | CoefficientsDoc::MeanFreePathColour { .. }
                )
            ));
            documents.push(doc);
        }
        documents.extend(SCENES.iter().map(|s| scene_file::parse(s.toml, s.name).unwrap()));
        documents
    }

    /// Changed defaults and new keys are restored to the text of version 0.1, which the fingerprints of the
    /// embedded scenes confirm.
    #[test]
    fn the_text_of_version_0_1_stands_as_it_was() {
        for doc in documents() {
            let text = thawed(&text_today(&doc, str::to_owned).unwrap());
            assert!(!text.contains("enabled") && !text.contains("mirror"), "{text}");
            assert!(!text.contains("material") && !text.contains("media"), "{text}");
            assert_eq!(thawed(&text), text);
            // A changed default, and new keys and tables.
            let later = text.replacen("absorption = \"weighted\"", "absorption = \"analogue\"", 1);
            let later = later.replacen("[film]\n", "[film]\nbit_depth = 12\n", 1);
            let later = format!("{later}\n[weather]\nwind = 3.0\n");
            assert!(later.contains("analogue") && later.contains("bit_depth"));
            assert_eq!(thawed(&later).trim_end(), text.trim_end());
        }
    }
}
