//! Commands of the window. Widgets issue them, `logic` executes them.

use super::{Arrangement, Source, WallEdit};
use egui::ThemePreference;
use majorant_core::scene::SceneDoc;
use std::path::PathBuf;

/// Purpose of a file or folder that the user chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A scene to open.
    OpenScene,
    /// A volume that becomes the medium's density, centred on the origin and scaled to length 1.
    OpenVolume,
    /// Density file of the medium, whose placement is kept.
    DensityFile,
    /// Temperature file of the medium's emission.
    TemperatureFile,
    /// Table of the phase function.
    PhaseTable,
    /// Image of the environment map, by index of the light.
    EnvironmentMap(usize),
    /// File of a mesh, by index of the object.
    Mesh(usize),
    /// Destination of the scene file.
    SaveScene,
    /// Destination of the linear image.
    ExportExr,
    /// Destination of the image as shown.
    ExportPng,
    /// EXR image that serves as the reference.
    Reference,
    /// Destination folder of a report on the comparison.
    ExportReport,
}

/// Answer to the question about unsaved changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Save and continue.
    Save,
    /// Continue without saving.
    Discard,
    /// Abort the command.
    Cancel,
}

/// A command to the window.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Replaces the document by an edited one.
    Edit(Box<SceneDoc>),
    /// Edits the comparison.
    Wall(WallEdit),
    /// Selects the view that the method column edits.
    SelectView(usize),
    /// Shows the next view, or switches to the arrangement with one view at a time.
    Flip,
    /// Switches between this arrangement and the grid.
    Arrange(Arrangement),
    /// Toggles the tool that draws the region for statistics.
    ToggleBoxTool,
    /// Shows or hides the dock with statistics.
    ToggleDock,
    /// Adds a view with the method of this document.
    AddViewWith(Box<SceneDoc>),
    /// Adds views without faults to compare the selected view with, and shows the ranking.
    CompareWithCorrect,
    /// Disables all faults of the selected view.
    RemoveFaults,
    /// Picks the pixel whose samples are shown.
    Pick([usize; 2]),
    /// Replays one sample of a pixel.
    Replay([usize; 2], u64),
    /// Shows the tab with this id.
    ShowTab(&'static str),
    /// Opens a comparison preset by its name.
    OpenPreset(&'static str),
    /// Opens the lesson with this id, after asking about unsaved changes.
    OpenLesson(String),
    /// Moves by this number of steps within the open lesson.
    StepLesson(isize),
    /// Stores the answer to a prediction, by its index.
    AnswerLesson(usize),
    /// Closes the open lesson and keeps its scene.
    CloseLesson,
    /// Selects the medium that the panels of a medium show, by its index.
    SelectMedium(usize),
    /// Draws a slice of the majorant's cells over the views, at this depth from 0 (near) to 1, or none.
    ShowMajorants(Option<f32>),
    /// Shows the middle slice of the majorant's cells, or hides the slice.
    ToggleMajorants,
    /// Measures the cost of the majorant's factor for this scene.
    MeasureFactorCurve,
    /// Cancels the measurement of the majorant's factor.
    CancelFactorCurve,
    /// Toggles large text, for projectors.
    ToggleLargeType,
    /// Reverts the last edit.
    Undo,
    /// Restores the last reverted edit.
    Redo,
    /// Opens a scene, after asking about unsaved changes.
    Open(Source),
    /// Opens a file according to its extension.
    OpenAny(PathBuf),
    /// Opens the path entry for this purpose.
    Ask(Purpose),
    /// Uses a chosen file for this purpose.
    Chosen(Purpose, PathBuf),
    /// Closes the open dialog.
    CloseDialog,
    /// Answers the question about unsaved changes.
    Answer(Answer),
    /// Saves to the scene's file, or opens the path entry if it has none.
    Save,
    /// Pauses or resumes all views and the reference.
    TogglePause,
    /// Renders one pass while paused.
    Step,
    /// Restarts all views from sample 0.
    Restart,
    /// Fits the image to the canvas.
    Fit,
    /// Shows the image at this many points per pixel.
    Zoom(f32),
    /// Changes the exposure by this number of stops.
    Expose(f32),
    /// Shows or hides the left column.
    ToggleSceneColumn,
    /// Shows or hides the right column.
    ToggleMethodColumn,
    /// Shows or hides the list of shortcuts.
    ToggleShortcuts,
    /// Toggles a logarithmic radius of phase function lobes.
    ToggleLogLobe,
    /// Shows the self-check.
    OpenSelfCheck,
    /// Hides the self-check and cancels a running check.
    CloseSelfCheck,
    /// Starts the self-check with the chosen subject and effort.
    StartSelfCheck,
    /// Cancels a running self-check.
    CancelSelfCheck,
    /// Switches the theme.
    Theme(ThemePreference),
    /// Lists the grids of a file, given by its name in the document.
    ListGrids(String),
    /// Removes the message with this number.
    Dismiss(u64),
    /// Ends the program, after asking about unsaved changes.
    Quit,
}
