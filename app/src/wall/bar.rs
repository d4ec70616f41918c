//! Toolbar above the images: number of views, arrangement, layer, fairness and reference.

use super::state::{Tool, Wall};
use crate::model::WallEdit;
use crate::model::{Arrangement, Layer, Pair, WindowDoc};
use crate::model::{Command, Purpose};
use crate::theme::Palette;
use crate::widgets::{callout, hint, key, optional_key};
use egui::{Button, ComboBox, ProgressBar, RichText, Ui, vec2};
use majorant_core::compare::{label, maps};
use majorant_core::estimator::REGISTRY;
use majorant_core::measure::MEASURES;
use majorant_core::scene::{Fairness, ReferenceDoc, SceneDoc};

/// Numbers of views offered as buttons.
const COUNTS: [usize; 6] = [1, 2, 3, 4, 6, 8];

impl Wall {
    /// Draws the toolbar.
    pub fn bar_ui(&mut self, ui: &mut Ui, doc: &SceneDoc, dock: bool, commands: &mut Vec<Command>) {
        let several = doc.view_count() > 1;
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        ui.spacing_mut().button_padding.x = 6.0;
        ui.horizontal_wrapped(|ui| {
            group(ui, |ui| {
                for count in COUNTS {
                    let tip = format!("{count} views of the scene, each with its own estimator");
                    let on = doc.view_count() == count;
                    if choice(ui, on, &count.to_string(), &format!("{count} views"), &tip) {
                        commands.push(Command::Wall(WallEdit::Count(count)));
                    }
                }
            });
            if several {
                arrangement_ui(ui, doc, commands);
                if matches!(WindowDoc::of(doc).arrangement, Arrangement::Wipe | Arrangement::Difference) {
                    pair_ui(ui, doc, commands);
                }
            }
            layer_ui(ui, self, doc, commands);
            if several {
                fairness_ui(ui, doc, commands);
            }
            self.reference_ui(ui, doc, commands);
            let on = self.tool == Tool::Region;
            if choice(
                ui,
                on,
                "Box",
                "Box tool",
                "Drag a box on an image to restrict all statistics to it  (B, or Ctrl + drag)",
            ) {
                self.tool = if on { Tool::Camera } else { Tool::Region };
            }
            if let Some([x0, y0, x1, y1]) = doc.compare.region {
                let text = format!("{} × {}  ×", x1 - x0, y1 - y0);
                let button = ui.add(Button::new(RichText::new(text).small()));
                if button
                    .accessible_name("Clear the box")
                    .on_hover_text("Compute statistics over the whole image again")
                    .clicked()
                {
                    commands.push(Command::Wall(WallEdit::Region(None)));
                }
            }
            if choice(
                ui,
                dock,
                "Numbers",
                "Numbers",
                "Ranking, error curves, the samples of a pixel, a scanline  (N)",
            ) {
                commands.push(Command::ToggleDock);
            }
        });
    }

    fn reference_ui(&self, ui: &mut Ui, doc: &SceneDoc, commands: &mut Vec<Command>) {
        let palette = Palette::get(ui);
        let state = self.reference_state();
        let colour = if state.problem.is_some() { palette.error } else { palette.text };
        let progress = state.progress.map_or_else(String::new, |p| format!("  {:.0} %", 100.0 * p));
        let stale = if state.problem.is_some() { "  !" } else { "" };
        let text = RichText::new(format!("Reference: {}{progress}{stale}", state.text)).small().color(colour);
        let mut config = egui::containers::menu::MenuConfig::new();
        config = config.close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
        let (response, _) = egui::containers::menu::MenuButton::new(text).config(config).ui(ui, |ui| {
            ui.set_width(280.0);
            reference_menu_ui(ui, doc, commands);
            if let Some(problem) = &state.problem {
                callout(ui, palette.error, problem);
            }
            if let Some(progress) = state.progress {
                ui.add(ProgressBar::new(progress).desired_height(8.0))
                    .accessible_name("Progress of the reference");
            }
        });
        response.accessible_name("Reference").on_hover_text("The image from which errors are measured");
    }
}

/// A group of buttons side by side.
fn group(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        ui.spacing_mut().button_padding.x = 6.0;
        add(ui);
    });
}

fn choice(ui: &mut Ui, on: bool, text: &str, name: &str, tip: &str) -> bool {
    let palette = Palette::get(ui);
    let text = RichText::new(text).small().color(if on { palette.strong } else { palette.text });
    let button = Button::selectable(on, text).frame_when_inactive(true);
    ui.add(button).accessible_name(name).on_hover_text(tip).clicked()
}

fn arrangement_ui(ui: &mut Ui, doc: &SceneDoc, commands: &mut Vec<Command>) {
    let options = [
        (Arrangement::Grid, "Grid", "Grid", "Side by side  (G)"),
        (Arrangement::Wipe, "Wipe", "Wipe", "Two views with a movable divider  (W)"),
        (Arrangement::Flip, "Flip", "Flip", "One view at a time; Tab over the image shows the next"),
        (Arrangement::Difference, "A − B", "Difference", "Difference of two views  (D)"),
    ];
    let current = WindowDoc::of(doc).arrangement;
    group(ui, |ui| {
        for (arrangement, text, name, tip) in options {
            if choice(ui, current == arrangement, text, name, tip) {
                commands.push(Command::Wall(WallEdit::Arrange(arrangement)));
            }
        }
    });
}

/// The two views of a wipe or a difference.
fn pair_ui(ui: &mut Ui, doc: &SceneDoc, commands: &mut Vec<Command>) {
    let Pair(a, b) = WindowDoc::of(doc).pair;
    let mut pair = Pair(a, b);
    for (at, name, other) in [(&mut pair.0, "First view", b), (&mut pair.1, "Second view", a)] {
        let combo = ComboBox::from_id_salt(name).width(38.0).selected_text(label(*at));
        let response = combo.show_ui(ui, |ui| {
            for view in (0..doc.view_count()).filter(|v| *v != other) {
                ui.selectable_value(
                    at,
                    view,
                    format!("{}  {}", label(view), super::caption::name(doc, view)),
                );
            }
        });
        response.response.accessible_name(name);
    }
    if pair != Pair(a, b) {
        commands.push(Command::Wall(WallEdit::Pair(pair)));
    }
}

fn layer_ui(ui: &mut Ui, wall: &Wall, doc: &SceneDoc, commands: &mut Vec<Command>) {
    let layer = WindowDoc::of(doc).layer;
    let current = layer.0.as_str();
    let name = wall.map().map_or("Picture", |map| map.name);
    let combo =
        ComboBox::from_id_salt("layer").height(360.0).width(74.0).selected_text(RichText::new(name).small());
    let response = combo.show_ui(ui, |ui| {
        let mut item = |ui: &mut Ui, id: &str, name: &str, tip: &str| {
            if ui.selectable_label(current == id, name).on_hover_text(tip).clicked() {
                commands.push(Command::Wall(WallEdit::Layer(id.to_owned())));
            }
        };
        item(ui, Layer::PICTURE, "Picture", "The rendered picture");
        for map in maps::MAPS {
            item(ui, map.id, map.name, map.formula);
        }
    });
    response
        .response
        .accessible_name("Layer")
        .on_hover_text("Shows the image of every view, or a map of its statistics");
}

fn fairness_ui(ui: &mut Ui, doc: &SceneDoc, commands: &mut Vec<Command>) {
    let options = [
        (
            Fairness::Time,
            "Equal time",
            "Every view gets the same CPU time of path tracing; statistics are not charged",
        ),
        (Fairness::Samples, "Equal samples", "Every view gets the same samples per pixel"),
        (Fairness::Lookups, "Equal look-ups", "Every view gets the same number of evaluations of the medium"),
    ];
    let current = options.iter().find(|(f, ..)| *f == doc.compare.fairness).map_or("", |(_, name, _)| name);
    let combo = ComboBox::from_id_salt("fairness").width(86.0).selected_text(RichText::new(current).small());
    let response = combo.show_ui(ui, |ui| {
        for (fairness, name, tip) in options {
            if ui.selectable_label(doc.compare.fairness == fairness, name).on_hover_text(tip).clicked() {
                commands.push(Command::Wall(WallEdit::Fairness(fairness)));
            }
        }
    });
    response.response.accessible_name("Fairness").on_hover_text("The budget that is equal for all views");
}

fn reference_menu_ui(ui: &mut Ui, doc: &SceneDoc, commands: &mut Vec<Command>) {
    let mut reference = doc.compare.reference.clone();
    let current = &doc.compare.reference;
    let rendered =
        ReferenceDoc::Render { estimator: "uni-nee-mis".into(), spp: Some(4096), relative_error: Some(0.01) };
    let mut item = |ui: &mut Ui, on: bool, text: &str, tip: &str, to: ReferenceDoc| {
        if ui.radio(on, text).on_hover_text(tip).clicked() {
            reference = to;
        }
    };
    let tip = "No errors. Variances, efficiencies, z-maps and verdicts need no reference: each view is compared with the other unbiased views";
    item(ui, *current == ReferenceDoc::None, "None", tip, ReferenceDoc::None);
    let tip = "For every view, the mean of the other unbiased views; errors are corrected for its noise. A view has no \
               error where the others are much noisier";
    let text = "The mean of the other unbiased views";
    item(ui, *current == ReferenceDoc::Pooled, text, tip, ReferenceDoc::Pooled);
    for view in 0..doc.view_count() {
        let text = format!("View {}: {}", label(view), super::caption::name(doc, view));
        let to = ReferenceDoc::View { view };
        item(ui, *current == to, &text, "The image of this view", to.clone());
    }
    let on = matches!(current, ReferenceDoc::Render { .. });
    item(ui, on, "Rendered in the background", "A separate render with its own random numbers", rendered);
    if let ReferenceDoc::Render { estimator, spp, relative_error } = &mut reference {
        let (opened_spp, opened_error) = (*spp, *relative_error);
        ui.indent("render", |ui| {
            let name = REGISTRY.iter().find(|e| e.id == *estimator).map_or("?", |e| e.name);
            let combo = ComboBox::from_id_salt("reference-estimator").width(150.0).selected_text(name);
            combo
                .show_ui(ui, |ui| {
                    for entry in REGISTRY {
                        ui.selectable_value(estimator, entry.id.to_owned(), entry.name);
                    }
                })
                .response
                .accessible_name("Estimator of the reference");
            optional_key(ui, key("compare.reference.spp"), (spp, opened_spp), 4096, "no limit", |v| v);
            let error = (relative_error, opened_error);
            optional_key(ui, key("compare.reference.relative_error"), error, 0.01, "no limit", |v| {
                v.within(1e-5..=1.0).logarithmic()
            });
        });
    }
    let file = match current {
        ReferenceDoc::File { file } => Some(file.clone()),
        _ => None,
    };
    if ui.radio(file.is_some(), "An EXR picture…").on_hover_text("Or drop one onto the window").clicked() {
        commands.push(Command::Ask(Purpose::Reference));
        ui.close();
    }
    if let Some(file) = file {
        hint(ui, &file);
    }
    if reference != *current {
        commands.push(Command::Wall(WallEdit::Reference(reference)));
    }
    ui.separator();
    let chosen = MEASURES.iter().find(|m| m.id == doc.compare.measure.0).map_or("?", |m| m.name);
    ui.horizontal(|ui| {
        ui.label("Error as");
        let combo = ComboBox::from_id_salt("measure").width(120.0).selected_text(chosen);
        combo
            .show_ui(ui, |ui| {
                for measure in MEASURES {
                    let on = measure.id == doc.compare.measure.0;
                    let tip = format!("{}\n{}", measure.formula, measure.doc);
                    if ui.selectable_label(on, measure.name).on_hover_text(tip).clicked() {
                        commands.push(Command::Wall(WallEdit::Measure(measure.id.to_owned())));
                    }
                }
            })
            .response
            .accessible_name("Measure of error");
    });
}
