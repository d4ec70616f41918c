//! Table of scenes × estimators.

use crate::theme::Palette;
use egui::{Align, Label, Layout, RichText, TextWrapMode, Ui};
use egui_extras::{Column, TableBuilder, TableRow};
use majorant_core::check::{Row, Verdict};
use majorant_core::scene::Mode;

const ROW_HEIGHT: f32 = 21.0;
/// Minimum width, in points, that leaves room for the verdict.
pub(super) const TABLE_WIDTH: f32 = 920.0;

/// Column headings with tooltips.
const HEADINGS: [(&str, &str); 8] = [
    ("Scene", "The case. The source file of its family contains the derivation of the expected value."),
    ("Estimator", "Every estimator that is unbiased for the scene is compared with the expected value."),
    ("Mode", "Spectral: sampled wavelengths. RGB: three fixed components."),
    ("Measured", "Image mean over pixels and channels, and its standard error."),
    ("Expected", "Expected image mean. If it is unknown: the mean of the other estimators."),
    ("z", "Measured minus expected, in standard errors of the difference. Within ±2 in 19 of 20 cases."),
    (
        "Worst |z|",
        "The largest |z| of any block of pixels and channel, and the value that chance exceeds anywhere in the \
         table once in a thousand tables.",
    ),
    ("Detects", "Smallest bias of the image mean that is detected with 95 % probability."),
];

pub(super) fn mode(row: &Row) -> &'static str {
    if row.mode == Mode::Rgb { "RGB" } else { "spectral" }
}

/// Shows rows, failures first.
pub(super) fn table_ui(ui: &mut Ui, rows: &[Row], only_failures: bool) {
    let mut shown: Vec<&Row> = rows.iter().filter(|row| !(only_failures && row.passes())).collect();
    shown.sort_by_key(|row| row.passes());
    let numbers = Layout::right_to_left(Align::Center);
    ui.spacing_mut().item_spacing.y = 0.0;
    let table = TableBuilder::new(ui)
        .striped(true)
        .auto_shrink([false, false])
        .cell_layout(Layout::left_to_right(Align::Center))
        .column(Column::exact(214.0).clip(true))
        .column(Column::exact(92.0))
        .column(Column::exact(60.0))
        .column(Column::exact(128.0))
        .column(Column::exact(66.0))
        .column(Column::exact(46.0))
        .column(Column::exact(84.0))
        .column(Column::exact(54.0))
        .column(Column::remainder().clip(true));
    let header = table.header(24.0, |mut header| {
        for (index, (title, meaning)) in HEADINGS.iter().enumerate() {
            header.col(|ui| {
                let show = |ui: &mut Ui| {
                    let text = RichText::new(*title).small().color(Palette::get(ui).weak);
                    ui.add(Label::new(text).selectable(false)).on_hover_text(*meaning);
                };
                if index < 3 { show(ui) } else { ui.with_layout(numbers, show).inner }
            });
        }
        header.col(|ui| {
            ui.add_space(8.0);
            let text = RichText::new("Verdict").small().color(Palette::get(ui).weak);
            ui.add(Label::new(text).selectable(false));
        });
    });
    header.body(|body| {
        body.rows(ROW_HEIGHT, shown.len(), |mut line| {
            if let Some(row) = shown.get(line.index()) {
                row_ui(&mut line, row);
            }
        });
    });
}

fn row_ui(line: &mut TableRow<'_, '_>, row: &Row) {
    let text = |line: &mut TableRow<'_, '_>, text: &str| {
        line.col(|ui| {
            ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
            ui.add(Label::new(text).selectable(false));
        });
    };
    text(line, &row.scene);
    text(line, row.estimator);
    text(line, mode(row));
    let number = |line: &mut TableRow<'_, '_>, text: String| {
        line.col(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.add(Label::new(RichText::new(text).monospace()).selectable(false));
            });
        });
    };
    number(line, format!("{} ± {}", four_digits(row.measured), short(row.error)));
    number(line, four_digits(row.expected));
    number(line, format!("{:+.1}", row.z));
    number(line, format!("{:.1} of {:.1}", row.worst_z, row.critical_z));
    let sees = if row.detectable < 9.99 { format!("{:.1} %", 100.0 * row.detectable) } else { "–".into() };
    number(line, sees);
    line.col(|ui| {
        ui.add_space(8.0);
        let palette = Palette::get(ui);
        let (mark, colour) = match row.verdict {
            Verdict::Agrees => ("=", palette.good),
            Verdict::Undecided => ("?", palette.warning),
            Verdict::Differs { .. } | Verdict::NotFinite { .. } => ("≠", palette.error),
        };
        ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
        let text = row.verdict.to_string();
        let label = Label::new(RichText::new(format!("{mark}  {text}")).color(colour)).selectable(false);
        ui.add(label).on_hover_text(format!("{text}, with {} paths", row.paths));
    });
}

/// Formats a value with about four significant digits.
fn four_digits(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude >= 100.0 {
        format!("{value:.1}")
    } else if magnitude >= 10.0 {
        format!("{value:.2}")
    } else if magnitude >= 0.01 || magnitude == 0.0 {
        format!("{value:.4}")
    } else {
        format!("{value:.1e}")
    }
}

fn short(error: f64) -> String {
    if error >= 0.1 {
        format!("{error:.2}")
    } else if !(1e-12..5e-5).contains(&error) {
        format!("{error:.4}")
    } else {
        format!("{error:.0e}")
    }
}
