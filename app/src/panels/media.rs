//! List of the media of the scene; the panels below show the selected one.

use super::{Column, Cx, Panel};
use crate::model::Command;
use crate::theme::Palette;
use crate::widgets::{buffered_text, hint, key, optional_key, row_of};
use egui::{Align, Button, ComboBox, Layout, RichText, Ui};
use majorant_core::scene::{DensityDoc, GridRef, MediumDoc, SceneDoc, Within};
use majorant_core::spectrum::SpectrumDoc;

/// Panel of the list of media.
pub struct Media;

/// Edit of the list.
enum Change {
    Select(usize),
    Duplicate(usize),
    Remove(usize),
    MoveUp(usize),
}

impl Panel for Media {
    fn id(&self) -> &'static str {
        "media"
    }
    fn title(&self) -> &'static str {
        "Media"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn starts_open(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        match cx.draft.media.as_slice() {
            [] => "none".into(),
            [only] => only.name.clone(),
            several => format!("{}: {} selected", several.len(), cx.draft.medium_at(cx.medium).name),
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let mut change = None;
        for index in 0..cx.draft.media.len() {
            change = item_ui(ui, cx, index).or(change);
        }
        apply(cx, change);
        add_ui(ui, cx);
        if cx.draft.media.is_empty() {
            hint(ui, "No medium: light travels in straight lines. Add one.");
            return;
        }
        properties_ui(ui, cx);
    }
}

/// Shows a medium of the list.
fn item_ui(ui: &mut Ui, cx: &mut Cx<'_>, index: usize) -> Option<Change> {
    let (selected, count) = (cx.medium == index, cx.draft.media.len());
    let medium = cx.draft.media.get_mut(index)?;
    let mut change = None;
    ui.push_id(("medium", index), |ui| {
        ui.horizontal(|ui| {
            let name = medium.name.clone();
            ui.checkbox(&mut medium.enabled, "")
                .accessible_name(format!("Enable {name}"))
                .on_hover_text("Part of the scene");
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let mut button = |text: &str, verb: &str| {
                    let response = ui.add(Button::new(text).small()).on_hover_text(verb);
                    response.accessible_name(format!("{verb} {name}")).clicked()
                };
                if button("×", "Remove") {
                    change = Some(Change::Remove(index));
                }
                if button("⊕", "Duplicate") {
                    change = Some(Change::Duplicate(index));
                }
                if count > 1 && index > 0 && button("▲", "Move up") {
                    change = Some(Change::MoveUp(index));
                }
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    let weak = Palette::get(ui).weak;
                    let text = RichText::new(&medium.name);
                    let text = if medium.enabled { text } else { text.color(weak).strikethrough() };
                    let label = Button::selectable(selected, text).truncate();
                    if ui.add(label).accessible_name(format!("Select {name}")).clicked() {
                        change = Some(Change::Select(index));
                    }
                });
            });
        });
    });
    change
}

fn apply(cx: &mut Cx<'_>, change: Option<Change>) {
    let media = &mut cx.draft.media;
    let select = match change {
        None => return,
        Some(Change::Select(index)) => index,
        Some(Change::Duplicate(index)) => {
            let mut copy = media[index].clone();
            copy.name = cx.draft.free_medium_name(&copy.name);
            cx.draft.media.insert(index + 1, copy);
            index + 1
        }
        Some(Change::Remove(index)) => {
            media.remove(index);
            if cx.medium > index { cx.medium - 1 } else { cx.medium }
        }
        Some(Change::MoveUp(index)) => {
            media.swap(index, index - 1);
            match cx.medium {
                selected if selected == index => index - 1,
                selected if selected + 1 == index => index,
                selected => selected,
            }
        }
    };
    select_medium(cx, select);
}

fn select_medium(cx: &mut Cx<'_>, index: usize) {
    cx.medium = index.min(cx.draft.media.len().saturating_sub(1));
    cx.commands.push(Command::SelectMedium(cx.medium));
}

/// Kinds of media that can be added.
fn templates() -> Vec<(&'static str, MediumDoc)> {
    let fog = MediumDoc {
        name: "fog".into(),
        within: Within::Everywhere,
        extinction: SpectrumDoc::Constant(0.1),
        ..MediumDoc::default()
    };
    let grid = MediumDoc {
        name: "cloud".into(),
        density: DensityDoc::Grid(GridRef { file: "embedded:cloud.vdb".into(), grid: None }),
        ..MediumDoc::default()
    };
    vec![("Uniform box", MediumDoc::default()), ("Cloud", grid), ("Fog everywhere", fog)]
}

fn add_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    super::lights::add_ui(ui, "Add medium", templates(), |mut medium| {
        medium.name = cx.draft.free_medium_name(&medium.name);
        medium.placement.fit = medium.density.grid().is_some().then_some(1.0);
        cx.draft.media.push(medium);
        select_medium(cx, usize::MAX);
    });
}

/// Shows name and region of the selected medium.
fn properties_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    ui.separator();
    let opened = cx.opened.medium_at(cx.medium).extent;
    let index = cx.medium;
    let others: Vec<String> = names_without(cx.draft, index);
    let regions = regions(cx.draft);
    let medium = cx.draft.medium_at_mut(index);
    row_of(ui, key("medium.name"), |ui, _| {
        let id = ui.make_persistent_id(("medium name", index));
        let mut name = medium.name.clone();
        buffered_text(ui, id, "Medium name", "medium", &mut name, 1);
        let valid = !name.is_empty() && !name.contains(['.', '[', ']', '=']) && !others.contains(&name);
        if valid {
            medium.name = name;
        }
    });
    row_of(ui, key("medium.within"), |ui, _| {
        let shown = words(&medium.within);
        let combo = ComboBox::from_id_salt("within").width(ui.available_width()).truncate();
        let shown = combo.selected_text(shown).show_ui(ui, |ui| {
            for (within, tip) in &regions {
                let label = ui.selectable_label(medium.within == *within, words(within));
                if label.on_hover_text(*tip).clicked() {
                    medium.within = within.clone();
                }
            }
        });
        shown.response.accessible_name("Within");
    });
    match medium.within {
        Within::Grid | Within::Object(_) => medium.extent = None,
        Within::Everywhere => {
            let extent = (&mut medium.extent, opened);
            optional_key(ui, key("medium.extent"), extent, 10.0, "to infinity", |value| value.logarithmic());
            if medium.extent.is_none() {
                hint(ui, "Suns, environments and environment maps are fully extinguished.");
            }
        }
    }
}

/// Regions that a medium can fill, each with its description.
fn regions(doc: &SceneDoc) -> Vec<(Within, &'static str)> {
    let mut regions = vec![
        (Within::Grid, "The box of the grid, or a unit cube for a uniform density, with its placement"),
        (Within::Everywhere, "All of space, or a ball about the origin; for a uniform density"),
    ];
    let closed = doc.objects.iter().filter(|object| object.shape.has_inside() && !object.name.is_empty());
    regions.extend(closed.map(|object| {
        (Within::Object(object.name.clone()), "The inside of this object; a grid also ends at its own box")
    }));
    regions
}

/// Name of a region in the menu.
fn words(within: &Within) -> String {
    match within {
        Within::Grid => "Its own box".into(),
        Within::Everywhere => "Everywhere".into(),
        Within::Object(name) => format!("Object: {name}"),
    }
}

fn names_without(doc: &SceneDoc, index: usize) -> Vec<String> {
    let others = doc.media.iter().enumerate().filter(|(other, _)| *other != index);
    others.map(|(_, medium)| medium.name.clone()).collect()
}
