//! Panels: the sections of the two columns. A new panel is a file and a line in [`PANELS`]; tests open them
//! all.
//!
//! The left column contains *what* is simulated, the right one *how* it is estimated: no setting on the right
//! changes the image to which rendering converges, except those that are marked as biased, in red.

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
mod material_fields;
mod media;
mod object_fields;
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
use majorant_core::scene::{MediumInfo, SceneDoc};
use majorant_core::session::ViewState;

/// Context of a panel: read-only state, and the draft and commands that receive its edits.
pub struct Cx<'a> {
    /// Document to edit; it is compared and applied after the frame.
    pub draft: &'a mut SceneDoc,
    /// Index of the medium that the panels of a medium show.
    pub medium: usize,
    /// Document as opened or last saved.
    pub opened: &'a SceneDoc,
    /// Session state of the selected view.
    pub state: &'a ViewState,
    /// Rates and estimated times, derived from `state`.
    pub stats: &'a Stats,
    /// Whether views and reference are paused.
    pub paused: bool,
    /// Whether a view or the reference is unfinished.
    pub unfinished: bool,
    /// Recent latencies of the window.
    pub latency: &'a Latency,
    /// Measured cost as a function of the majorant's factor, possibly incomplete.
    pub factor_curve: &'a FactorCurve,
    /// Settings of the window.
    pub settings: &'a Settings,
    /// Names of the grids of listed files.
    pub grids: &'a GridLists,
    /// Receives all commands that are not edits of the document.
    pub commands: &'a mut Vec<Command>,
}

impl<'a> Cx<'a> {
    /// Statistics of the selected medium; `None` until the scene is built, or if the medium is disabled.
    #[must_use]
    pub fn medium_info(&self) -> Option<&'a MediumInfo> {
        self.state.scene.as_ref()?.medium(self.medium)
    }
}

/// Column of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Left column: what is simulated.
    Scene,
    /// Right column: how it is estimated.
    Method,
}

/// A section of a column.
pub trait Panel: Sync {
    /// Stable id.
    fn id(&self) -> &'static str;
    /// Heading of the section.
    fn title(&self) -> &'static str;
    /// Column of the section.
    fn column(&self) -> Column;
    /// Whether the section is initially open.
    fn starts_open(&self) -> bool {
        false
    }
    /// Whether the section shows a medium, so that it is absent in a scene without media.
    fn is_of_medium(&self) -> bool {
        false
    }
    /// Short summary of the content, at the right end of the header.
    fn summary(&self, cx: &Cx<'_>) -> String;
    /// Colour of a warning dot in the header, if any.
    fn alert(&self, _cx: &Cx<'_>, _palette: &Palette) -> Option<Color32> {
        None
    }
    /// Shows the content.
    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>);
}

/// All panels, from top to bottom of their columns.
pub const PANELS: &[&dyn Panel] = &[
    &scene::Scene,
    &media::Media,
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
