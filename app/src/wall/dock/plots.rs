//! Plots and legends common to the tabs.

use crate::theme::Palette;
use crate::wall::caption::digits;
use egui::{Color32, RichText, Sense, Ui, vec2};
use egui_plot::{GridMark, Legend, Plot, log_grid_spacer};
use std::ops::RangeInclusive;

/// Creates a plot that fills the available height; `log` flags the axes whose values are base-10 logarithms.
pub(super) fn plot<'a>(id: &str, ui: &Ui, names: (&str, &str), log: (bool, bool)) -> Plot<'a> {
    let format = |log: bool| {
        move |mark: GridMark, _: &RangeInclusive<f64>| {
            if !log {
                return digits(mark.value);
            }
            // Only whole decades are labelled.
            let decade = mark.value.round();
            if (mark.value - decade).abs() > 1e-6 { String::new() } else { power_of_ten(decade as i32) }
        }
    };
    let mut plot = Plot::new(id.to_owned())
        .height(ui.available_height().max(80.0))
        .x_axis_label(names.0.to_owned())
        .y_axis_label(names.1.to_owned())
        .x_axis_formatter(format(log.0))
        .y_axis_formatter(format(log.1))
        .allow_scroll(false);
    if log.0 {
        plot = plot.x_grid_spacer(log_grid_spacer(10));
    }
    if log.1 {
        plot = plot.y_grid_spacer(log_grid_spacer(10));
    }
    plot
}

/// Legend inside a plot.
pub(super) fn legend() -> Legend {
    Legend::default().text_style(egui::TextStyle::Small).background_alpha(0.6)
}

/// Draws a one-line legend above a small plot: names and colours of the curves.
pub(super) fn key_ui(ui: &mut Ui, names: &[(&str, Color32)]) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (name, colour) in names {
            let (rect, _) = ui.allocate_exact_size(vec2(9.0, 9.0), Sense::hover());
            ui.painter().circle_filled(rect.center(), 3.5, *colour);
            ui.label(RichText::new(*name).small().color(Palette::get(ui).text));
            ui.add_space(4.0);
        }
    });
}

/// Formats a power of ten as `0.01`, `100` or `1e-5`.
fn power_of_ten(exponent: i32) -> String {
    match exponent {
        -3..=4 => format!("{}", 10f64.powi(exponent)),
        _ => format!("1e{exponent}"),
    }
}
