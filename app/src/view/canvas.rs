//! Image canvas and its mouse gestures.
//!
//! | gesture | effect |
//! | --- | --- |
//! | left drag | orbit about the target |
//! | right drag, Shift + left drag | pan the camera |
//! | Ctrl or Alt + wheel | dolly |
//! | wheel | zoom the image at the pointer |
//! | middle drag, Space + left drag | pan the image |
//! | double click | fit the image |
//! | click | select the view and pick the pixel |
//! | Ctrl + left drag, or left drag with the box tool | draw the box to which statistics are restricted |

use super::{camera_control, image_view::ImageView, readout};
use crate::theme::Palette;
use egui::{
    Color32, CursorIcon, Key, Modifiers, PointerButton, Rect, Response, Role, Sense, Stroke, StrokeKind,
    TextureHandle, Ui, Vec2, WidgetInfo, pos2,
};
use majorant_core::film::Snapshot;
use majorant_core::scene::{CameraDoc, ViewDoc};

/// Content of the canvas.
pub struct Shown<'a> {
    /// Tone-mapped image.
    pub texture: Option<&'a TextureHandle>,
    /// Linear pixel values of the image.
    pub snapshot: Option<&'a Snapshot>,
    /// Whether to dim the image, because the current scene failed to build.
    pub dimmed: bool,
    /// Tone mapping; without it, no values are printed on enlarged pixels.
    pub display: Option<&'a ViewDoc>,
    /// Second image right of a divider, and the divider's position as a fraction of the canvas width.
    pub wipe: Option<(Option<&'a TextureHandle>, f32)>,
    /// Box to which statistics are restricted, `[x0, y0, x1, y1]` in pixels.
    pub region: Option<[u32; 4]>,
    /// Picked pixel.
    pub picked: Option<[usize; 2]>,
    /// Whether a left drag draws the box.
    pub draws_region: bool,
    /// Accessible name.
    pub name: &'a str,
}

/// Result of one frame of the canvas.
pub struct Outcome {
    /// Pan and zoom after this frame's gestures.
    pub view: ImageView,
    /// New camera, if a gesture moved it.
    pub camera: Option<CameraDoc>,
    /// Pixel under the pointer.
    pub pixel: Option<[usize; 2]>,
    /// Rectangle of the canvas, for overlays.
    pub rect: Rect,
    /// Screen points per image pixel.
    pub zoom: f32,
    /// Clicked pixel.
    pub clicked: Option<[usize; 2]>,
    /// Whether the canvas was clicked or a drag has started.
    pub touched: bool,
    /// Finished box, `Some(None)` if an empty drag cleared it.
    pub region: Option<Option<[u32; 4]>>,
    /// New position of the divider, as a fraction of the canvas width.
    pub split: Option<f32>,
}

/// Draws the image and handles gestures. `film` is the document's resolution, used without a snapshot.
pub fn canvas_ui(ui: &mut Ui, shown: &Shown<'_>, view: ImageView, camera: &CameraDoc, film: Vec2) -> Outcome {
    let palette = Palette::get(ui);
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, shown.name));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 0.0, palette.canvas);
    let image = shown.snapshot.map_or(film, |s| Vec2::new(s.width as f32, s.height as f32));

    let region = shown.draws_region || ui.input(|i| i.modifiers.command);
    let drawn = region_gesture(ui, &response, view, rect, image, region);
    let (view, moved) = match drawn {
        Some(_) => (view, None),
        None => gestures(ui, &response, view, camera, rect, image),
    };
    let frame = view.screen_rect(rect, image);
    match shown.texture {
        Some(texture) => {
            let tint = if shown.dimmed { Color32::from_gray(90) } else { Color32::WHITE };
            let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture.id(), frame, uv, tint);
        }
        None => {
            painter.rect_filled(frame, 0.0, palette.well);
            painter.rect_stroke(frame, 0.0, Stroke::new(1.0, palette.line), StrokeKind::Inside);
        }
    }
    if let (Some(snapshot), Some(display), None) = (shown.snapshot, shown.display, shown.wipe) {
        readout::paint_values(&painter, view, rect, snapshot, display);
    }
    let split = shown.wipe.and_then(|(second, at)| wipe_ui(ui, second, at, rect, frame));
    marks(&painter, shown, drawn.flatten(), |at| view.screen_from_image(rect, image, at));
    let pixel = response.hover_pos().and_then(|at| view.pixel_at(rect, image, at));
    let finished = response.drag_stopped_by(PointerButton::Primary);
    Outcome {
        view,
        camera: moved,
        pixel,
        rect,
        zoom: view.zoom(rect, image),
        clicked: if response.clicked() { pixel } else { None },
        touched: response.clicked() || response.drag_started(),
        region: drawn.filter(|_| finished),
        split,
    }
}

/// Draws the second image right of the divider, and the divider; returns its new position if it was dragged.
fn wipe_ui(ui: &mut Ui, second: Option<&TextureHandle>, at: f32, canvas: Rect, frame: Rect) -> Option<f32> {
    let palette = Palette::get(ui);
    let x = egui::lerp(canvas.x_range(), at);
    let right = canvas.with_min_x(x);
    if let Some(texture) = second {
        let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter_at(right).image(texture.id(), frame, uv, Color32::WHITE);
    }
    let handle = Rect::from_x_y_ranges(x - 12.0..=x + 12.0, canvas.y_range());
    let response = ui.interact(handle, ui.unique_id().with("divider"), Sense::drag());
    response.widget_info(|| WidgetInfo::slider(true, f64::from(at), "Divider"));
    let colour = if response.hovered() || response.dragged() { palette.accent } else { Color32::WHITE };
    let painter = ui.painter_at(canvas);
    painter.vline(x, canvas.y_range(), Stroke::new(3.0, Color32::from_black_alpha(140)));
    painter.vline(x, canvas.y_range(), Stroke::new(1.5, colour));
    painter.circle(pos2(x, canvas.center().y), 7.0, colour, Stroke::new(1.5, Color32::from_black_alpha(160)));
    if response.hovered() || response.dragged() {
        ui.set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    let moved = response.drag_delta().x;
    (moved != 0.0).then(|| (at + moved / canvas.width().max(1.0)).clamp(0.02, 0.98))
}

/// Box that is being drawn: `Some(None)` if it is smaller than 2 × 2 pixels, `None` without a drag.
fn region_gesture(
    ui: &Ui,
    response: &Response,
    view: ImageView,
    canvas: Rect,
    image: Vec2,
    wanted: bool,
) -> Option<Option<[u32; 4]>> {
    let id = response.id.with("region");
    if response.drag_started_by(PointerButton::Primary) {
        let from = ui.input(|i| i.pointer.press_origin()).filter(|_| wanted);
        ui.data_mut(|data| match from {
            Some(from) => {
                data.insert_temp(id, from);
            }
            None => data.remove::<egui::Pos2>(id),
        });
    }
    let dragging =
        response.dragged_by(PointerButton::Primary) || response.drag_stopped_by(PointerButton::Primary);
    let from = ui.data(|data| data.get_temp::<egui::Pos2>(id)).filter(|_| dragging)?;
    if wanted {
        ui.set_cursor_icon(CursorIcon::Crosshair);
    }
    let to = ui.input(|i| i.pointer.latest_pos())?;
    let corner = |at| view.image_from_screen(canvas, image, at).to_vec2().clamp(Vec2::ZERO, image);
    let (a, b) = (corner(from), corner(to));
    let (low, high) = (a.min(b).floor(), a.max(b).ceil());
    let holds = high.x - low.x >= 2.0 && high.y - low.y >= 2.0;
    Some(holds.then_some([low.x as u32, low.y as u32, high.x as u32, high.y as u32]))
}

/// Outlines the box and the picked pixel.
fn marks(
    painter: &egui::Painter,
    shown: &Shown<'_>,
    drawn: Option<[u32; 4]>,
    place: impl Fn(egui::Pos2) -> egui::Pos2,
) {
    let outlined = |rect: Rect| {
        painter.rect_stroke(rect, 0.0, Stroke::new(3.0, Color32::from_black_alpha(170)), StrokeKind::Outside);
        painter.rect_stroke(rect, 0.0, Stroke::new(1.0, Color32::WHITE), StrokeKind::Outside);
    };
    if let Some([x0, y0, x1, y1]) = drawn.or(shown.region) {
        outlined(Rect::from_two_pos(place(pos2(x0 as f32, y0 as f32)), place(pos2(x1 as f32, y1 as f32))));
    }
    if let Some([x, y]) = shown.picked {
        let (x, y) = (x as f32, y as f32);
        let pixel = Rect::from_two_pos(place(pos2(x, y)), place(pos2(x + 1.0, y + 1.0)));
        outlined(Rect::from_center_size(pixel.center(), pixel.size().max(Vec2::splat(7.0))));
    }
}

/// Applies gestures: returns pan and zoom of the image, and the camera if a gesture moved it.
fn gestures(
    ui: &Ui,
    response: &Response,
    view: ImageView,
    camera: &CameraDoc,
    canvas: Rect,
    image: Vec2,
) -> (ImageView, Option<CameraDoc>) {
    let (modifiers, space) = ui.input(|i| (i.modifiers, i.key_down(Key::Space)));
    if response.double_clicked() {
        return (ImageView::FIT, None);
    }
    let delta = response.drag_delta();
    if delta != Vec2::ZERO {
        let width = view.screen_rect(canvas, image).width().max(1.0);
        let (dx, dy) = (delta.x / width, delta.y / width);
        let dragged = |button| response.dragged_by(button);
        if dragged(PointerButton::Middle) || (space && dragged(PointerButton::Primary)) {
            ui.set_cursor_icon(CursorIcon::Grabbing);
            return (view.panned(canvas, image, delta), None);
        }
        if dragged(PointerButton::Secondary) || (modifiers.shift && dragged(PointerButton::Primary)) {
            ui.set_cursor_icon(CursorIcon::Move);
            return (view, Some(camera_control::pan(camera, dx, dy)));
        }
        if dragged(PointerButton::Primary) {
            ui.set_cursor_icon(CursorIcon::Grabbing);
            return (view, Some(camera_control::orbit(camera, dx, dy)));
        }
    }
    let Some(at) = response.hover_pos() else { return (view, None) };
    let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
    // egui reports a factor of 1 without a gesture. It converts Ctrl + wheel into a zoom gesture, but reports
    // Alt + wheel as scrolling.
    if pinch != 1.0 {
        return (view, Some(camera_control::dolly(camera, 1.0 / pinch)));
    }
    if wheel != 0.0 {
        let factor = (wheel * 0.004).exp();
        if modifiers.matches_logically(Modifiers::ALT) {
            return (view, Some(camera_control::dolly(camera, 1.0 / factor)));
        }
        return (view.zoomed(canvas, image, at, factor), None);
    }
    (view, None)
}
