//! Work between frames: reads the session and the results of tasks, and executes commands.

use super::dialogs::Dialog;
use super::tasks::Outcome;
use super::{Answer, Command, LabApp, Severity};
use crate::model::{Arrangement, WindowDoc};
use crate::model::{Document, Source, resolved};
use crate::model::{WallEdit, edited};
use crate::panels::faults;
use crate::view::image_view::ImageView;
use crate::view::tone_mapper::PictureId;
use crate::wall::Tool;
use crate::wall::presets::PRESETS;
use egui::{Context, ViewportCommand};
use majorant_core::scene::SceneDoc;
use majorant_core::session::ViewId;
use std::path::Path;
use std::time::Duration;

/// Time without changes after which an edit becomes an undo step.
const SETTLED_SECONDS: f64 = 0.25;

impl LabApp {
    /// Setting that shows the dock below the present number of views.
    pub(super) fn dock_shown(&mut self) -> &mut bool {
        if self.doc().view_count() > 1 { &mut self.settings.dock } else { &mut self.settings.dock_alone }
    }

    /// Whether the method column is shown. A lesson hides it in a narrow window.
    pub(super) fn method_shown(&self) -> bool {
        match &self.lesson {
            Some(player) if self.narrow => player.with_method,
            _ => self.settings.method_column,
        }
    }

    /// Processes all events since the last frame.
    pub(super) fn update(&mut self, ctx: &Context) {
        let prints = self.tone_mapper.take();
        self.wall.update(ctx, &self.session, prints);
        self.read_selected();
        self.shown =
            self.wall.uploaded(PictureId::View(self.wall.selected())).and_then(|h| h.snapshot.clone());
        self.latency.cancelled(self.state.generation, self.state.cancelled_seconds);
        if let Some(shown) = &self.shown {
            self.latency.shown(shown.generation);
        }
        self.tone_mapper.order(self.wall.order());
        self.self_check.poll();
        self.factor_curve.poll();
        for outcome in self.tasks.take() {
            self.finish(outcome);
        }
        if let Some(left) = self.messages.expire() {
            ctx.request_repaint_after(left);
        }
        self.take_dropped_files(ctx);
        self.keep_history(ctx);
        self.guard_window(ctx);
        self.submit_if_needed();
        // The state of a view that was just submitted has changed.
        self.read_selected();
        if let Some(screenshot) = &mut self.screenshot
            && let Some(problem) = screenshot.update(ctx)
        {
            self.messages.fail(problem);
        }
    }

    /// Copies state and statistics of the selected view.
    fn read_selected(&mut self) {
        if let Some(slot) = self.wall.selected_slot() {
            self.state = slot.state.clone();
            self.stats = slot.stats.clone();
        }
    }

    fn finish(&mut self, outcome: Outcome) {
        match outcome {
            Outcome::Picked(purpose, picked) => {
                let waiting = matches!(&self.dialog, Some(Dialog::Path(p)) if p.purpose == purpose);
                if let (true, Some(path)) = (waiting, picked) {
                    self.apply(Command::Chosen(purpose, path));
                }
            }
            Outcome::Listed(file, Ok(names)) => self.grids.finish(file, names),
            Outcome::Listed(file, Err(_)) => {
                // The session reports the error of the file; the list of grids stays empty.
                self.grids.finish(file, Vec::new());
            }
            Outcome::Volume(path, Ok(look)) => self.fill_with(&path, &look),
            Outcome::Volume(_, Err(problem)) => self.messages.fail(problem),
            Outcome::Exported(path, Ok(())) => {
                self.messages.say(Severity::Done, format!("Wrote {}.", path.display()));
            }
            Outcome::Exported(_, Err(problem)) => self.messages.fail(problem),
            Outcome::Reference(path, read) => {
                for notice in read.iter().flat_map(|reference| &reference.notices) {
                    self.messages.say(Severity::Done, notice.clone());
                }
                self.wall.finish_reading(&path, read);
            }
        }
    }

    fn take_dropped_files(&mut self, ctx: &Context) {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        for file in dropped {
            self.apply(Command::OpenAny(file.path().to_owned()));
        }
    }

    /// Records settled states as undo steps: a drag or a typed number is one step.
    fn keep_history(&mut self, ctx: &Context) {
        let typing = ctx.text_edit_focused();
        let (now, down, pressed) = ctx.input(|i| (i.time, i.pointer.any_down(), i.pointer.any_pressed()));
        let rested = now - self.edited_at >= SETTLED_SECONDS;
        // A new gesture ends the previous edit, even after a short pause.
        let settled = pressed || (!down && !typing && rested);
        if self.document.observe(settled) && !down {
            ctx.request_repaint_after(Duration::from_secs_f64(SETTLED_SECONDS));
        }
    }

    /// Asks about unsaved changes before the window closes, and keeps its title up to date.
    fn guard_window(&mut self, ctx: &Context) {
        let asked = ctx.input(|i| i.viewport().close_requested());
        if asked && !self.quitting && self.screenshot.is_none() && self.is_modified() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.apply(Command::Quit);
        } else if self.quitting && !asked {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
        let mark = if self.is_modified() { "• " } else { "" };
        let title = format!("{mark}{} – Majorant", self.name());
        // Not every platform reports the title, and every viewport command requests another frame.
        if self.window_title != title {
            self.window_title.clone_from(&title);
            ctx.send_viewport_cmd(ViewportCommand::Title(title));
        }
    }

    /// Name of the scene: its file name, or its title.
    pub(super) fn name(&self) -> String {
        let file = self.document.path().and_then(Path::file_name);
        file.map_or_else(|| self.doc().title.clone(), |name| name.to_string_lossy().into_owned())
    }

    /// Executes a command.
    pub(super) fn apply(&mut self, command: Command) {
        match command {
            Command::Edit(doc) => self.document.edit(*doc),
            Command::Undo => self.document.undo(),
            Command::Redo => self.document.redo(),
            Command::Expose(stops) => {
                let mut doc = self.doc().clone();
                doc.view.exposure_ev = (doc.view.exposure_ev + stops).clamp(-16.0, 16.0);
                self.document.edit(doc);
            }
            Command::Open(source) => self.guarded(Command::Open(source)),
            Command::Quit => self.guarded(Command::Quit),
            Command::Answer(answer) => self.answered(answer),
            Command::OpenAny(path) => self.open_any(path),
            Command::Ask(purpose) => self.ask(purpose),
            Command::Chosen(purpose, path) => {
                self.dialog = None;
                self.chosen(purpose, path);
            }
            Command::CloseDialog => (self.dialog, self.after_save) = (None, None),
            Command::Save => self.save_scene(),
            Command::TogglePause => {
                let paused = self.wall.is_paused();
                self.wall.set_paused(!paused, &self.session);
            }
            Command::Step => self.each_view(|session, id| session.step(id)),
            Command::Restart => self.each_view(|session, id| session.restart(id)),
            Command::Fit => self.wall.set_zoom_of_all(ImageView::FIT),
            Command::Zoom(zoom) => {
                let size = egui::vec2(self.doc().film.width as f32, self.doc().film.height as f32);
                self.wall.set_zoom_of_all(ImageView::at_zoom(zoom, size));
            }
            Command::Wall(edit) => self.document.edit(edited(self.doc(), &edit)),
            Command::SelectView(view) => self.wall.select(view),
            Command::Flip => self.flip(),
            Command::Arrange(arrangement) => {
                let now = WindowDoc::of(self.doc()).arrangement;
                let next = if now == arrangement { Arrangement::Grid } else { arrangement };
                self.apply(Command::Wall(WallEdit::Arrange(next)));
            }
            Command::ToggleBoxTool => {
                self.wall.tool = if self.wall.tool == Tool::Region { Tool::Camera } else { Tool::Region };
            }
            Command::ToggleDock => *self.dock_shown() ^= true,
            Command::AddViewWith(doc) => {
                self.apply(Command::Wall(WallEdit::AddView(doc)));
                self.apply(Command::ShowTab("ranking"));
            }
            Command::CompareWithCorrect => {
                let selected = self.wall.selected();
                self.apply(Command::Wall(WallEdit::CompareWithCorrect(selected)));
                self.apply(Command::ShowTab("ranking"));
            }
            Command::RemoveFaults => {
                let selected = self.wall.selected();
                if let Some(mut doc) = self.doc().view_doc(selected) {
                    faults::remove(&mut doc);
                    self.document.edit(self.doc().with_view_doc(selected, &doc));
                }
            }
            Command::Pick(pixel) => self.wall.picked = Some(pixel),
            Command::Replay(pixel, sample) => {
                self.wall.picked = Some(pixel);
                self.inspector.path.choose(pixel, sample);
                self.apply(Command::ShowTab("path"));
            }
            Command::SelectMedium(index) => self.medium = index,
            Command::ShowMajorants(slice) => self.settings.majorant_slice = slice,
            Command::ToggleMajorants => {
                let shown = self.settings.majorant_slice.is_some();
                self.settings.majorant_slice = (!shown).then_some(0.5);
            }
            Command::ShowTab(id) => {
                self.settings.tab = id.to_owned();
                *self.dock_shown() = true;
            }
            Command::OpenPreset(name) => self.guarded(Command::OpenPreset(name)),
            Command::OpenLesson(lesson) => self.guarded(Command::OpenLesson(lesson)),
            Command::StepLesson(by) => self.step_lesson(by),
            Command::AnswerLesson(choice) => self.answer_lesson(choice),
            Command::CloseLesson => self.lesson = None,
            Command::ToggleLargeType => {
                let large = !self.settings.large_type;
                self.settings.large_type = large;
                // On a projector the views need the room of the columns.
                (self.settings.scene_column, self.settings.method_column) = (!large, !large);
            }
            Command::ToggleSceneColumn => self.settings.scene_column ^= true,
            Command::ToggleMethodColumn => match &mut self.lesson {
                Some(player) if self.narrow => player.with_method ^= true,
                _ => self.settings.method_column ^= true,
            },
            Command::ToggleShortcuts => self.shortcuts_open ^= true,
            Command::OpenSelfCheck => self.self_check.show(&self.document.resolved()),
            Command::CloseSelfCheck => {
                self.self_check.cancel();
                self.self_check.open = false;
            }
            Command::StartSelfCheck => {
                let (name, doc, repaint) = (self.name(), self.document.resolved(), self.repaint.clone());
                self.self_check.start(&name, &doc, move || repaint.request_repaint());
            }
            Command::CancelSelfCheck => self.self_check.cancel(),
            Command::MeasureFactorCurve => {
                let selected = self.wall.selected();
                let of_view = |doc: &SceneDoc| doc.view_doc(selected).unwrap_or_else(|| doc.clone());
                let (doc, resolved) = (of_view(self.document.doc()), of_view(&self.document.resolved()));
                let repaint = self.repaint.clone();
                self.factor_curve.start(&doc, resolved, move || repaint.request_repaint());
            }
            Command::CancelFactorCurve => self.factor_curve.cancel(),
            Command::ToggleLogLobe => self.settings.log_lobe ^= true,
            Command::Theme(theme) => self.settings.theme = theme,
            Command::ListGrids(file) => self.list_grids(file),
            Command::Dismiss(number) => self.messages.dismiss(number),
        }
    }

    /// Executes a command that discards unsaved changes, after confirmation if there are any.
    fn guarded(&mut self, command: Command) {
        if self.is_modified() {
            self.dialog = Some(Dialog::Unsaved(Box::new(command)));
        } else {
            self.proceed(command);
        }
    }

    /// Executes a command that discards unsaved changes.
    pub(super) fn proceed(&mut self, command: Command) {
        match command {
            Command::Open(source) => self.open(&source),
            Command::OpenPreset(name) => self.open_preset(name),
            Command::OpenLesson(id) => self.open_lesson(&id),
            Command::Quit => self.quitting = true,
            _ => {}
        }
    }

    fn answered(&mut self, answer: Answer) {
        let Some(Dialog::Unsaved(then)) = self.dialog.take() else { return };
        match answer {
            Answer::Cancel => {}
            Answer::Discard => self.proceed(*then),
            Answer::Save => {
                // A scene without a file needs a path first.
                self.after_save = Some(*then);
                self.save_scene();
            }
        }
    }

    /// Applies the text size as zoom factor of the interface, which Ctrl + plus and minus change as well.
    pub(super) fn apply_type_size(&mut self, ctx: &Context) {
        let wanted = self.settings.zoom_factor();
        if self.applied_zoom_factor != wanted {
            self.applied_zoom_factor = wanted;
            ctx.set_zoom_factor(wanted);
        }
    }

    /// Shows the next view, or switches to the arrangement with one view at a time.
    fn flip(&mut self) {
        if WindowDoc::of(self.doc()).arrangement == Arrangement::Flip {
            let pictures_shown = self.wall.pictures_shown();
            self.wall.flipped = (self.wall.flipped + 1) % pictures_shown.len().max(1);
            if let Some(PictureId::View(view)) = pictures_shown.get(self.wall.flipped) {
                self.wall.select(*view);
            }
        } else {
            self.apply(Command::Wall(WallEdit::Arrange(Arrangement::Flip)));
        }
    }

    fn each_view(&self, act: impl Fn(&majorant_core::session::Session, ViewId)) {
        for id in self.wall.ids() {
            act(&self.session, id);
        }
    }

    /// Submits to the session what changed, as determined by comparing documents.
    pub(super) fn submit_if_needed(&mut self) {
        let (doc, base) = (self.document.doc(), self.document.base());
        let wanted = self.wall.submit(doc, base, |doc| resolved(doc, base), &self.session);
        if let Some(slot) = self.wall.selected_slot() {
            self.latency.edited(self.session.state(slot.id).generation);
        }
        if let Some(path) = wanted {
            let library = majorant_core::io::Library::default().with_base(base);
            let read = self.tasks.read_reference(path, doc.clone(), library);
            if let Err(problem) = read {
                self.messages.fail(problem);
            }
        }
    }

    fn open_preset(&mut self, name: &str) {
        match PRESETS.iter().find(|p| p.name == name).map(crate::wall::presets::Preset::doc) {
            Some(Ok(doc)) => self.show(Document::new(doc)),
            Some(Err(problem)) => self.messages.fail(problem),
            None => {}
        }
    }

    fn show(&mut self, document: Document) {
        self.document = document;
        self.wall.forget();
        self.grids.clear();
    }

    /// Opens a scene; the open one is kept if this fails.
    pub(super) fn open(&mut self, source: &Source) {
        match Document::open(source) {
            Ok(document) => {
                if let Some(path) = document.path() {
                    self.settings.remember(path);
                }
                self.show(document);
            }
            Err(problem) => self.messages.fail(problem),
        }
    }
}
