//! Predefined comparisons: the figures of the report, and examples of bias and of light sampling.

use majorant_core::io::{embedded, scene_file};
use majorant_core::scene::{Absorption, Fairness, ReferenceDoc, SceneDoc, ViewOverrides, WhenExceeded};

/// A predefined comparison.
pub struct Preset {
    /// Name in the menu.
    pub name: &'static str,
    /// Description.
    pub about: &'static str,
    scene: &'static str,
    set_up: fn(SceneDoc) -> SceneDoc,
}

/// Every preset, in the order of the menu.
pub static PRESETS: &[Preset] = &[
    Preset {
        name: "Figure 2: colour noise",
        about: "Independent tracking and spectral MIS, 64 samples per pixel: hero wavelengths remove the colour \
                noise",
        scene: "plume-spectral",
        set_up: |doc| figure(doc, &["independent", "spectral-mis"], "uni-nee-mis"),
    },
    Preset {
        name: "Figure 3, upper row: back-lit",
        about: "A large light behind a forward-scattering cloud: next-event estimation fails, Uni+NEE MIS does not",
        scene: "cloud-backlit",
        set_up: |doc| figure(doc, &["spectral-mis", "nee", "uni-nee-mis"], "spectral-mis"),
    },
    Preset {
        name: "Figure 3, lower row: side-lit",
        about: "A small light beside a dense cloud: unidirectional sampling fails, Uni+NEE MIS does not",
        scene: "cloud-sidelit",
        set_up: |doc| figure(doc, &["spectral-mis", "nee", "uni-nee-mis"], "nee"),
    },
    Preset {
        name: "Figure 4: the noise of absorption",
        about: "Analogue absorption and weighting by the albedo, 64 samples per pixel: the same mean, less noise \
                with weights",
        scene: "homogeneous-absorption",
        set_up: absorption,
    },
    Preset {
        name: "The older integrator",
        about: "Mitsuba 2's volpath with one component per path, and Uni+NEE MIS over all components, at equal time",
        scene: "plume-spectral",
        set_up: |doc| {
            let mut doc = figure(doc, &["mitsuba2-volpath", "uni-nee-mis"], "uni-nee-mis");
            doc.render.spp = None;
            doc.compare.fairness = Fairness::Time;
            doc
        },
    },
    Preset {
        name: "Lanterns in the fog",
        about: "Free-flight and equiangular distance sampling, at equal time",
        scene: "lantern",
        set_up: |doc| {
            let mut doc = figure(doc, &["uni-nee-mis", "equiangular-mis"], "equiangular-mis");
            doc.render.spp = None;
            doc.compare.fairness = Fairness::Time;
            doc
        },
    },
    Preset {
        name: "Find the bias",
        about: "A majorant that is too low, weighted (unbiased) and clamped (biased), and a tight one: the z-map \
                distinguishes bias from noise",
        scene: "homogeneous-absorption",
        set_up: bias,
    },
];

impl Preset {
    /// Returns the scene with its comparison.
    ///
    /// # Errors
    /// A message if the embedded scene does not exist or is invalid.
    pub fn doc(&self) -> Result<SceneDoc, String> {
        let scene = embedded::find(self.scene)
            .ok_or_else(|| format!("There is no embedded scene `{}`.", self.scene))?;
        let doc = scene_file::parse(scene.toml, scene.name).map_err(|e| e.to_string())?;
        Ok((self.set_up)(doc))
    }
}

/// Settings of the report: 64 samples per pixel, and a reference with 1024.
fn figure(mut doc: SceneDoc, estimators: &[&str], reference: &str) -> SceneDoc {
    doc.render.spp = Some(64);
    doc.compare.fairness = Fairness::Samples;
    let base = doc.view_overrides(0).unwrap_or_default();
    for (i, id) in estimators.iter().enumerate() {
        if i == 0 {
            (*id).clone_into(&mut doc.estimator.id);
            continue;
        }
        let mut view = ViewOverrides { seed: doc.free_seed(), ..base.clone() };
        (*id).clone_into(&mut view.estimator.id);
        doc.compare.views.push(view);
    }
    doc.compare.reference =
        ReferenceDoc::Render { estimator: reference.into(), spp: Some(1024), relative_error: None };
    doc
}

/// Views that differ only in the handling of absorption.
fn absorption(doc: SceneDoc) -> SceneDoc {
    let id = doc.estimator.id.clone();
    let mut doc = figure(doc, &[&id, &id], "uni-nee-mis");
    doc.estimator.absorption = Absorption::Analogue;
    for view in &mut doc.compare.views {
        view.estimator.absorption = Absorption::Weighted;
    }
    doc
}

fn bias(mut doc: SceneDoc) -> SceneDoc {
    doc.title = "Find the bias".into();
    doc.note = "Views B and C have a majorant that is too low. B weights the excess and stays unbiased, at the cost \
                of noise; C clamps it. The images look alike: choose `z of blocks` as the layer, or wait for the \
                verdict."
        .into();
    doc.render.spp = None;
    let base = doc.view_overrides(0).unwrap_or_default();
    for (when_exceeded, factor) in [(WhenExceeded::Weighted, 0.97), (WhenExceeded::Clamp, 0.9)] {
        let mut view = ViewOverrides { seed: doc.free_seed(), ..base.clone() };
        view.majorant.factor = factor;
        view.majorant.when_exceeded = when_exceeded;
        doc.compare.views.push(view);
    }
    doc
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::estimator::validate;

    #[test]
    fn presets_are_scenes_that_render() {
        for preset in PRESETS {
            let doc = preset.doc().expect(preset.name);
            assert_eq!(validate(&doc), [], "{}", preset.name);
            assert!(doc.view_count() >= 2);
            let seeds: std::collections::BTreeSet<u64> =
                doc.view_docs().iter().map(|d| d.render.seed).collect();
            assert_eq!(seeds.len(), doc.view_count(), "{}", preset.name);
        }
    }
}
