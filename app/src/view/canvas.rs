//! The picture in the middle of the window and what the mouse does there.
//!
//! | gesture | effect |
//! | --- | --- |
//! | left drag | orbit about the target |
//! | right drag, Shift + left drag | move the camera sideways |
//! | Ctrl or Alt + wheel | move the camera closer or away |
//! | wheel | zoom the picture at the pointer |
//! | middle drag, Space + left drag | move the picture |
//! | double click | fit the picture |

use super::{camera_control, image_view::ImageView, readout};
use crate::theme::Palette;
use egui::{
    Color32, CursorIcon, Key, Modifiers, PointerButton, Rect, Response, Role, Sense, Stroke, StrokeKind,
    TextureHandle, Ui, Vec2, WidgetInfo, pos2,
};
use majorant_core::film::Snapshot;
use majorant_core::scene::{CameraDoc, ViewDoc};

/// What is shown.
pub struct Shown<'a> {
    /// The developed picture.
    pub texture: Option<&'a TextureHandle>,
    /// The numbers behind it.
    pub snapshot: Option<&'a Snapshot>,
    /// Whether the picture is the last good one of a scene that does not build any more.
    pub dimmed: bool,
    /// How radiance is shown.
    pub display: &'a ViewDoc,
}

/// What came of it.
pub struct Outcome {
    /// Pan and zoom afterwards.
    pub view: ImageView,
    /// The camera, if a gesture moved it.
    pub camera: Option<CameraDoc>,
    /// The pixel under the pointer.
    pub pixel: Option<[usize; 2]>,
    /// Where the canvas is, for overlays.
    pub rect: Rect,
    /// Points per pixel.
    pub zoom: f32,
}

/// Draws the picture and reads the gestures on it. `film` is the size that the document asks for.
pub fn canvas_ui(ui: &mut Ui, shown: &Shown<'_>, view: ImageView, camera: &CameraDoc, film: Vec2) -> Outcome {
    let palette = Palette::get(ui);
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Rendered image"));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 0.0, palette.canvas);
    let image = shown.snapshot.map_or(film, |s| Vec2::new(s.width as f32, s.height as f32));

    let (view, moved) = gestures(ui, &response, view, camera, rect, image);
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
    if let Some(snapshot) = shown.snapshot {
        readout::paint_values(&painter, view, rect, snapshot, shown.display);
    }
    let pixel = response.hover_pos().and_then(|at| view.pixel_at(rect, image, at));
    Outcome { view, camera: moved, pixel, rect, zoom: view.zoom(rect, image) }
}

/// Pan and zoom of the picture, and the camera if a gesture moved it.
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
    // 1 is egui's value for no gesture. It turns Ctrl + wheel into a zoom gesture; Alt + wheel arrives as plain scrolling.
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
