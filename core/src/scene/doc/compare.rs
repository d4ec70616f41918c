//! Editable comparison: additional views of a scene, their budget, reference and display.

use super::{CameraDoc, EstimatorDoc, MajorantDoc, MediumDoc, SceneDoc, ViewDoc};
use serde::{Deserialize, Serialize};

/// Maximum number of views of a scene, including the scene's own.
pub const MAX_VIEWS: usize = 8;

/// Comparison of several views of one scene. View A is the scene itself; `views` are B, C, …
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CompareDoc {
    /// Views besides view A.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub views: Vec<ViewOverrides>,
    /// Quantity of which every view gets the same amount.
    pub fairness: Fairness,
    /// Reference that errors are measured against.
    pub reference: ReferenceDoc,
    /// Index of the view that speed-ups are relative to, from 0.
    pub baseline: usize,
    /// Id of the error measure.
    pub measure: MeasureId,
    /// Pixels that statistics are computed over: x0, y0, x1, y1 (half open). Absent: the whole image.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<[u32; 4]>,
    /// Former location of `window.arrangement`.
    #[serde(skip_serializing)]
    pub arrangement: Option<toml::Value>,
    /// Former location of `window.pair`.
    #[serde(skip_serializing)]
    pub pair: Option<toml::Value>,
    /// Former location of `window.layer`.
    #[serde(skip_serializing)]
    pub layer: Option<toml::Value>,
    /// Former location of `window.own_zoom`.
    #[serde(skip_serializing)]
    pub own_zoom: Option<toml::Value>,
}

/// Id of an error measure.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct MeasureId(pub String);

impl Default for MeasureId {
    fn default() -> Self {
        Self("relmse".into())
    }
}

/// Settings in which a view differs from the scene; all others are the scene's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ViewOverrides {
    /// Estimator of light transport.
    pub estimator: EstimatorDoc,
    /// Majorant that free flights are sampled from, in a scene with one medium.
    pub majorant: MajorantDoc,
    /// Settings of media in a scene with several. A medium that is not listed has the scene's.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub media: Vec<MediumOverrides>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Camera of this view. Absent: the scene's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraDoc>,
    /// Exposure and tone curve of this view. Absent: the scene's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub view: Option<ViewDoc>,
}

/// Settings in which a medium of a view differs from the scene's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MediumOverrides {
    /// Name of the medium.
    pub name: String,
    /// Majorant that free flights are sampled from.
    pub majorant: MajorantDoc,
}

impl Default for MediumOverrides {
    fn default() -> Self {
        Self { name: MediumDoc::default().name, majorant: MajorantDoc::default() }
    }
}

impl ViewOverrides {
    /// The majorants of these media in this view; `None` where they are the scene's.
    fn majorant_of(&self, name: &str, is_only: bool) -> Option<&MajorantDoc> {
        if is_only {
            return Some(&self.majorant);
        }
        self.media.iter().find(|own| own.name == name).map(|own| &own.majorant)
    }

    /// Records the majorants of all media in this view.
    fn set_majorants(&mut self, media: &[MediumDoc]) {
        (self.majorant, self.media) = (MajorantDoc::default(), Vec::new());
        match media {
            [only] => self.majorant.clone_from(&only.majorant),
            several => {
                let own = |medium: &MediumDoc| MediumOverrides {
                    name: medium.name.clone(),
                    majorant: medium.majorant.clone(),
                };
                self.media.extend(several.iter().map(own));
            }
        }
    }
}

/// Quantity of which every view gets the same amount.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fairness {
    /// CPU seconds of path tracing, summed over all worker threads.
    #[default]
    Time,
    /// Samples per pixel.
    Samples,
    /// Evaluations of the medium's coefficients.
    Lookups,
}

/// Reference that errors are measured against.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", from = "Written")]
pub enum ReferenceDoc {
    /// No reference: variances and z-values only.
    #[default]
    None,
    /// For each view, the mean of the other unbiased views.
    Pooled,
    /// The image of one view.
    View {
        /// Index of the view, from 0.
        view: usize,
    },
    /// A separate image, rendered in the background.
    Render {
        /// Id of the estimator.
        estimator: String,
        /// Samples per pixel.
        #[serde(skip_serializing_if = "Option::is_none")]
        spp: Option<u64>,
        /// Stops when the standard error is this fraction of the mean.
        #[serde(skip_serializing_if = "Option::is_none")]
        relative_error: Option<f32>,
    },
    /// An EXR image.
    File {
        /// File name, relative to the scene file.
        file: String,
    },
}

/// Serialised form of a reference. Variants without parameters have braces so that unknown keys are rejected
/// in them, too.
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

/// Index of the medium before an edit that each medium after it corresponds to: the one of the same name, or,
/// where only names have changed, the one at the same place.
fn counterparts(before: &[MediumDoc], after: &[MediumDoc]) -> Vec<Option<usize>> {
    let by_name = |medium: &MediumDoc| before.iter().position(|b| b.name == medium.name);
    let by_place = |(index, medium): (usize, &MediumDoc)| {
        by_name(medium).or((before.len() == after.len()).then_some(index))
    };
    after.iter().enumerate().map(by_place).collect()
}

/// Seed of a rendered reference; no view has it by default.
const REFERENCE_SEED: u64 = 0x5eed_0000;

impl SceneDoc {
    /// Moves the window keys that earlier versions kept under `compare` to `window`.
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

    /// Number of views, including the scene's own.
    #[must_use]
    pub fn view_count(&self) -> usize {
        1 + self.compare.views.len()
    }

    /// Document that a view renders: the scene with the view's own settings applied. `None` if the view does
    /// not exist.
    #[must_use]
    pub fn view_doc(&self, view: usize) -> Option<Self> {
        let mut doc = Self { compare: CompareDoc::default(), window: toml::Table::new(), ..self.clone() };
        if view == 0 {
            return Some(doc);
        }
        let own = self.compare.views.get(view - 1)?;
        doc.estimator.clone_from(&own.estimator);
        doc.set_majorants(own);
        doc.render.seed = own.seed;
        if let Some(camera) = &own.camera {
            doc.camera.clone_from(camera);
        }
        if let Some(view) = &own.view {
            doc.view.clone_from(view);
        }
        Some(doc)
    }

    /// Sets the majorants of all media to those of a view.
    pub fn set_majorants(&mut self, own: &ViewOverrides) {
        let is_only = self.media.len() == 1;
        for medium in &mut self.media {
            if let Some(majorant) = own.majorant_of(&medium.name, is_only) {
                medium.majorant.clone_from(majorant);
            }
        }
    }

    /// The views with the majorants that they have, addressed by the names of media that were renamed, added
    /// or removed.
    fn views_with_media(&self, media: &[MediumDoc]) -> Vec<ViewOverrides> {
        let names = |media: &[MediumDoc]| media.iter().map(|m| m.name.clone()).collect::<Vec<_>>();
        if names(&self.media) == names(media) {
            return self.compare.views.clone();
        }
        let counterparts = counterparts(&self.media, media);
        let of_view = |own: &ViewOverrides| {
            let mut media = media.to_vec();
            for (medium, before) in media.iter_mut().zip(&counterparts) {
                let before = before.map(|before| &self.media[before]);
                let known = before.and_then(|m| own.majorant_of(&m.name, self.media.len() == 1));
                if let Some(majorant) = known {
                    medium.majorant.clone_from(majorant);
                }
            }
            let mut own = own.clone();
            own.set_majorants(&media);
            own
        };
        self.compare.views.iter().map(of_view).collect()
    }

    /// Documents of all views, in order.
    #[must_use]
    pub fn view_docs(&self) -> Vec<Self> {
        (0..self.view_count()).filter_map(|view| self.view_doc(view)).collect()
    }

    /// Writes an edited document of a view back: the view's own settings go to the view, all others to the
    /// scene.
    #[must_use]
    pub fn with_view_doc(&self, view: usize, edited: &Self) -> Self {
        let mut doc = Self { compare: self.compare.clone(), window: self.window.clone(), ..edited.clone() };
        doc.compare.views = self.views_with_media(&edited.media);
        if view == 0 {
            return doc;
        }
        doc.estimator.clone_from(&self.estimator);
        let counterparts = counterparts(&self.media, &edited.media);
        for (medium, before) in doc.media.iter_mut().zip(counterparts) {
            if let Some(before) = before {
                medium.majorant.clone_from(&self.media[before].majorant);
            }
        }
        doc.render.seed = self.render.seed;
        if let Some(own) = doc.compare.views.get_mut(view - 1) {
            own.estimator.clone_from(&edited.estimator);
            own.set_majorants(&edited.media);
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

    /// Settings of a view, from which another view can be created. `None` if the view does not exist.
    #[must_use]
    pub fn view_overrides(&self, view: usize) -> Option<ViewOverrides> {
        match view {
            0 => {
                let mut own = ViewOverrides {
                    estimator: self.estimator.clone(),
                    seed: self.render.seed,
                    ..ViewOverrides::default()
                };
                own.set_majorants(&self.media);
                Some(own)
            }
            _ => self.compare.views.get(view - 1).cloned(),
        }
    }

    /// Lowest seed that no view uses: views that share random numbers cannot be compared.
    #[must_use]
    pub fn free_seed(&self) -> u64 {
        let taken: Vec<u64> =
            (0..self.view_count()).filter_map(|v| self.view_overrides(v)).map(|c| c.seed).collect();
        (0..).find(|seed| !taken.contains(seed)).unwrap_or_default()
    }

    /// Document of the reference that is rendered in the background; `None` for other kinds of reference.
    #[must_use]
    pub fn reference_doc(&self) -> Option<Self> {
        let ReferenceDoc::Render { estimator, spp, relative_error } = &self.compare.reference else {
            return None;
        };
        let mut doc = self.view_doc(0)?.unbiased();
        doc.estimator.id.clone_from(estimator);
        doc.estimator.absorption = super::Absorption::Weighted;
        for medium in &mut doc.media {
            medium.majorant = MajorantDoc::default();
        }
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
        let mut other = doc.view_overrides(0).unwrap_or_default();
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
        assert_eq!(b.media, doc.media);
        assert_eq!(doc.view_doc(2), None);
        assert_eq!(doc.view_docs().len(), 2);
    }

    #[test]
    fn an_edit_of_a_view_stays_in_it_and_one_of_the_scene_reaches_all() {
        let doc = two_views();
        let mut edited = doc.view_doc(1).unwrap();
        edited.medium_mut().majorant.factor = 3.0;
        edited.estimator.mode = Mode::Rgb;
        edited.medium_mut().scale = 7.0;
        let doc = doc.with_view_doc(1, &edited);
        assert_eq!(doc.view_doc(1).unwrap(), edited);
        let a = doc.view_doc(0).unwrap();
        assert_eq!(
            (a.medium().majorant.factor, a.estimator.mode, a.medium().scale),
            (1.0, Mode::Spectral, 7.0)
        );
        // A view's own camera is independent of the scene's.
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

    /// A view keeps its own majorants while media are added, renamed, reordered and removed.
    #[test]
    fn majorants_of_a_view_follow_their_media() {
        let mut doc = two_views();
        doc.compare.views[0].majorant.factor = 3.0;
        let mut edited = doc.view_doc(0).unwrap();
        edited.media.push(MediumDoc { name: "fog".into(), ..MediumDoc::default() });
        let doc = doc.with_view_doc(0, &edited);
        let factors = |doc: &SceneDoc, view| {
            let doc = doc.view_doc(view).unwrap();
            doc.media.iter().map(|m| (m.name.clone(), m.majorant.factor)).collect::<Vec<_>>()
        };
        let named = |pairs: &[(&str, f32)]| {
            pairs.iter().map(|(name, factor)| ((*name).to_owned(), *factor)).collect::<Vec<_>>()
        };
        assert_eq!(factors(&doc, 1), named(&[("medium", 3.0), ("fog", 1.0)]));

        let mut edited = doc.view_doc(1).unwrap();
        (edited.media[0].name, edited.media[1].majorant.factor) = ("cloud".into(), 2.0);
        let doc = doc.with_view_doc(1, &edited);
        assert_eq!(factors(&doc, 1), named(&[("cloud", 3.0), ("fog", 2.0)]));
        assert_eq!(factors(&doc, 0), named(&[("cloud", 1.0), ("fog", 1.0)]));

        let mut edited = doc.view_doc(0).unwrap();
        edited.media.reverse();
        let doc = doc.with_view_doc(0, &edited);
        assert_eq!(factors(&doc, 1), named(&[("fog", 2.0), ("cloud", 3.0)]));
        edited.media.remove(0);
        let doc = doc.with_view_doc(0, &edited);
        assert_eq!(factors(&doc, 1), named(&[("cloud", 3.0)]));
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
        assert!(target(|d| d.medium_mut().majorant.when_exceeded = WhenExceeded::Clamp));
        assert!(target(|d| d.estimator.roulette_depth = Some(3)));
        assert!(!target(|d| d.estimator.mode = Mode::Rgb));
        assert!(!target(|d| d.estimator.max_depth = Some(2)));
        assert!(!target(|d| d.camera.fov_deg += 1.0));
        assert!(!target(|d| d.medium_mut().scale *= 2.0));
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
        // Settings that bias view A do not bias the reference.
        reference.estimator.transmittance = "marching".into();
        reference.estimator.bookkeeping = crate::scene::Bookkeeping::ApartF32;
        reference.estimator.fault = crate::scene::Fault::NullCap;
        reference.medium_mut().majorant.factor = 0.5;
        reference.medium_mut().majorant.when_exceeded = WhenExceeded::Clamp;
        assert_eq!(reference.reference_doc(), Some(made));
    }
}
