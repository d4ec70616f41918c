//! Camera and image size.

use super::{Column, Cx, Panel};
use crate::widgets::{Value, Vector, hint, row};
use egui::{DragValue, Ui, vec2};
use majorant_core::scene::CameraDoc;

/// See the [module](self).
pub struct Camera;

/// Sizes that are one click away.
const SIZES: &[[u32; 2]] = &[[320, 180], [640, 360], [960, 540], [1280, 720], [1920, 1080], [512, 512]];

impl Panel for Camera {
    fn id(&self) -> &'static str {
        "camera"
    }
    fn title(&self) -> &'static str {
        "Camera"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        format!("{} × {}", cx.draft.film.width, cx.draft.film.height)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let camera = &mut cx.draft.camera;
        let (opened, default) = (&cx.opened.camera, CameraDoc::default());
        Vector::new("Stands at", "Camera origin", &mut camera.origin, default.origin)
            .opened(opened.origin)
            .tip("Where the camera is")
            .show(ui);
        Vector::new("Looks at", "Camera target", &mut camera.target, default.target)
            .opened(opened.target)
            .tip("What orbiting turns about")
            .show(ui);
        Vector::new("Up", "Camera up", &mut camera.up, default.up)
            .opened(opened.up)
            .tip("Which way is up")
            .show(ui);
        Value::new("Field of view", &mut camera.fov_deg, default.fov_deg)
            .opened(opened.fov_deg)
            .unit("°")
            .range(1.0..=150.0)
            .speed(0.2)
            .tip("Horizontal field of view")
            .show(ui);
        size_ui(ui, cx);
        if cx.draft.camera != cx.opened.camera && ui.small_button("↺  Camera as opened").clicked() {
            cx.draft.camera = cx.opened.camera.clone();
        }
        hint(
            ui,
            "In the picture: drag orbits, Shift or right drag moves sideways, Ctrl + wheel comes closer.",
        );
    }
}

fn size_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    row(ui, "Image size", "Pixels; the render starts over when they change", |ui, _| {
        let film = &mut cx.draft.film;
        // A cross, the button and three gaps.
        let width = ((ui.available_width() - 56.0) * 0.5).floor();
        let side = |ui: &mut Ui, value: &mut u32, name: &str| {
            let drag = DragValue::new(value)
                .range(1..=16_384_u32)
                .speed(2.0)
                .update_while_editing(false)
                .min_size(vec2(width, ui.spacing().interact_size.y));
            ui.add(drag).accessible_name(name);
        };
        side(ui, &mut film.width, "Image width");
        ui.weak("×");
        side(ui, &mut film.height, "Image height");
        let opened = &cx.opened.film;
        ui.menu_button("▼", |ui| {
            let text = format!("As opened: {} × {}", opened.width, opened.height);
            if ui.button(text).clicked() {
                *film = opened.clone();
                ui.close();
            }
            ui.separator();
            for [w, h] in SIZES.iter().copied() {
                if ui.selectable_label([film.width, film.height] == [w, h], format!("{w} × {h}")).clicked() {
                    (film.width, film.height) = (w, h);
                    ui.close();
                }
            }
        })
        .response
        .accessible_name("Common image sizes");
    });
}
