//! Everything that the window can be asked to do. Widgets push commands; `logic` carries them out.

use super::{Arrangement, Source, WallEdit};
use egui::ThemePreference;
use majorant_core::scene::SceneDoc;
use std::path::PathBuf;

/// What a file is wanted for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A scene to open.
    OpenScene,
    /// A volume that becomes the medium's density, fitted to the origin.
    OpenVolume,
    /// The density file of the medium as it is placed.
    DensityFile,
    /// The temperature file of the medium's emission.
    TemperatureFile,
    /// The table of the phase function.
    PhaseTable,
    /// The picture of the environment map with this index.
    EnvironmentMap(usize),
    /// Where to save the scene.
    SaveScene,
    /// Where to write the linear picture.
    ExportExr,
    /// Where to write the picture as it is shown.
    ExportPng,
    /// An EXR picture that errors are measured against.
    Reference,
    /// The folder that a report on the comparison is written into.
    ExportReport,
}

/// How a question about unsaved changes was answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Save, then go on.
    Save,
    /// Go on without saving.
    Discard,
    /// Do not go on.
    Cancel,
}

/// A request to the window.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Replaces the document by an edited one.
    Edit(Box<SceneDoc>),
    /// Edits the comparison.
    Wall(WallEdit),
    /// Chooses the view that the method column edits.
    SelectView(usize),
    /// Shows the next view, or has the wall show one at a time.
    Flip,
    /// Switches between an arrangement and side by side.
    Arrange(Arrangement),
    /// Whether a drag on a picture draws the box that numbers are about.
    ToggleBoxTool,
    /// Shows or hides the numbers.
    ToggleDock,
    /// One more view, with the method of this document.
    TryBeside(Box<SceneDoc>),
    /// Shows the selected view beside what it should be.
    HoldAgainstRight,
    /// Takes planted mistakes out of the selected view.
    TakeFaultOut,
    /// Shows the samples of a pixel.
    Pick([usize; 2]),
    /// Replays one sample of a pixel.
    Replay([usize; 2], u64),
    /// Shows numbers of this kind.
    ShowTab(&'static str),
    /// Opens a comparison that is set up already, by its name.
    OpenPreset(&'static str),
    /// Opens the lesson with this id, after asking about unsaved changes.
    OpenLesson(String),
    /// Goes on in it, or back.
    TurnLesson(isize),
    /// Takes a prediction down.
    AnswerLesson(usize),
    /// Closes it; the scene stays.
    CloseLesson,
    /// Draws a slice of the majorant's cells over the pictures, or none.
    ShowMajorants(Option<f32>),
    /// Shows the slice in the middle, or hides it.
    ToggleMajorants,
    /// Measures what the majorant's factor costs in this scene.
    MeasureFactorCurve,
    /// Ends that.
    CancelFactorCurve,
    /// Larger type, for projectors.
    ToggleLargeType,
    /// Takes the last edit back.
    Undo,
    /// Does it again.
    Redo,
    /// Opens a scene, after asking about unsaved changes.
    Open(Source),
    /// Takes a file for what its extension says.
    OpenAny(PathBuf),
    /// Asks for a file.
    Ask(Purpose),
    /// A file was chosen.
    Chosen(Purpose, PathBuf),
    /// Closes whatever is being asked.
    CloseDialog,
    /// The answer to the question about unsaved changes.
    Answer(Answer),
    /// Saves to the scene's own file, or asks for one.
    Save,
    /// Pauses or goes on.
    TogglePause,
    /// One pass while paused.
    Step,
    /// Starts over.
    Restart,
    /// Fits the picture to the canvas.
    Fit,
    /// Shows the picture at this many points per pixel.
    Zoom(f32),
    /// Moves the exposure by stops.
    Expose(f32),
    /// Shows or hides the left column.
    ToggleSceneColumn,
    /// Shows or hides the right column.
    ToggleMethodColumn,
    /// Shows or hides the list of shortcuts.
    ToggleShortcuts,
    /// Lobes with a logarithmic or linear radius.
    ToggleLogLobe,
    /// Shows the self-check.
    OpenSelfCheck,
    /// Hides it; a check that runs is cancelled.
    CloseSelfCheck,
    /// Starts the check that is chosen.
    StartSelfCheck,
    /// Ends the check that runs.
    CancelSelfCheck,
    /// Switches the theme.
    Theme(ThemePreference),
    /// Lists the grids of a file as the document names it.
    ListGrids(String),
    /// Removes the message with this number.
    Dismiss(u64),
    /// Ends the program, after asking about unsaved changes.
    Quit,
}
