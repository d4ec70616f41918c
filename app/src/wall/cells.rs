//! Image area: views in a grid, with a divider, one at a time, or as a difference.

use super::caption::{self, caption_ui};
use super::legend::{self, legend_ui};
use super::state::{Tool, Wall};
use crate::model::Command;
use crate::model::WallEdit;
use crate::model::{Arrangement, Pair, WindowDoc};
use crate::theme::Palette;
use crate::view::canvas::{Outcome, Shown, canvas_ui};
use crate::view::cells_overlay::{self, Slice};
use crate::view::tone_mapper::PictureId;
use crate::widgets::badge;
use egui::{
    Align, Frame, Label, Layout, Margin, Rect, RichText, Stroke, StrokeKind, Ui, UiBuilder, Vec2, pos2, vec2,
};
use majorant_core::compare::label;
use majorant_core::estimator;
use majorant_core::scene::{Camera, CameraDoc, ReferenceDoc, SceneDoc};
use majorant_core::session::Status;

/// Gap between images, in points.
const GAP: f32 = 2.0;

/// Result of one frame of the image area.
#[derive(Default)]
pub struct Seen {
    /// View and its new camera, if a gesture moved it.
    pub camera: Option<(usize, CameraDoc)>,
    /// Image and pixel under the pointer.
    pub pixel: Option<(PictureId, [usize; 2])>,
    /// Screen points per image pixel.
    pub zoom: f32,
}

impl Wall {
    /// Draws the images and handles their gestures.
    pub fn cells_ui(&mut self, ui: &mut Ui, doc: &SceneDoc, commands: &mut Vec<Command>) -> Seen {
        let (mut rect, _) = ui.allocate_exact_size(ui.available_size(), egui::Sense::hover());
        ui.painter().rect_filled(rect, 0.0, Palette::get(ui).canvas);
        let pictures_shown = self.pictures_shown();
        let map = pictures_shown
            .iter()
            .find_map(|s| self.uploaded(*s)?.map.clone())
            .filter(|_| self.map().is_some());
        if let Some(image) = map {
            let strip = rect.with_min_y(rect.bottom() - legend::HEIGHT);
            legend_ui(ui, strip, &image);
            rect.max.y = strip.top();
        }
        let mut seen = Seen { zoom: 1.0, ..Seen::default() };
        match WindowDoc::of(doc).arrangement {
            Arrangement::Wipe if self.slots().len() > 1 => self.wipe_ui(ui, rect, doc, &mut seen, commands),
            Arrangement::Flip => {
                let picture = pictures_shown
                    .get(self.flipped % pictures_shown.len().max(1))
                    .copied()
                    .unwrap_or(PictureId::View(0));
                self.cell_ui(ui, rect, picture, doc, &mut seen, commands);
            }
            _ => {
                let aspect = doc.film.width as f32 / doc.film.height.max(1) as f32;
                let captioned = pictures_shown.len() > 1;
                for (cell, picture) in
                    grid(rect, pictures_shown.len(), aspect, captioned).into_iter().zip(pictures_shown)
                {
                    self.cell_ui(ui, cell, picture, doc, &mut seen, commands);
                }
            }
        }
        seen
    }

    fn cell_ui(
        &mut self,
        ui: &mut Ui,
        mut rect: Rect,
        picture: PictureId,
        doc: &SceneDoc,
        seen: &mut Seen,
        commands: &mut Vec<Command>,
    ) {
        let whole = rect;
        if doc.view_count() > 1 || picture != PictureId::View(0) || self.pictures_shown().len() > 1 {
            caption_ui(ui, rect.with_max_y(rect.top() + caption::HEIGHT), self, picture, doc, commands);
            rect.min.y += caption::HEIGHT;
        }
        let outcome = self.canvas(ui, rect, picture, None, doc);
        self.take(outcome, picture, seen, commands);
        self.remarks_ui(ui, rect, picture, doc);
        if picture == PictureId::View(self.selected()) && doc.view_count() > 1 {
            let stroke = Stroke::new(1.5, Palette::get(ui).accent);
            ui.painter().rect_stroke(whole, 0.0, stroke, StrokeKind::Inside);
        }
    }

    fn wipe_ui(
        &mut self,
        ui: &mut Ui,
        mut rect: Rect,
        doc: &SceneDoc,
        seen: &mut Seen,
        commands: &mut Vec<Command>,
    ) {
        let Pair(a, b) = WindowDoc::of(doc).pair;
        let middle = rect.center().x;
        let top = rect.with_max_y(rect.top() + caption::HEIGHT);
        caption_ui(ui, top.with_max_x(middle - 1.0), self, PictureId::View(a), doc, commands);
        caption_ui(ui, top.with_min_x(middle + 1.0), self, PictureId::View(b), doc, commands);
        rect.min.y += caption::HEIGHT;
        let outcome = self.canvas(ui, rect, PictureId::View(a), Some(PictureId::View(b)), doc);
        if let Some(split) = outcome.split {
            self.split = split;
        }
        self.take(outcome, PictureId::View(a), seen, commands);
        // The name of each view is drawn at its side of the divider.
        let x = egui::lerp(rect.x_range(), self.split);
        let mut side = |rect: Rect, layout: Layout, view: usize| {
            let mut child = ui.new_child(UiBuilder::new().max_rect(rect.shrink(8.0)).layout(layout));
            child.set_clip_rect(rect);
            let strip = Frame::NONE
                .fill(Palette::get(&child).panel.gamma_multiply(0.85))
                .inner_margin(Margin::symmetric(4, 2));
            strip.corner_radius(4).show(&mut child, |ui| {
                ui.horizontal(|ui| {
                    caption::chip(ui, &label(view), crate::theme::view_colour(view));
                    let name = RichText::new(caption::name(doc, view)).small().color(Palette::get(ui).strong);
                    ui.add(Label::new(name).selectable(false));
                });
            });
        };
        let bottom = rect.with_min_y(rect.bottom() - 38.0);
        side(bottom.with_max_x(x), Layout::right_to_left(Align::Center), a);
        side(bottom.with_min_x(x), Layout::left_to_right(Align::Center), b);
    }

    fn canvas(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        picture: PictureId,
        second: Option<PictureId>,
        doc: &SceneDoc,
    ) -> Outcome {
        let view = match picture {
            PictureId::View(view) => view,
            PictureId::Reference | PictureId::Difference => 0,
        };
        let camera = doc.view_doc(view).map_or_else(|| doc.camera.clone(), |d| d.camera);
        let display = self.display(picture);
        let uploaded = self.uploaded(picture);
        let failed = matches!(self.slots().get(view).map(|s| &s.state.status), Some(Status::Failed(_)));
        let name = match picture {
            PictureId::View(0) if doc.view_count() == 1 => "Rendered image".to_owned(),
            PictureId::View(view) => format!("View {}", label(view)),
            PictureId::Reference => "Reference".to_owned(),
            PictureId::Difference => "Difference".to_owned(),
        };
        let shown = Shown {
            texture: uploaded.map(|h| &h.texture),
            snapshot: uploaded.and_then(|h| h.snapshot.as_deref()),
            dimmed: failed && picture != PictureId::Reference,
            display: uploaded.is_some_and(|h| h.map.is_none()).then_some(&display),
            wipe: second.map(|s| (self.uploaded(s).map(|h| &h.texture), self.split)),
            region: doc.compare.region,
            picked: self.picked,
            draws_region: self.tool == Tool::Region,
            name: &name,
        };
        let film = vec2(doc.film.width as f32, doc.film.height as f32);
        let mut child = ui.new_child(UiBuilder::new().max_rect(rect).id_salt(("cell", picture)));
        child.set_clip_rect(rect.intersect(ui.clip_rect()));
        let outcome = canvas_ui(&mut child, &shown, self.zoom_of(picture), &camera, film);
        if let (Some(depth), Some(probe), PictureId::View(_)) =
            (self.majorant_slice, self.slots().get(view).and_then(|s| s.state.probe.as_ref()), picture)
        {
            let eye = Camera::new(&camera, doc.film.width, doc.film.height);
            let slice = Slice { medium: self.medium, depth };
            cells_overlay::paint(&child, rect, outcome.view, film, probe, &eye, slice);
        }
        outcome
    }

    fn take(&mut self, outcome: Outcome, picture: PictureId, seen: &mut Seen, commands: &mut Vec<Command>) {
        if outcome.view != self.zoom_of(picture) {
            self.set_zoom(picture, outcome.view);
        }
        seen.zoom = outcome.zoom;
        if let Some(pixel) = outcome.pixel {
            seen.pixel = Some((picture, pixel));
        }
        if let Some(pixel) = outcome.clicked {
            self.picked = if self.picked == Some(pixel) { None } else { Some(pixel) };
        }
        if let Some(region) = outcome.region {
            commands.push(Command::Wall(WallEdit::Region(region)));
            self.tool = Tool::Camera;
        }
        if let PictureId::View(view) = picture {
            if outcome.touched {
                commands.push(Command::SelectView(view));
            }
            if let Some(camera) = outcome.camera {
                seen.camera = Some((view, camera));
            }
        }
    }

    /// Draws badges and messages over an image: bias, preview, build failure, missing reference or map.
    fn remarks_ui(&self, ui: &mut Ui, canvas: Rect, picture: PictureId, doc: &SceneDoc) {
        let palette = Palette::get(ui);
        let area = Rect::from_min_size(canvas.min + vec2(10.0, 8.0), vec2(canvas.width() - 20.0, 22.0));
        let mut child =
            ui.new_child(UiBuilder::new().max_rect(area).layout(Layout::left_to_right(Align::Center)));
        if picture == PictureId::Reference && self.uploaded(picture).is_none() {
            let state = self.reference_state();
            let text = state.problem.unwrap_or_else(|| {
                let n = majorant_core::compare::LEAST_SAMPLES;
                format!("The reference is shown and used from {n} samples per pixel on.")
            });
            return empty_ui(ui, canvas, "No reference yet", &text);
        }
        if let PictureId::View(view) = picture {
            let own = doc.view_doc(view);
            let bias = own.as_ref().and_then(|d| estimator::find(&d.estimator.id)?.bias(d));
            if let Some(reason) = bias {
                badge(&mut child, palette.error, &format!("biased: {reason}"));
            }
            let uploaded = self.uploaded(picture);
            if uploaded.and_then(|h| h.snapshot.as_ref()).is_some_and(|s| s.coarse.is_some()) {
                badge(&mut child, palette.accent, "preview");
            }
            if let Some(Status::Failed(text)) = self.slots().get(view).map(|s| &s.state.status) {
                // The same message is shown for one view only.
                let said =
                    self.slots().iter().take(view).any(|s| s.state.status == Status::Failed(text.clone()));
                if !said || WindowDoc::of(doc).arrangement != Arrangement::Grid {
                    failure_ui(ui, canvas, text, uploaded.is_some());
                }
                return;
            }
        }
        if let Some(map) = self.map().filter(|_| self.uploaded(picture).is_none_or(|h| h.map.is_none())) {
            let unchosen = doc.compare.reference == ReferenceDoc::None && !map.is_test();
            let text = match (map.needs_reference, picture) {
                (true, PictureId::View(_)) if unchosen => "Errors need a reference: choose one above.",
                (true, PictureId::View(_)) => {
                    "There is nothing to compare this view with yet: choose a reference above, or add a view that shows \
                     the same image."
                }
                _ => "This map needs a few more samples per pixel.",
            };
            empty_ui(ui, canvas, map.name, text);
        }
    }
}

/// Layout of `count` cells that maximizes the size of images with a given aspect ratio.
fn grid(rect: Rect, count: usize, aspect: f32, captioned: bool) -> Vec<Rect> {
    let count = count.max(1);
    let caption = if captioned { caption::HEIGHT } else { 0.0 };
    let size = |columns: usize| {
        let rows = count.div_ceil(columns);
        vec2(
            (rect.width() - GAP * (columns - 1) as f32) / columns as f32,
            (rect.height() - GAP * (rows - 1) as f32) / rows as f32,
        )
    };
    let picture = |columns: usize| {
        let room = size(columns) - vec2(0.0, caption);
        room.x.min(room.y * aspect)
    };
    // Empty cells are penalized: full rows are preferred to slightly larger images.
    let score = |columns: usize| {
        let cells = columns * count.div_ceil(columns);
        picture(columns) * (count as f32 / cells as f32).sqrt()
    };
    let columns = (1..=count).max_by(|a, b| score(*a).total_cmp(&score(*b))).unwrap_or(1);
    let cell: Vec2 = size(columns);
    (0..count)
        .map(|i| {
            let at = vec2((i % columns) as f32, (i / columns) as f32);
            Rect::from_min_size(rect.min + at * (cell + Vec2::splat(GAP)), cell)
        })
        .collect()
}

/// Draws a title and an explanation in the middle of an empty canvas.
fn empty_ui(ui: &mut Ui, canvas: Rect, title: &str, text: &str) {
    let palette = Palette::get(ui);
    let width = (canvas.width() - 32.0).clamp(100.0, 320.0);
    let area = Rect::from_min_size(
        pos2(canvas.center().x - 0.5 * width, canvas.center().y - 30.0),
        vec2(width, 60.0),
    );
    let mut child = ui.new_child(UiBuilder::new().max_rect(area).layout(Layout::top_down(Align::Center)));
    child.set_clip_rect(canvas);
    child.add(Label::new(RichText::new(title).color(palette.strong)).selectable(false));
    child.add(Label::new(RichText::new(text).small().color(palette.text)).wrap().selectable(false));
}

/// Draws the message of a failed build over the last image.
fn failure_ui(ui: &mut Ui, canvas: Rect, text: &str, pictured: bool) {
    let palette = Palette::get(ui);
    let small = canvas.width() < 400.0;
    let (gap, margin): (f32, i8) = if small { (6.0, 8) } else { (44.0, 14) };
    let width = (canvas.width() - 2.0 * gap.min(32.0)).clamp(120.0, 560.0);
    let left = canvas.left() + 0.5 * (canvas.width() - width);
    let area = Rect::from_min_size(pos2(left, canvas.top() + gap), vec2(width, 10.0));
    let mut child = ui.new_child(UiBuilder::new().max_rect(area));
    child.set_clip_rect(canvas);
    let frame = Frame::popup(child.style())
        .inner_margin(Margin::same(margin))
        .stroke(Stroke::new(1.0, palette.error));
    frame.show(&mut child, |ui| {
        ui.set_width(width - 2.0 * f32::from(margin));
        ui.label(RichText::new("This scene cannot be rendered").color(palette.error));
        ui.add(Label::new(RichText::new(text).color(palette.strong)).wrap());
        if small {
            return;
        }
        let kept = "Your edits are kept: correct them, or undo them with Ctrl + Z.";
        let kept =
            if pictured { format!("The last image is shown, dimmed. {kept}") } else { kept.to_owned() };
        ui.add(Label::new(RichText::new(kept).small().color(palette.weak)).wrap());
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_do_not_overlap_and_pictures_are_as_large_as_can_be() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(800.0, 600.0));
        for count in 1..=7 {
            let cells = grid(rect, count, 4.0 / 3.0, true);
            assert_eq!(cells.len(), count);
            for (i, a) in cells.iter().enumerate() {
                assert!(rect.expand(0.1).contains_rect(*a));
                assert!(cells[..i].iter().all(|b| !a.shrink(0.5).intersects(b.shrink(0.5))));
            }
        }
        // Two wide images are stacked, two tall ones are placed side by side.
        assert_eq!(grid(rect, 2, 3.0, false)[1].left(), rect.left());
        assert_eq!(grid(rect, 2, 0.5, false)[1].top(), rect.top());
    }
}
