//! Event table of a path: contribution f, probability densities and added radiance after every event.

use super::super::Cx;
use super::event::{colour, event_ui};
use crate::theme::Palette;
use crate::wall::inspector::Replayed;
use egui::{Align, Color32, Label, Layout, RichText, Sense, Ui};
use egui_extras::{Column, TableBuilder, TableRow};
use majorant_core::inspect::{Branch, Row};

pub(super) fn events_ui(ui: &mut Ui, cx: &mut Cx<'_>, replayed: &Replayed) {
    let palette = Palette::get(ui);
    let ledger = &replayed.ledger;
    let kept_names = ledger.rows.iter().find_map(|row| row.kept).map_or(["", "", ""], |kept| kept.names);
    let height = ui.text_style_height(&egui::TextStyle::Small) + 5.0;
    let state = &mut cx.inspector.path;
    state.step = state.step.min(ledger.rows.len().saturating_sub(1));
    let (step, mut clicked) = (state.step, None);
    // The details of the selected event are below the table.
    let detail = (0.45 * ui.available_height()).clamp(5.0 * height, 10.0 * height);
    ui.spacing_mut().item_spacing.x = 4.0;
    let room = (ui.available_height() - detail - 2.0 * height).max(40.0);
    egui::ScrollArea::horizontal().id_salt("ledger").auto_shrink([false, true]).show(ui, |ui| {
        let event = if ui.available_width() > 460.0 { 150.0 } else { 100.0 };
        let mut table = TableBuilder::new(ui)
            .striped(true)
            .sense(Sense::click())
            .auto_shrink([false, false])
            .min_scrolled_height(room)
            .max_scroll_height(room)
            .cell_layout(Layout::right_to_left(Align::Center))
            .column(Column::exact(20.0))
            .column(Column::initial(event).at_least(80.0))
            .columns(Column::auto().at_least(50.0), 3)
            .column(Column::remainder().at_least(52.0));
        if std::mem::take(&mut state.scroll) {
            table = table.scroll_to_row(step, None);
        }
        table
            .header(height, |mut header| {
                let names = [
                    ("", ""),
                    ("event", "Indented: on a connection, or on a walk that only evaluates emission"),
                    ("f", "Contribution of the path at its hero wavelength: a product over its events"),
                    ("p uni", "Probability density of the path under unidirectional sampling"),
                    (
                        "p nee",
                        "Probability density of the path under next-event estimation; at a vertex, without the density of the light",
                    ),
                    ("adds", "Radiance added to the estimate, mean of linear sRGB"),
                ];
                for (name, tip) in names {
                    header.col(|ui| {
                        ui.label(RichText::new(name).small().color(palette.weak)).on_hover_text(tip);
                    });
                }
            })
            .body(|body| {
                body.rows(height, ledger.rows.len(), |mut row| {
                    let i = row.index();
                    row.set_selected(i == step);
                    row_ui(&mut row, i, &ledger.rows[i], palette);
                    if row.response().clicked() {
                        clicked = Some(i);
                    }
                });
            });
    });
    if let Some(i) = clicked {
        state.step = i;
    }
    if let Some(row) = ledger.rows.get(state.step) {
        event_ui(ui, row, kept_names, ledger);
    }
}

fn row_ui(row: &mut TableRow<'_, '_>, i: usize, event: &Row, palette: &Palette) {
    let small = |text: String, colour: Color32| RichText::new(text).small().monospace().color(colour);
    row.col(|ui| {
        ui.add(Label::new(small(i.to_string(), palette.weak)).selectable(false));
    });
    row.col(|ui| {
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            if event.branch != Branch::Path {
                ui.add_space(10.0);
            }
            let text = RichText::new(event.step.to_string()).small().color(colour(event, palette));
            ui.add(Label::new(text).truncate().selectable(false));
        });
    });
    for product in [&event.f[0], &event.uni[0], &event.nee[0]] {
        row.col(|ui| {
            ui.add(Label::new(small(product.to_string(), palette.text)).selectable(false));
        });
    }
    row.col(|ui| {
        if let Some(contribution) = &event.contribution {
            let grey = contribution.film.element_sum() / 3.0;
            let text = small(format!("{grey:.5}"), colour(event, palette));
            ui.add(Label::new(text).selectable(false));
        }
    });
}
