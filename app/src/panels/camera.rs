//! Camera and image size.

use super::{Column, Cx, Panel};
use crate::widgets::{Value, Vector, hint, key, row, switch, whole};
use egui::Ui;

/// Panel of the camera and the image size.
pub struct Camera;

/// Maximum side of the image that dragging reaches, in pixels.
const MOST: u32 = 16_384;

/// Common image sizes of the menu.
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
        let opened = &cx.opened.camera;
        Vector::of(key("camera.origin"), "Camera origin", &mut camera.origin).opened(opened.origin).show(ui);
        Vector::of(key("camera.target"), "Camera target", &mut camera.target).opened(opened.target).show(ui);
        Vector::of(key("camera.up"), "Camera up", &mut camera.up).opened(opened.up).show(ui);
        Value::of(key("camera.fov_deg"), &mut camera.fov_deg)
            .opened(opened.fov_deg)
            .within(1.0..=150.0)
            .speed(0.2)
            .show(ui);
        let mirror = key("camera.mirror");
        switch(ui, mirror.label, "Mirror the camera", &mut camera.mirror, "left and right", mirror.tip);
        size_ui(ui, cx);
        if cx.draft.camera != cx.opened.camera && ui.small_button("↺  Camera as opened").clicked() {
            cx.draft.camera = cx.opened.camera.clone();
        }
        hint(ui, "In the image: drag orbits, Shift or right drag pans, Ctrl + wheel dollies.");
    }
}

fn size_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    row(ui, "Image size", "Pixels; changes restart the render", |ui, _| {
        let film = &mut cx.draft.film;
        // Less a cross, the button and three gaps.
        let width = ((ui.available_width() - 56.0) * 0.5).floor();
        whole(ui, key("film.width"), &mut film.width, MOST, width);
        ui.weak("×");
        whole(ui, key("film.height"), &mut film.height, MOST, width);
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
