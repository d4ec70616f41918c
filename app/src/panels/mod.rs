//! The sections of the two columns. A new file and a line in [`PANELS`] add one; tests open them all.
//!
//! The left column holds *what* is simulated, the right one *how* it is estimated: nothing on the
//! right changes what the picture converges to (the one exception is marked as biased, in red).

mod albedo;
mod camera;
mod coefficients;
mod density;
mod display;
mod emission;
mod estimator;
mod extinction;
mod factor_curve;
pub mod faults;
mod light_fields;
mod lights;
mod majorant;
mod objects;
mod phase;
mod phase_table;
mod placement;
mod render;
mod scene;

use crate::model::Settings;
use crate::model::{Command, FactorCurve, GridLists, Latency, Stats};
use crate::theme::Palette;
use egui::{Color32, Ui};
use majorant_core::scene::SceneDoc;
use majorant_core::session::ViewState;

/// What a panel sees and where its edits go.
pub struct Cx<'a> {
    /// The document to edit; what comes of it is compared and applied after the frame.
    pub draft: &'a mut SceneDoc,
    /// The document when it was opened or saved.
    pub opened: &'a SceneDoc,
    /// What the session is doing.
    pub state: &'a ViewState,
    /// Rates and estimates derived from it.
    pub stats: &'a Stats,
    /// Whether views and reference are paused.
    pub paused: bool,
    /// Whether any of them has not come to its end.
    pub unfinished: bool,
    /// How soon the window has answered lately.
    pub latency: &'a Latency,
    /// What the majorant's factor costs, as far as it was measured.
    pub factor_curve: &'a FactorCurve,
    /// Preferences.
    pub settings: &'a Settings,
    /// Names of the grids in files, as far as they were listed.
    pub grids: &'a GridLists,
    /// Everything that is not an edit.
    pub commands: &'a mut Vec<Command>,
}

/// Which column a panel is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Left: what is simulated.
    Scene,
    /// Right: how it is estimated.
    Method,
}

/// A section of a column.
pub trait Panel: Sync {
    /// A stable id.
    fn id(&self) -> &'static str;
    /// Its heading.
    fn title(&self) -> &'static str;
    /// Where it is.
    fn column(&self) -> Column;
    /// Whether it is open at first.
    fn starts_open(&self) -> bool {
        false
    }
    /// What it holds, in a few words: the right end of its header.
    fn summary(&self, cx: &Cx<'_>) -> String;
    /// The colour of a dot that asks for attention.
    fn alert(&self, _cx: &Cx<'_>, _palette: &Palette) -> Option<Color32> {
        None
    }
    /// Its content.
    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>);
}

/// Every panel, from top to bottom of its column.
pub const PANELS: &[&dyn Panel] = &[
    &scene::Scene,
    &density::Density,
    &extinction::Extinction,
    &albedo::Albedo,
    &emission::Emission,
    &phase::PhaseFunction,
    &lights::Lights,
    &objects::Objects,
    &camera::Camera,
    &render::Render,
    &estimator::Estimator,
    &majorant::Majorant,
    &faults::Faults,
    &display::Display,
];
