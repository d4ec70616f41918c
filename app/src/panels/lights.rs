//! List of lights, to which lights are added from templates.

use super::{Column, Cx, Panel, light_fields};
use crate::model::{Command, Purpose};
use crate::theme::Palette;
use crate::widgets::{callout, hint};
use egui::collapsing_header::CollapsingState;
use egui::{Align, Button, Color32, Layout, RichText, Ui};
use majorant_core::scene::LightDoc;

/// Panel of the lights.
pub struct Lights;

impl Panel for Lights {
    fn id(&self) -> &'static str {
        "lights"
    }
    fn title(&self) -> &'static str {
        "Lights"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        let kinds: Vec<_> = cx.draft.lights.iter().map(|l| l.kind_name().to_lowercase()).collect();
        match kinds.len() {
            0 => "none".into(),
            1..=2 => kinds.join(", "),
            n => n.to_string(),
        }
    }
    fn alert(&self, cx: &Cx<'_>, palette: &Palette) -> Option<Color32> {
        cx.draft.lights.is_empty().then_some(palette.warning)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        if cx.draft.lights.is_empty() {
            callout(ui, Palette::get(ui).warning, "No light: the image is black. Add one.");
        }
        let mut change = None;
        for index in 0..cx.draft.lights.len() {
            if let Some(made) = item_ui(ui, cx, index) {
                change = Some((index, made));
            }
        }
        match change {
            Some((index, Change::Remove)) => {
                cx.draft.lights.remove(index);
            }
            Some((index, Change::Duplicate)) => {
                let copy = cx.draft.lights[index].clone();
                cx.draft.lights.insert(index + 1, copy);
            }
            None => {}
        }
        add_ui(ui, "Add light", LightDoc::templates(), |light| {
            // A map without an image cannot be rendered, so that the path entry opens immediately.
            if matches!(light, LightDoc::EnvironmentMap { .. }) {
                cx.commands.push(Command::Ask(Purpose::EnvironmentMap(cx.draft.lights.len())));
            }
            cx.draft.lights.push(light);
        });
        if cx.draft.lights.len() > 1 {
            hint(ui, "Each connection samples one light; the camera sees all visible lights.");
        }
    }
}

/// Change requested by the buttons of a list item.
pub(super) enum Change {
    Duplicate,
    Remove,
}

/// Shows a menu of templates.
pub(super) fn add_ui<T>(ui: &mut Ui, name: &str, templates: Vec<(&'static str, T)>, mut add: impl FnMut(T)) {
    ui.menu_button(format!("+  {name}"), |ui| {
        for (kind, template) in templates {
            if ui.button(kind).clicked() {
                add(template);
                ui.close();
            }
        }
    });
}

/// Shows the heading of a list item with its buttons, and its body while it is open.
pub(super) fn card_ui(
    ui: &mut Ui,
    salt: &str,
    index: usize,
    title: &str,
    body: impl FnOnce(&mut Ui),
) -> Option<Change> {
    let number = index + 1;
    ui.push_id((salt, index), |ui| {
        let mut change = None;
        let id = ui.make_persistent_id("card");
        let state = CollapsingState::load_with_default_open(ui.ctx(), id, true);
        state
            .show_header(ui, |ui| {
                ui.label(RichText::new(format!(" {number}   {title}")).strong());
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let mut button = |text: &str, verb: &str| {
                        let name = format!("{verb} {salt} {number}");
                        let response = ui.add(Button::new(text).small()).on_hover_text(verb);
                        response.accessible_name(name).clicked()
                    };
                    if button("×", "Remove") {
                        change = Some(Change::Remove);
                    }
                    if button("⊕", "Duplicate") {
                        change = Some(Change::Duplicate);
                    }
                });
            })
            .body_unindented(body);
        change
    })
    .inner
}

fn item_ui(ui: &mut Ui, cx: &mut Cx<'_>, index: usize) -> Option<Change> {
    let Cx { draft, opened, commands, .. } = cx;
    let light = draft.lights.get_mut(index)?;
    let title = light.kind_name();
    let before = opened.lights.get(index).filter(|l| l.kind_name() == title);
    let made = card_ui(ui, "light", index, title, |ui| {
        light_fields::light_ui(ui, light, before, index, commands);
    });
    ui.add_space(crate::theme::UNIT);
    made
}
