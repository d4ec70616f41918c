//! Variants in the study.

use crate::bench::Candidate;
use crate::estimator;
use crate::io::scene_file;
use crate::scene::SceneDoc;

/// An estimator with settings.
#[derive(Clone, Copy, Debug)]
pub struct Variant {
    /// Id in machine-readable tables.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// Estimator id.
    pub estimator: &'static str,
    /// Settings that differ from those of the scene.
    pub set: &'static [&'static str],
    /// Whether its bookkeeping biases it, which is the quantity under test.
    pub own_bias: bool,
}

const WEIGHTED: &str = "estimator.absorption=weighted";
const ANALOGUE: &str = "estimator.absorption=analogue";

const fn weighted(id: &'static str, name: &'static str) -> Variant {
    Variant { id, name, estimator: id, set: &[WEIGHTED], own_bias: false }
}

const fn uni_nee_mis(id: &'static str, name: &'static str, set: &'static [&'static str]) -> Variant {
    Variant { id, name, estimator: "uni-nee-mis", set, own_bias: false }
}

/// All variants; the first is the default of this program.
pub static VARIANTS: &[Variant] = &[
    weighted("uni-nee-mis", "Uni+NEE MIS"),
    uni_nee_mis("uni-nee-mis-analogue", "Uni+NEE MIS, analogue absorption", &[ANALOGUE]),
    weighted("mitsuba2-volpath", "Mitsuba 2 volpath"),
    weighted("nee", "NEE"),
    weighted("spectral-mis", "Spectral MIS"),
    Variant {
        id: "spectral-mis-analogue",
        name: "Spectral MIS, analogue absorption",
        estimator: "spectral-mis",
        set: &[ANALOGUE],
        own_bias: false,
    },
    weighted("independent", "Independent tracking"),
    uni_nee_mis(
        "uni-nee-mis-pairwise",
        "Uni+NEE MIS, pairwise quotients",
        &[WEIGHTED, "estimator.bookkeeping=pairwise"],
    ),
    uni_nee_mis(
        "uni-nee-mis-apart-f64",
        "Uni+NEE MIS, f and p apart in f64",
        &[WEIGHTED, "estimator.bookkeeping=apart-f64"],
    ),
    Variant {
        own_bias: true,
        ..uni_nee_mis(
            "uni-nee-mis-apart-f32",
            "Uni+NEE MIS, f and p apart in f32",
            &[WEIGHTED, "estimator.bookkeeping=apart-f32"],
        )
    },
];

/// Display name of a variant.
#[must_use]
pub fn name(id: &str) -> &str {
    VARIANTS.iter().find(|v| v.id == id).map_or(id, |v| v.name)
}

impl Variant {
    /// The variant as a candidate of a benchmark, with the other settings of the scene.
    ///
    /// # Errors
    /// The reason why it cannot run on this scene, as a sentence.
    pub fn candidate(&self, scene: &SceneDoc) -> Result<Candidate, String> {
        let mut edits = vec![format!("estimator.id={:?}", self.estimator)];
        edits.extend(self.set.iter().map(|edit| (*edit).to_owned()));
        let doc = scene_file::override_keys(scene, &edits).map_err(|e| e.to_string())?;
        if let Some(problem) = estimator::validate(&doc).first() {
            return Err(problem.to_string());
        }
        let entry = estimator::find(self.estimator).ok_or("the estimator does not exist")?;
        let candidate = Candidate {
            name: self.id.to_owned(),
            entry,
            settings: doc.estimator.clone(),
            own_bias: self.own_bias,
        };
        match candidate.bias(&doc).or_else(|| (entry.infinite_variance)(&doc)) {
            Some(reason) => Err(reason.to_owned()),
            None => Ok(candidate),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::question::questions;
    use super::*;
    use crate::figures::{FIGURES, Options};
    use crate::scene::Absorption;

    #[test]
    fn a_variant_has_its_settings_and_an_impossible_one_states_the_reason() {
        let scene = SceneDoc::default();
        let analogue = VARIANTS.iter().find(|v| v.id == "uni-nee-mis-analogue").unwrap();
        let candidate = analogue.candidate(&scene).unwrap();
        assert_eq!(
            (candidate.entry.id, candidate.settings.absorption),
            ("uni-nee-mis", Absorption::Analogue)
        );
        let gone = Variant { estimator: "magic", ..*analogue };
        assert!(gone.candidate(&scene).unwrap_err().contains("`magic`"));
        let unknown = Variant { set: &["estimator.magic=3"], ..*analogue };
        assert!(unknown.candidate(&scene).unwrap_err().contains("magic"));
        let mut clamped = scene.clone();
        clamped.medium_mut().majorant.factor = 0.5;
        clamped.medium_mut().majorant.when_exceeded = crate::scene::WhenExceeded::Clamp;
        assert!(analogue.candidate(&clamped).unwrap_err().contains("clamped"));
    }

    #[test]
    fn every_variant_runs_on_every_scene_under_a_unique_name() {
        for strip in FIGURES.iter().flat_map(|f| f.strips) {
            let scene = strip.scene_doc(&Options::default()).unwrap();
            let mut settings: Vec<_> = Vec::new();
            for variant in VARIANTS {
                let candidate = variant.candidate(&scene).unwrap();
                assert_eq!(name(variant.id), variant.name);
                assert!(!settings.contains(&candidate.settings), "{} is another's double", variant.id);
                settings.push(candidate.settings);
            }
        }
        for question in questions() {
            for id in [question.variant, question.against] {
                assert!(VARIANTS.iter().any(|v| v.id == id), "{id}");
            }
        }
    }
}
