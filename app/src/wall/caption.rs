//! Caption above every image: label, estimator, error, verdict, sample count and menu of a view.

use super::state::Wall;
use crate::model::Command;
use crate::model::WallEdit;
use crate::model::stats::count;
use crate::theme::{Palette, view_colour};
use crate::view::tone_mapper::PictureId;
use egui::{
    Align, Color32, CornerRadius, FontId, Frame, Label, Layout, Margin, Rect, RichText, Ui, UiBuilder,
};
use majorant_core::compare::report::words;
use majorant_core::compare::{Agreement, ComparedWith, Standing, Verdict, label};
use majorant_core::estimator;
use majorant_core::measure::{Measure, Measured};
use majorant_core::scene::{ReferenceDoc, SceneDoc};

/// Height of the caption, in points.
pub(super) const HEIGHT: f32 = 26.0;
/// Minimum widths of the caption at which each item is shown.
const ERROR_FROM: f32 = 150.0;
const ERROR_NAMED_FROM: f32 = 260.0;
const VERDICT_FROM: f32 = 380.0;
const SAMPLES_FROM: f32 = 480.0;

/// Formats a number with about three significant digits; `–` if it is not finite.
#[must_use]
pub fn digits(value: f64) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    match value.abs() {
        0.0 => "0".into(),
        v if !(1e-3..1e4).contains(&v) => format!("{value:.2e}"),
        v if v < 0.1 => format!("{value:.5}"),
        v if v < 10.0 => format!("{value:.3}"),
        _ => format!("{value:.1}"),
    }
}

/// Formats a probability as `p = .43`.
#[must_use]
pub fn probability(p: f64) -> String {
    match p {
        p if p.is_nan() => "p unknown".into(),
        p if p < 1e-9 => "p < 10⁻⁹".into(),
        p if p < 1e-3 => format!("p = {p:.0e}"),
        p => format!("p = {}", format!("{p:.2}").trim_start_matches('0')),
    }
}

/// Formats a relative difference and its error as `+2.10 % ± 0.30 %`.
#[must_use]
pub fn percent(difference: f64, error: f64) -> String {
    format!("{:+.2} % ± {:.2} %", 100.0 * difference, 100.0 * error)
}

/// Short text of the verdict on a view, with its colour.
#[must_use]
pub fn verdict(standing: &Standing, palette: &Palette) -> (String, Color32) {
    if let ComparedWith::Nothing(_) = standing.against {
        return match standing.declared_bias {
            Some(_) => ("biased by choice".into(), palette.error),
            None => ("–".into(), palette.weak),
        };
    }
    let Some(found) = &standing.agreement else { return ("–".into(), palette.weak) };
    match found.verdict {
        Verdict::Agrees if found.p < SUSPECT => {
            (format!("agrees so far ({})", probability(found.p)), palette.warning)
        }
        Verdict::Agrees => (format!("agrees ({})", probability(found.p)), palette.good),
        Verdict::Undecided => ("too noisy to tell".into(), palette.weak),
        // A difference from the mean of other views does not show which of them is biased.
        Verdict::Differs => {
            let open =
                matches!(standing.against, ComparedWith::Others(_)) && standing.declared_bias.is_none();
            let word = if open { "differs" } else { "biased" };
            (format!("{word}: {}", size(found)), palette.error)
        }
    }
}

/// Formats the size of a difference: of the mean or, where that is not significant, of the worst block.
pub(super) fn size(found: &Agreement) -> String {
    match found.worst {
        Some(worst) if found.z.abs() <= 4.0 => {
            format!("{} in one block", percent(worst.difference, worst.error))
        }
        _ => percent(found.difference, found.error),
    }
}

/// Probability below which an agreement is marked as preliminary.
const SUSPECT: f64 = 1e-3;

/// Draws the caption; edits are appended to `commands`.
pub(super) fn caption_ui(
    ui: &mut Ui,
    rect: Rect,
    wall: &Wall,
    picture: PictureId,
    doc: &SceneDoc,
    commands: &mut Vec<Command>,
) {
    let palette = Palette::get(ui);
    let selected = picture == PictureId::View(wall.selected()) && doc.view_count() > 1;
    let fill = if selected { palette.accent_fill.gamma_multiply(0.8) } else { palette.bar };
    ui.painter().rect_filled(rect, 0.0, fill);
    let inner = rect.shrink2(egui::vec2(6.0, 0.0));
    let mut child =
        ui.new_child(UiBuilder::new().max_rect(inner).layout(Layout::left_to_right(Align::Center)));
    let ui = &mut child;
    ui.spacing_mut().item_spacing.x = 6.0;
    let text = |ui: &mut Ui, text: RichText| ui.add(Label::new(text).truncate().selectable(false));
    match picture {
        PictureId::View(view) => {
            chip(ui, &label(view), view_colour(view));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = 6.0;
                if doc.view_count() > 1 {
                    menu_ui(ui, view, doc, commands);
                }
                numbers_ui(ui, wall, doc, view, rect.width());
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    text(ui, RichText::new(name(doc, view)).color(palette.strong));
                });
            });
        }
        PictureId::Reference => {
            chip(ui, "R", palette.weak);
            text(ui, RichText::new("Reference").color(palette.strong));
            // Describes the uploaded image, which may be older than the newest reference.
            let uploaded = wall.uploaded(picture).and_then(|uploaded| uploaded.reference.as_ref());
            let origin = uploaded.map_or_else(|| wall.reference_state().text, |r| r.origin.clone());
            text(ui, RichText::new(origin).small().color(palette.weak));
        }
        PictureId::Difference => {
            let crate::model::Pair(a, b) = crate::model::WindowDoc::of(doc).pair;
            chip(ui, &label(a), view_colour(a));
            text(ui, RichText::new("minus").color(palette.weak));
            chip(ui, &label(b), view_colour(b));
            let names = format!("{} − {}", name(doc, a), name(doc, b));
            text(ui, RichText::new(names).color(palette.strong));
        }
    }
}

/// Name of a view: its estimator, and the settings in which it differs.
pub fn name(doc: &SceneDoc, view: usize) -> String {
    let Some(own) = doc.view_overrides(view) else { return String::new() };
    let mut name =
        estimator::find(&own.estimator.id).map_or(own.estimator.id.as_str(), |e| e.name).to_owned();
    let majorant = &own.majorant;
    if majorant.factor != 1.0 {
        name += &format!(", μ̄ × {}", crate::widgets::format_number(majorant.factor.into()));
    }
    if majorant.factor < 1.0 && majorant.when_exceeded == majorant_core::scene::WhenExceeded::Clamp {
        name += " clamped";
    }
    if let Some(depth) = own.estimator.max_depth {
        name += &format!(", depth {depth}");
    }
    if own.estimator.mode != doc.estimator.mode {
        name += if own.estimator.mode == majorant_core::scene::Mode::Rgb { ", RGB" } else { ", spectral" };
    }
    name
}

fn numbers_ui(ui: &mut Ui, wall: &Wall, doc: &SceneDoc, view: usize, width: f32) {
    let palette = Palette::get(ui);
    let analysis = wall.analysis();
    let small =
        |text: String, colour| Label::new(RichText::new(text).small().color(colour)).selectable(false);
    if let Some(standing) = analysis.standing(&label(view)).filter(|_| width > ERROR_FROM) {
        let called = |name: &str| if width > ERROR_NAMED_FROM { format!("{name} ") } else { String::new() };
        let error = analysis.measure.and_then(|m| Some((m, standing.error(m.id)?)));
        let (text, tip) = match error {
            Some((measure, measured)) => (
                called(measure.name) + &words::quantity(measured.corrected(), measured.uncertainty()),
                error_tip(measure, measured),
            ),
            None => {
                let efficiency = format!("   efficiency {}", digits(standing.efficiency));
                (
                    called("σ²")
                        + &digits(standing.variance)
                        + if width > SAMPLES_FROM { &efficiency } else { "" },
                    format!(
                        "± {}\nVariance of the pixel mean, averaged over pixels and channels, and efficiency, \
                         1 / (variance · CPU seconds). Neither needs a reference{}",
                        digits(standing.variance_error),
                        not_measured(standing, doc).map_or_else(String::new, |why| format!("\n{why}"))
                    ),
                )
            }
        };
        ui.add(small(text, palette.strong)).on_hover_text(tip);
        if width > VERDICT_FROM {
            let (text, colour) = verdict(standing, palette);
            ui.add(small(text, colour)).on_hover_text(against(standing));
        }
    }
    // Sample count of the statistics if they are shown, else of the uploaded image.
    let standing = analysis.standing(&label(view));
    let picture = wall.uploaded(PictureId::View(view)).and_then(|uploaded| uploaded.snapshot.as_ref());
    let current = wall.slots().get(view).map(|slot| slot.state.generation);
    let shown = picture.filter(|s| Some(s.generation) == current).map_or(0, |s| s.spp);
    let spp = standing.map_or(shown, |s| s.spp);
    if width > SAMPLES_FROM || (width > ERROR_FROM && standing.is_none()) {
        ui.add(small(format!("{} spp", count(spp as f64)), palette.weak));
    }
}

/// Tooltip of an error: its formula and the two components of its uncertainty.
pub(super) fn error_tip(measure: &Measure, measured: &Measured) -> String {
    format!(
        "{}: {}\n± {} from the scatter over pixels, and {} for the noise of the reference, for which it is corrected",
        measure.name,
        measure.formula,
        digits(measured.error),
        digits(measured.reference_share)
    )
}

/// Explanation of the missing error of a view, if there is one.
pub(super) fn not_measured(standing: &Standing, doc: &SceneDoc) -> Option<&'static str> {
    match (&doc.compare.reference, &standing.against) {
        (ReferenceDoc::Pooled, ComparedWith::Others(_)) if standing.errors.is_empty() => Some(
            "No error: the noise of the other views is not known accurately, or much larger than that of this view",
        ),
        _ => None,
    }
}

/// Tooltip of a verdict: the reference and the result of the comparison.
pub(super) fn against(standing: &Standing) -> String {
    let with = match &standing.against {
        ComparedWith::Reference(origin) => format!("Compared with the reference ({origin})"),
        ComparedWith::Others(labels) => format!("Compared with the mean of {labels}"),
        ComparedWith::Nothing(why) => format!("Not compared: {why}"),
    };
    let bias = standing.declared_bias.map_or_else(String::new, |why| format!("\nBiased by choice: {why}"));
    let found = standing.agreement.map_or_else(String::new, |a| {
        format!(
            "\nMeans differ by {}, z = {:.1}; {} over all blocks",
            percent(a.difference, a.error),
            a.z,
            probability(a.p)
        )
    });
    let spread = if standing.evenly_spread {
        "\nIts samples are quasi-random: error bars overestimate its errors, so that a small bias may not be detected."
    } else {
        ""
    };
    format!("{with}.{found}{bias}{spread}")
}

/// Draws the letter of a view on the view's colour.
pub(super) fn chip(ui: &mut Ui, text: &str, colour: Color32) {
    Frame::NONE.fill(colour).corner_radius(CornerRadius::same(3)).inner_margin(Margin::symmetric(5, 0)).show(
        ui,
        |ui| {
            let text = RichText::new(text).font(FontId::proportional(13.0)).color(Color32::WHITE).strong();
            ui.add(Label::new(text).selectable(false));
        },
    );
}

/// Draws the menu of a view.
fn menu_ui(ui: &mut Ui, view: usize, doc: &SceneDoc, commands: &mut Vec<Command>) {
    let count = doc.view_count();
    let button = ui.menu_button(RichText::new("…").strong(), |ui| {
        let mut item = |ui: &mut Ui, on: bool, text: &str, edit: WallEdit| {
            if ui.add_enabled(on, egui::Button::new(text)).clicked() {
                commands.push(Command::Wall(edit));
                ui.close();
            }
        };
        item(ui, count < majorant_core::scene::MAX_VIEWS, "Duplicate", WallEdit::Duplicate(view));
        item(ui, count > 1, "Remove", WallEdit::Remove(view));
        ui.separator();
        item(ui, view > 0, "Move to the left", WallEdit::Swap(view, view.saturating_sub(1)));
        item(ui, view + 1 < count, "Move to the right", WallEdit::Swap(view, view + 1));
        ui.separator();
        let is_reference = doc.compare.reference == ReferenceDoc::View { view };
        item(ui, !is_reference, "Use as reference", WallEdit::Reference(ReferenceDoc::View { view }));
        item(ui, doc.compare.baseline != view, "Use as baseline", WallEdit::Baseline(view));
        ui.separator();
        let own = view.checked_sub(1).and_then(|i| doc.compare.views.get(i));
        let camera = own.is_some_and(|v| v.camera.is_some());
        let display = own.is_some_and(|v| v.view.is_some());
        let text = if camera { "Use the scene's camera" } else { "Use a separate camera" };
        item(ui, view > 0, text, WallEdit::OwnCamera(view, !camera));
        let text = if display { "Use the scene's exposure" } else { "Use a separate exposure" };
        item(ui, view > 0, text, WallEdit::OwnDisplay(view, !display));
    });
    let name = format!("Menu of view {}", label(view));
    button
        .response
        .accessible_name(name)
        .on_hover_text("Duplicate, remove or move the view, or use it as reference or baseline");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_people_write_them() {
        assert_eq!(probability(0.43), "p = .43");
        assert_eq!(probability(1.0), "p = 1.00");
        assert_eq!(probability(2e-5), "p = 2e-5");
        assert_eq!(percent(0.021, 0.003), "+2.10 % ± 0.30 %");
        assert_eq!(digits(0.000_123), "1.23e-4");
        assert_eq!(digits(12.34), "12.3");
        assert_eq!(digits(f64::NAN), "–");
    }
}
