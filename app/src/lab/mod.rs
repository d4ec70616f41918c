//! The main window.
//!
//! | file | purpose |
//! | --- | --- |
//! | `logic.rs` | reads the session and task results, executes commands; draws nothing |
//! | `files.rs` | file commands |
//! | `ui.rs` | layout of the window; changes only the draft that it returns |
//! | `tasks.rs` | work that would block a frame |
//! | `self_check/` | validation of the estimators |

mod backend;
mod columns;
mod dialogs;
mod files;
mod help;
mod icon;
mod lessons;
mod loading;
mod logic;
mod menu;
mod messages;
mod run;
pub mod self_check;
mod shortcuts;
mod status_bar;
mod tasks;
mod ui;

pub use messages::{Message, Messages, Severity};
pub use run::{LabError, LabOptions, run};

use crate::lessons::{Lesson, Player};
use crate::model::{
    Answer, Command, Document, FactorCurve, GridLists, Latency, Purpose, Settings, Source, Stats,
};
use crate::screenshot::Screenshot;
use crate::theme;
use crate::view::tone_mapper::{PictureId, ToneMapper, Waker};
use crate::wall::Wall;
use crate::wall::inspector::Inspector;
use dialogs::Dialog;
use majorant_core::film::Snapshot;
use majorant_core::io::Library;
use majorant_core::scene::SceneDoc;
use majorant_core::session::{Session, ViewId, ViewState};
use self_check::SelfCheck;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tasks::Tasks;

/// Application state of the window: open document, session, views and settings.
pub struct LabApp {
    document: Document,
    settings: Settings,
    /// Index of the medium that the panels show.
    medium: usize,
    // Dropped before the session, which it polls.
    tone_mapper: ToneMapper,
    session: Arc<Session>,
    state: ViewState,
    stats: Stats,
    /// All views of the comparison.
    wall: Wall,
    /// Image of the selected view.
    shown: Option<Arc<Snapshot>>,
    /// Pixel under the pointer, with the image that contains it.
    pixel: Option<(PictureId, [usize; 2])>,
    zoom: f32,
    /// Whether the pointer is over the views, where Tab flips the views instead of moving the focus.
    over_wall: bool,
    applied_zoom_factor: f32,
    messages: Messages,
    dialog: Option<Dialog>,
    shortcuts_open: bool,
    self_check: SelfCheck,
    factor_curve: FactorCurve,
    inspector: Inspector,
    lesson: Option<Player>,
    /// Whether the window is too narrow for a lesson, the views and the method column side by side.
    narrow: bool,
    own_lessons: Vec<Arc<Lesson>>,
    /// Start of the current scene build, if any.
    building_since: Option<Instant>,
    tasks: Tasks,
    grids: GridLists,
    screenshot: Option<Screenshot>,
    /// Whether the desktop's file dialogs are used in addition to typed paths.
    native_dialogs: bool,
    /// Time of the last edit, in egui's seconds.
    edited_at: f64,
    /// Command to execute after the scene is saved.
    after_save: Option<Command>,
    quitting: bool,
    window_title: String,
    ui_seconds: f32,
    latency: Latency,
    logic_seconds: f64,
    /// Context for requesting frames from other threads.
    repaint: egui::Context,
}

impl LabApp {
    /// Creates the window's content in an egui context.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn new(cc: &eframe::CreationContext<'_>, options: &LabOptions) -> std::io::Result<Self> {
        let ctx = &cc.egui_ctx;
        theme::install(ctx);
        let stored = cc.storage.and_then(|s| eframe::get_value(s, Settings::KEY));
        let mut settings: Settings = stored.unwrap_or_default();
        if let Some(theme) = options.theme {
            settings.theme = theme.into();
        }
        ctx.set_theme(settings.theme);
        let applied_zoom_factor = settings.zoom_factor();
        ctx.set_zoom_factor(applied_zoom_factor);
        // Columns are restored from the last run, but their scroll positions are not.
        ctx.data_mut(|data| data.remove_by_type::<egui::scroll_area::State>());
        if let Some(size) = options.window {
            // eframe overrides the requested size by that of the last run.
            ctx.send_viewport_cmd(egui::ViewportCommand::InnerSize(size.into()));
        }

        let waker = Waker::default();
        let wake = waker.clone();
        let session = Arc::new(Session::new(Library::default(), move || wake.wake())?);
        let polled = Arc::clone(&session);
        let repaint = ctx.clone();
        let poll = Box::new(move |id: ViewId| polled.state(id).snapshot);
        let tone_mapper = ToneMapper::new(waker, poll, move || repaint.request_repaint())?;
        let repaint = ctx.clone();
        let wall = Wall::new(move || repaint.request_repaint())?;
        let repaint = ctx.clone();
        let mut app = Self {
            document: Document::empty(),
            state: session.state(ViewId(0)),
            stats: Stats::default(),
            settings,
            medium: 0,
            session,
            tone_mapper,
            wall,
            shown: None,
            pixel: None,
            zoom: 1.0,
            over_wall: false,
            applied_zoom_factor,
            messages: Messages::default(),
            dialog: None,
            shortcuts_open: false,
            self_check: SelfCheck::default(),
            factor_curve: FactorCurve::default(),
            inspector: Inspector::default(),
            lesson: None,
            narrow: false,
            own_lessons: Vec::new(),
            building_since: None,
            tasks: Tasks::new(move || repaint.request_repaint()),
            grids: GridLists::default(),
            screenshot: options.screenshot.clone().map(|path| Screenshot::new(path, options.after_seconds)),
            native_dialogs: options.native_dialogs,
            edited_at: 0.0,
            after_save: None,
            quitting: false,
            window_title: String::new(),
            ui_seconds: 0.0,
            latency: Latency::default(),
            logic_seconds: 0.0,
            repaint: ctx.clone(),
        };
        app.open_first(options.open.as_ref());
        if let Some(folder) = &options.lessons {
            app.add_lessons(folder);
        }
        if let Some(named) = &options.lesson {
            app.open_named_lesson(named);
        }
        Ok(app)
    }

    fn open_first(&mut self, wanted: Option<&Source>) {
        let first = Source::first();
        match wanted {
            // A volume or an image is opened in the first scene.
            Some(Source::File(path)) if path.extension().is_none_or(|e| e != "toml") => {
                self.open(&first);
                self.apply(Command::OpenAny(path.clone()));
            }
            Some(source) => self.open(source),
            None => self.open(&first),
        }
        self.submit_if_needed();
    }

    /// Current document.
    #[must_use]
    pub fn doc(&self) -> &SceneDoc {
        self.document.doc()
    }

    /// Whether there are unsaved changes.
    #[must_use]
    pub fn is_modified(&self) -> bool {
        self.document.is_modified()
    }

    /// Session state of the selected view.
    #[must_use]
    pub fn state(&self) -> &ViewState {
        &self.state
    }

    /// Rates and estimated times of the selected view.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// All views of the comparison.
    #[must_use]
    pub fn wall(&self) -> &Wall {
        &self.wall
    }

    /// Executes a command as if a widget had issued it.
    pub fn request(&mut self, command: Command) {
        self.apply(command);
        self.submit_if_needed();
    }

    /// State of the inspection tabs.
    #[must_use]
    pub fn inspector(&self) -> &Inspector {
        &self.inspector
    }

    /// Measured cost as a function of the majorant's factor, possibly incomplete.
    #[must_use]
    pub fn factor_curve(&self) -> &FactorCurve {
        &self.factor_curve
    }

    /// State of the self-check dialog.
    #[must_use]
    pub fn self_check(&self) -> &SelfCheck {
        &self.self_check
    }

    /// Displayed messages.
    #[must_use]
    pub fn messages(&self) -> &Messages {
        &self.messages
    }

    /// Displayed snapshot of the selected view.
    #[must_use]
    pub fn shown(&self) -> Option<&Snapshot> {
        self.shown.as_deref()
    }

    /// Settings of the window.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Recent latencies of the window.
    #[must_use]
    pub fn latency(&self) -> &Latency {
        &self.latency
    }

    /// Duration of the last frame's `ui` and commands in seconds, without rasterisation.
    #[must_use]
    pub fn ui_seconds(&self) -> f32 {
        self.ui_seconds
    }
}

impl eframe::App for LabApp {
    fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
        let started = Instant::now();
        // On a software rasteriser a frame takes tens of milliseconds: most of the CPU time is left to
        // rendering.
        let frame_seconds = frame.info().cpu_usage.unwrap_or(0.0);
        self.tone_mapper.set_interval(Duration::from_secs_f32((4.0 * frame_seconds).clamp(0.0, 0.5)));
        self.update(ctx);
        self.logic_seconds = started.elapsed().as_secs_f64();
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let started = Instant::now();
        let commands = self.window_ui(ui);
        if !commands.is_empty() {
            for command in commands {
                if matches!(command, Command::Edit(_)) {
                    self.edited_at = ui.input(|i| i.time);
                }
                self.apply(command);
            }
            self.submit_if_needed();
            ui.ctx().set_theme(self.settings.theme);
            self.apply_type_size(ui.ctx());
            // The frame on the screen was drawn before the commands.
            ui.ctx().request_repaint();
        }
        self.ui_seconds = started.elapsed().as_secs_f32();
        self.latency.frame(self.logic_seconds + f64::from(self.ui_seconds));
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, Settings::KEY, &self.settings);
    }
}
