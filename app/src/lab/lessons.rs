//! Control of the lab by lessons.

use super::LabApp;
use crate::lessons::{Lesson, Player, RaySet, embedded, in_folder};
use crate::model::Document;
use crate::wall::dock::TABS;
use crate::wall::inspector::Through;
use majorant_core::transmittance::{Shape, TransmittanceKind};
use std::path::Path;
use std::sync::Arc;

impl LabApp {
    /// Player of the open lesson, if any.
    #[must_use]
    pub fn lesson(&self) -> Option<&Player> {
        self.lesson.as_ref()
    }

    /// Opens a lesson at the last step reached, or at its beginning if it was finished.
    pub(super) fn open_lesson(&mut self, id: &str) {
        let Some(lesson) = self.find_lesson(id) else { return };
        let reached = self.settings.lessons.get(&lesson.id).copied().unwrap_or(0);
        let step = if reached >= lesson.steps.len() { 0 } else { reached };
        self.settings.scene_column = true;
        self.lesson = Some(Player::new(lesson, step));
        self.wall.forget();
        self.show_step();
    }

    /// Finds a lesson by id, user lessons before embedded ones; an unknown id adds an error with the known
    /// ids.
    fn find_lesson(&mut self, id: &str) -> Option<Arc<Lesson>> {
        let known = || self.own_lessons.iter().chain(embedded());
        let lesson = known().find(|lesson| lesson.id == id).cloned();
        if lesson.is_none() {
            let ids: Vec<_> = known().map(|lesson| lesson.id.as_str()).collect();
            let message = format!("there is no lesson `{id}`; the lessons are {}", ids.join(", "));
            self.messages.fail(message);
        }
        lesson
    }

    /// Opens the lesson with this id, optionally at a page: `id:page`.
    pub(super) fn open_named_lesson(&mut self, named: &str) {
        let (id, page) = match named.rsplit_once(':') {
            Some((id, page)) => (id, page.parse::<usize>().ok()),
            None => (named, None),
        };
        self.open_lesson(id);
        if let (Some(page), Some(player)) = (page, &mut self.lesson) {
            player.step = page.saturating_sub(1).min(player.lesson.steps.len() - 1);
            self.show_step();
        }
        self.submit_if_needed();
    }

    /// Moves forward or back by a number of steps; beyond the last step the lesson is finished.
    pub(super) fn step_lesson(&mut self, by: isize) {
        let Some(player) = &mut self.lesson else { return };
        let Some(step) = player.step.checked_add_signed(by) else { return };
        let (id, steps) = (player.lesson.id.clone(), player.lesson.steps.len());
        player.step = step.min(steps - 1);
        let reached = self.settings.lessons.entry(id).or_default();
        *reached = (*reached).max(step);
        if step >= steps {
            self.lesson = None;
        } else {
            self.show_step();
        }
    }

    /// Stores the answer to the prediction of the current step.
    pub(super) fn answer_lesson(&mut self, choice: usize) {
        if let Some(player) = &mut self.lesson
            && let Some(answer) = player.answers.get_mut(player.step)
        {
            *answer = Some(choice);
        }
    }

    /// Adds the lessons of a folder.
    pub(super) fn add_lessons(&mut self, folder: &Path) {
        let (lessons, errors) = in_folder(folder);
        self.own_lessons.extend(lessons);
        errors.iter().for_each(|error| self.messages.fail(error.to_string()));
    }

    fn show_step(&mut self) {
        let Some((scene, stop)) = self.lesson.as_ref().and_then(|player| {
            Some((player.lesson.scene_at(player.step)?, player.lesson.stop_at(player.step)?))
        }) else {
            return;
        };
        if *self.document.doc() != scene {
            // The scene of a lesson does not count as an unsaved change.
            self.document = Document::new(scene);
        }
        self.wall.select(0);
        if let Some(wanted) = &stop.tab {
            let tab = TABS.iter().find(|known| known.id() == wanted);
            if let Some(tab) = tab {
                tab.id().clone_into(&mut self.settings.tab);
            }
            *self.dock_shown() = tab.is_some();
        }
        if stop.pick.is_some() {
            self.wall.picked = stop.pick;
        }
        if let Some(ray) = &stop.ray {
            self.set_ray(ray);
        }
    }

    fn set_ray(&mut self, set: &RaySet) {
        let ray = &mut self.inspector.ray;
        let shape = set.through.as_ref().and_then(|name| Shape::ALL.into_iter().find(|s| s.name() == name));
        ray.through = shape.map_or(Through::Pixel, Through::Shape);
        ray.kind = set.kind.as_deref().and_then(TransmittanceKind::find).or(ray.kind);
        ray.extinction = set.extinction.unwrap_or(ray.extinction);
        ray.cells = set.cells.unwrap_or(ray.cells);
        ray.factor = set.factor.unwrap_or(ray.factor);
    }
}
