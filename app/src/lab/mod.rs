//! The lab's window.
//!
//! | file | does |
//! | --- | --- |
//! | `logic.rs` | reads what happened elsewhere, carries out commands; paints nothing |
//! | `files.rs` | the commands that touch files |
//! | `ui.rs` | lays the window out; changes nothing but the draft that it hands back |
//! | `tasks.rs` | work that would make a frame wait |
//! | `self_check/` | are the estimators true? |

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

/// The window: what is open, what renders, what is shown.
pub struct LabApp {
    document: Document,
    settings: Settings,
    // Dropped before the session, which it polls.
    tone_mapper: ToneMapper,
    session: Arc<Session>,
    state: ViewState,
    stats: Stats,
    /// The views.
    wall: Wall,
    /// The picture of the selected view.
    shown: Option<Arc<Snapshot>>,
    /// The pixel under the pointer, with the picture that it is on.
    pixel: Option<(PictureId, [usize; 2])>,
    zoom: f32,
    /// Where the pointer was when Tab was pressed decides whether it flips pictures or moves the focus.
    over_wall: bool,
    applied_zoom_factor: f32,
    messages: Messages,
    dialog: Option<Dialog>,
    shortcuts_open: bool,
    self_check: SelfCheck,
    factor_curve: FactorCurve,
    inspector: Inspector,
    lesson: Option<Player>,
    /// Whether the window is too narrow for a lesson, pictures and the method side by side.
    narrow: bool,
    own_lessons: Vec<Arc<Lesson>>,
    /// Since when the scene is being built, if it is.
    building_since: Option<Instant>,
    tasks: Tasks,
    grids: GridLists,
    screenshot: Option<Screenshot>,
    /// Whether the desktop's file dialogs are used beside typed paths.
    native_dialogs: bool,
    /// When the document was last edited, in egui's time.
    edited_at: f64,
    /// What waits for the scene to be saved.
    after_save: Option<Command>,
    quitting: bool,
    window_title: String,
    ui_seconds: f32,
    latency: Latency,
    logic_seconds: f64,
    /// Asks for a frame from other threads.
    repaint: egui::Context,
}

impl LabApp {
    /// Opens the window's content inside an egui context.
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
        // Columns are remembered from the last run, but they start at their tops.
        ctx.data_mut(|data| data.remove_by_type::<egui::scroll_area::State>());
        if let Some(size) = options.window {
            // eframe restores the size of the last run over the one that was asked for.
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
            // A volume or a picture is put into the first scene.
            Some(Source::File(path)) if path.extension().is_none_or(|e| e != "toml") => {
                self.open(&first);
                self.apply(Command::OpenAny(path.clone()));
            }
            Some(source) => self.open(source),
            None => self.open(&first),
        }
        self.submit_if_needed();
    }

    /// The document as it is.
    #[must_use]
    pub fn doc(&self) -> &SceneDoc {
        self.document.doc()
    }

    /// Whether there is something to save.
    #[must_use]
    pub fn is_modified(&self) -> bool {
        self.document.is_modified()
    }

    /// What the session is doing.
    #[must_use]
    pub fn state(&self) -> &ViewState {
        &self.state
    }

    /// Rates and estimates of the selected view.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// The views.
    #[must_use]
    pub fn wall(&self) -> &Wall {
        &self.wall
    }

    /// Carries out a command as if the window had been asked for it.
    pub fn request(&mut self, command: Command) {
        self.apply(command);
        self.submit_if_needed();
    }

    /// What the tabs about single paths hold.
    #[must_use]
    pub fn inspector(&self) -> &Inspector {
        &self.inspector
    }

    /// What the majorant's factor costs, as far as it was measured.
    #[must_use]
    pub fn factor_curve(&self) -> &FactorCurve {
        &self.factor_curve
    }

    /// The self-check.
    #[must_use]
    pub fn self_check(&self) -> &SelfCheck {
        &self.self_check
    }

    /// What the window has to say.
    #[must_use]
    pub fn messages(&self) -> &Messages {
        &self.messages
    }

    /// The picture that is shown, with its numbers.
    #[must_use]
    pub fn shown(&self) -> Option<&Snapshot> {
        self.shown.as_deref()
    }

    /// How the window is set up.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// How soon the window has answered lately.
    #[must_use]
    pub fn latency(&self) -> &Latency {
        &self.latency
    }

    /// Seconds that the last frame's `ui` and commands took, without rasterising.
    #[must_use]
    pub fn ui_seconds(&self) -> f32 {
        self.ui_seconds
    }
}

impl eframe::App for LabApp {
    fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
        let started = Instant::now();
        // On a software rasteriser a frame costs tens of milliseconds: leave most of the machine to rendering.
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
            // What is on the screen is from before the commands.
            ui.ctx().request_repaint();
        }
        self.ui_seconds = started.elapsed().as_secs_f32();
        self.latency.frame(self.logic_seconds + f64::from(self.ui_seconds));
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, Settings::KEY, &self.settings);
    }
}
