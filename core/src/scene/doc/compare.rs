//! The comparison as edited: further views of the scene, how they share the machine, what they are held
//! against, and what of them is shown.

use super::{CameraDoc, EstimatorDoc, MajorantDoc, SceneDoc, ViewDoc};
use serde::{Deserialize, Serialize};

/// The most views of a scene.
pub const MAX_VIEWS: usize = 8;

/// A wall of views of one scene. View A is the scene itself; `views` are B, C, …
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CompareDoc {
    /// The views beside the scene's own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub views: Vec<ContenderDoc>,
    /// What every view gets as much of as every other.
    pub fairness: Fairness,
    /// What errors are measured against.
    pub reference: ReferenceDoc,
    /// Which view speed-ups are relative to, from 0.
    pub baseline: usize,
    /// The measure of error, by its id.
    pub measure: MeasureId,
    /// The pixels that numbers are about, x0, y0, x1, y1 (half open). Absent: all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<[u32; 4]>,
    /// Earlier place of `window.arrangement`.
    #[serde(skip_serializing)]
    pub arrangement: Option<toml::Value>,
    /// Earlier place of `window.pair`.
    #[serde(skip_serializing)]
    pub pair: Option<toml::Value>,
    /// Earlier place of `window.layer`.
    #[serde(skip_serializing)]
    pub layer: Option<toml::Value>,
    /// Earlier place of `window.own_zoom`.
    #[serde(skip_serializing)]
    pub own_zoom: Option<toml::Value>,
}

/// The id of a measure of error.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct MeasureId(pub String);

impl Default for MeasureId {
    fn default() -> Self {
        Self("relmse".into())
    }
}

/// What a view has of its own; everything else is the scene's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ContenderDoc {
    /// How light transport is estimated.
    pub estimator: EstimatorDoc,
    /// The majorant that free flights are sampled from.
    pub majorant: MajorantDoc,
    /// Selects its random numbers.
    pub seed: u64,
    /// A camera of its own. Absent: the scene's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraDoc>,
    /// An exposure and tone curve of its own. Absent: the scene's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub view: Option<ViewDoc>,
}

/// What every view gets as much of as every other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fairness {
    /// CPU seconds of path tracing, all workers together.
    #[default]
    Time,
    /// Samples per pixel.
    Samples,
    /// Evaluations of the medium's coefficients.
    Lookups,
}

/// What errors are measured against.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", from = "Written")]
pub enum ReferenceDoc {
    /// Nothing: variances and z-values need no reference.
    #[default]
    None,
    /// For every view the mean of the other unbiased views.
    Pooled,
    /// The picture of a view, from 0.
    View {
        /// Which.
        view: usize,
    },
    /// A picture of its own, rendered in the background.
    Render {
        /// By which estimator.
        estimator: String,
        /// Samples per pixel.
        #[serde(skip_serializing_if = "Option::is_none")]
        spp: Option<u64>,
        /// Until the standard error is this share of the mean.
        #[serde(skip_serializing_if = "Option::is_none")]
        relative_error: Option<f32>,
    },
    /// An EXR picture.
    File {
        /// Its name, relative to the scene's file.
        file: String,
    },
}

/// A reference as it is written. Variants without parameters have braces: unknown keys are refused in them, too.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
enum Written {
    None {},
    Pooled {},
    View {
        view: usize,
    },
    Render {
        estimator: String,
        #[serde(default)]
        spp: Option<u64>,
        #[serde(default)]
        relative_error: Option<f32>,
    },
    File {
        file: String,
    },
}

impl From<Written> for ReferenceDoc {
    fn from(written: Written) -> Self {
        match written {
            Written::None {} => Self::None,
            Written::Pooled {} => Self::Pooled,
            Written::View { view } => Self::View { view },
            Written::Render { estimator, spp, relative_error } => {
                Self::Render { estimator, spp, relative_error }
            }
            Written::File { file } => Self::File { file },
        }
    }
}

/// Random numbers of a reference that no view is given by default.
const REFERENCE_SEED: u64 = 0x5eed_0000;

impl SceneDoc {
    /// Moves the window's keys that earlier versions kept under `compare` to `window`.
    #[must_use]
    pub fn with_window_keys_moved(mut self) -> Self {
        let compare = &mut self.compare;
        let earlier = [
            ("arrangement", compare.arrangement.take()),
            ("pair", compare.pair.take()),
            ("layer", compare.layer.take()),
            ("own_zoom", compare.own_zoom.take()),
        ];
        for (key, value) in earlier {
            if let Some(value) = value {
                self.window.insert(key.into(), value);
            }
        }
        self
    }

    /// Views of the scene, its own counted.
    #[must_use]
    pub fn view_count(&self) -> usize {
        1 + self.compare.views.len()
    }

    /// The document that a view renders: the scene with what the view has of its own. `None` if there is no
    /// such view.
    #[must_use]
    pub fn view_doc(&self, view: usize) -> Option<Self> {
        let mut doc = Self { compare: CompareDoc::default(), window: toml::Table::new(), ..self.clone() };
        if view == 0 {
            return Some(doc);
        }
        let own = self.compare.views.get(view - 1)?;
        doc.estimator.clone_from(&own.estimator);
        doc.medium.majorant.clone_from(&own.majorant);
        doc.render.seed = own.seed;
        if let Some(camera) = &own.camera {
            doc.camera.clone_from(camera);
        }
        if let Some(view) = &own.view {
            doc.view.clone_from(view);
        }
        Some(doc)
    }

    /// Documents of all views, in order.
    #[must_use]
    pub fn view_docs(&self) -> Vec<Self> {
        (0..self.view_count()).filter_map(|view| self.view_doc(view)).collect()
    }

    /// Writes an edited document of a view back: what views have of their own goes to the view, the rest is
    /// the scene's.
    #[must_use]
    pub fn with_view_doc(&self, view: usize, edited: &Self) -> Self {
        let mut doc = Self { compare: self.compare.clone(), window: self.window.clone(), ..edited.clone() };
        if view == 0 {
            return doc;
        }
        doc.estimator.clone_from(&self.estimator);
        doc.medium.majorant.clone_from(&self.medium.majorant);
        doc.render.seed = self.render.seed;
        if let Some(own) = doc.compare.views.get_mut(view - 1) {
            own.estimator.clone_from(&edited.estimator);
            own.majorant.clone_from(&edited.medium.majorant);
            own.seed = edited.render.seed;
            if let Some(camera) = &mut own.camera {
                camera.clone_from(&edited.camera);
                doc.camera.clone_from(&self.camera);
            }
            if let Some(view) = &mut own.view {
                view.clone_from(&edited.view);
                doc.view.clone_from(&self.view);
            }
        }
        doc
    }

    /// What a view would be described by as one more view.
    #[must_use]
    pub fn contender(&self, view: usize) -> Option<ContenderDoc> {
        match view {
            0 => Some(ContenderDoc {
                estimator: self.estimator.clone(),
                majorant: self.medium.majorant.clone(),
                seed: self.render.seed,
                camera: None,
                view: None,
            }),
            _ => self.compare.views.get(view - 1).cloned(),
        }
    }

    /// The lowest seed that no view has: views that share random numbers cannot be compared.
    #[must_use]
    pub fn free_seed(&self) -> u64 {
        let taken: Vec<u64> =
            (0..self.view_count()).filter_map(|v| self.contender(v)).map(|c| c.seed).collect();
        (0..).find(|seed| !taken.contains(seed)).unwrap_or_default()
    }

    /// The document of a reference that is rendered in the background, if there is one.
    #[must_use]
    pub fn reference_doc(&self) -> Option<Self> {
        let ReferenceDoc::Render { estimator, spp, relative_error } = &self.compare.reference else {
            return None;
        };
        let mut doc = self.view_doc(0)?.unbiased();
        doc.estimator.id.clone_from(estimator);
        doc.estimator.absorption = super::Absorption::Weighted;
        doc.medium.majorant = MajorantDoc::default();
        doc.render.seed = REFERENCE_SEED;
        (doc.render.spp, doc.render.relative_error) = (*spp, *relative_error);
        (doc.render.seconds, doc.render.cpu_seconds) = (None, None);
        Some(doc)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Mode, WhenExceeded};

    fn two_views() -> SceneDoc {
        let mut doc = SceneDoc::default();
        let mut other = doc.contender(0).unwrap_or_default();
        other.estimator.id = "nee".into();
        other.seed = doc.free_seed();
        doc.compare.views.push(other);
        doc
    }

    #[test]
    fn a_view_is_the_scene_with_what_it_has_of_its_own() {
        let doc = two_views();
        let b = doc.view_doc(1).unwrap();
        assert_eq!((b.estimator.id.as_str(), b.render.seed), ("nee", 1));
        assert_eq!(b.medium, doc.medium);
        assert_eq!(doc.view_doc(2), None);
        assert_eq!(doc.view_docs().len(), 2);
    }

    #[test]
    fn an_edit_of_a_view_stays_in_it_and_one_of_the_scene_reaches_all() {
        let doc = two_views();
        let mut edited = doc.view_doc(1).unwrap();
        edited.medium.majorant.factor = 3.0;
        edited.estimator.mode = Mode::Rgb;
        edited.medium.scale = 7.0;
        let doc = doc.with_view_doc(1, &edited);
        assert_eq!(doc.view_doc(1).unwrap(), edited);
        let a = doc.view_doc(0).unwrap();
        assert_eq!((a.medium.majorant.factor, a.estimator.mode, a.medium.scale), (1.0, Mode::Spectral, 7.0));
        // A camera of its own is not the scene's.
        let mut doc = doc;
        doc.compare.views[0].camera = Some(doc.camera.clone());
        let mut edited = doc.view_doc(1).unwrap();
        edited.camera.fov_deg = 12.0;
        let doc = doc.with_view_doc(1, &edited);
        assert_eq!(
            (doc.view_doc(1).unwrap().camera.fov_deg, doc.camera.fov_deg),
            (12.0, CameraDoc::default().fov_deg)
        );
    }

    #[test]
    fn views_converge_to_the_same_image_unless_mode_depth_or_scene_differ() {
        let doc = two_views();
        let target = |edit: fn(&mut SceneDoc)| {
            let mut b = doc.view_doc(1).unwrap();
            edit(&mut b);
            b.target_part() == doc.target_part()
        };
        assert!(target(|_| ()));
        assert!(target(|d| d.medium.majorant.when_exceeded = WhenExceeded::Clamp));
        assert!(target(|d| d.estimator.roulette_depth = Some(3)));
        assert!(!target(|d| d.estimator.mode = Mode::Rgb));
        assert!(!target(|d| d.estimator.max_depth = Some(2)));
        assert!(!target(|d| d.camera.fov_deg += 1.0));
        assert!(!target(|d| d.medium.scale *= 2.0));
    }

    #[test]
    fn seeds_are_never_shared_by_default() {
        let doc = two_views();
        assert_eq!(doc.free_seed(), 2);
        let mut reference = doc.clone();
        reference.compare.reference =
            ReferenceDoc::Render { estimator: "nee".into(), spp: Some(8), relative_error: None };
        let made = reference.reference_doc().unwrap();
        assert!(made.render.seed > 1000 && made.render.spp == Some(8) && made.estimator.id == "nee");
        assert_eq!(doc.reference_doc(), None);
        // What biases view A does not bias the reference.
        reference.estimator.transmittance = "marching".into();
        reference.estimator.bookkeeping = crate::scene::Bookkeeping::ApartF32;
        reference.estimator.fault = crate::scene::Fault::NullCap;
        reference.medium.majorant.factor = 0.5;
        reference.medium.majorant.when_exceeded = WhenExceeded::Clamp;
        assert_eq!(reference.reference_doc(), Some(made));
    }
}
