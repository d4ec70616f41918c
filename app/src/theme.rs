//! Colours, fonts and spacing of the window, for the dark and the light theme.
//!
//! Greys are neutral, so that they do not affect the perceived colours of the image beside them. One accent
//! colour marks selected and live elements, amber marks warnings, and red is reserved for errors and bias.

use egui::{
    Color32, Context, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke,
    Style, TextStyle, Theme, Visuals, style::ScrollStyle, style::WidgetVisuals, vec2,
};

/// Grid unit in points; every gap is a multiple of it.
pub const UNIT: f32 = 4.0;
/// Width of the label column in the rows of a panel, in points.
pub const LABEL_WIDTH: f32 = 112.0;

/// Colours that panels and painters use in addition to egui's visuals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Palette {
    /// Background behind the image.
    pub canvas: Color32,
    /// Panel background.
    pub panel: Color32,
    /// Background of bars at the window's edges and of column headings.
    pub bar: Color32,
    /// Background of section headers.
    pub header: Color32,
    /// Background of fields and plots: darker (or lighter) than the panel.
    pub well: Color32,
    /// Background of idle buttons.
    pub control: Color32,
    /// Hairlines.
    pub line: Color32,
    /// Body text.
    pub text: Color32,
    /// Titles and values.
    pub strong: Color32,
    /// Secondary text, still readable (contrast above 4.5 on `panel`).
    pub weak: Color32,
    /// Selected, live and draggable elements.
    pub accent: Color32,
    /// Fill of a selected control.
    pub accent_fill: Color32,
    /// Warnings: settings that increase cost or noise.
    pub warning: Color32,
    /// Errors, failures and bias.
    pub error: Color32,
    /// Success.
    pub good: Color32,
}

const DARK: Palette = Palette {
    canvas: Color32::from_rgb(17, 17, 18),
    panel: Color32::from_rgb(29, 30, 32),
    bar: Color32::from_rgb(23, 24, 25),
    header: Color32::from_rgb(37, 38, 41),
    well: Color32::from_rgb(19, 20, 21),
    control: Color32::from_rgb(50, 52, 56),
    line: Color32::from_rgb(52, 54, 58),
    text: Color32::from_rgb(208, 210, 214),
    strong: Color32::from_rgb(242, 243, 245),
    weak: Color32::from_rgb(150, 154, 161),
    accent: Color32::from_rgb(92, 174, 230),
    accent_fill: Color32::from_rgb(33, 74, 103),
    warning: Color32::from_rgb(232, 176, 84),
    error: Color32::from_rgb(240, 112, 102),
    good: Color32::from_rgb(118, 196, 136),
};

const LIGHT: Palette = Palette {
    canvas: Color32::from_rgb(206, 207, 209),
    panel: Color32::from_rgb(246, 246, 247),
    bar: Color32::from_rgb(234, 235, 237),
    header: Color32::from_rgb(233, 234, 236),
    well: Color32::from_rgb(255, 255, 255),
    control: Color32::from_rgb(223, 225, 228),
    line: Color32::from_rgb(207, 209, 213),
    text: Color32::from_rgb(44, 47, 52),
    strong: Color32::from_rgb(14, 16, 18),
    weak: Color32::from_rgb(94, 99, 107),
    accent: Color32::from_rgb(20, 104, 172),
    accent_fill: Color32::from_rgb(196, 222, 242),
    warning: Color32::from_rgb(148, 88, 0),
    error: Color32::from_rgb(184, 38, 30),
    good: Color32::from_rgb(28, 118, 58),
};

impl Palette {
    /// Returns the colours of a theme.
    #[must_use]
    pub const fn of(theme: Theme) -> &'static Self {
        match theme {
            Theme::Dark => &DARK,
            Theme::Light => &LIGHT,
        }
    }

    /// Returns the colours of the current theme of a ui.
    #[must_use]
    pub fn get(ui: &egui::Ui) -> &'static Self {
        if ui.visuals().dark_mode { &DARK } else { &LIGHT }
    }
}

/// Colour of a view in plots and captions; views count from 0.
#[must_use]
pub fn view_colour(view: usize) -> Color32 {
    let [r, g, b] = majorant_core::compare::view_colour(view);
    Color32::from_rgb(r, g, b)
}

/// Installs the fonts and both themes; [`Context::set_theme`] then switches between the themes.
pub fn install(ctx: &Context) {
    ctx.set_fonts(fonts());
    for theme in [Theme::Dark, Theme::Light] {
        ctx.set_style_of(theme, style(theme));
    }
}

/// Frame of a modal dialog.
pub fn dialog_frame(style: &Style) -> egui::Frame {
    egui::Frame::window(style).inner_margin(Margin::same(20))
}

/// Fonts in which the proportional family falls back to the monospace font for missing arrows and shapes.
fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    // Slightly smaller than nominal, to match the x-height of the proportional font.
    if let Some(data) = fonts.font_data.get_mut("Hack") {
        let mut tweaked = FontData::clone(data);
        tweaked.tweak.scale = 0.96;
        *data = std::sync::Arc::new(tweaked);
    }
    if let Some(family) = fonts.families.get_mut(&FontFamily::Proportional) {
        family.insert(1, "Hack".to_owned());
    }
    fonts
}

fn style(theme: Theme) -> Style {
    let palette = Palette::of(theme);
    let mut style = Style { visuals: visuals(theme, palette), ..Style::default() };
    style.text_styles = [
        (TextStyle::Heading, FontId::new(17.0, FontFamily::Proportional)),
        (TextStyle::Body, FontId::new(14.0, FontFamily::Proportional)),
        (TextStyle::Button, FontId::new(14.0, FontFamily::Proportional)),
        (TextStyle::Small, FontId::new(12.5, FontFamily::Proportional)),
        (TextStyle::Monospace, FontId::new(12.5, FontFamily::Monospace)),
    ]
    .into();
    style.drag_value_text_style = TextStyle::Monospace;
    style.animation_time = 0.1;
    // Tooltips explain the value; the generic drag hint is in the window of keys and gestures.
    style.explanation_tooltips = false;
    style.interaction.tooltip_delay = 0.35;
    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(2.0 * UNIT, UNIT);
    spacing.button_padding = vec2(2.0 * UNIT, 3.0);
    spacing.interact_size = vec2(40.0, 22.0);
    spacing.indent = 4.0 * UNIT;
    spacing.menu_margin = Margin::same(6);
    spacing.window_margin = Margin::same(16);
    spacing.icon_width = 15.0;
    spacing.icon_width_inner = 9.0;
    spacing.icon_spacing = 6.0;
    spacing.combo_width = 80.0;
    spacing.tooltip_width = 340.0;
    spacing.menu_width = 320.0;
    spacing.scroll = ScrollStyle { bar_width: 8.0, ..ScrollStyle::floating() };
    style
}

fn visuals(theme: Theme, p: &Palette) -> Visuals {
    let mut v = match theme {
        Theme::Dark => Visuals::dark(),
        Theme::Light => Visuals::light(),
    };
    let radius = CornerRadius::same(4);
    let widget = |fill: Color32, line: Color32, text: Color32| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, line),
        corner_radius: radius,
        fg_stroke: Stroke::new(1.0, text),
        expansion: 0.0,
    };
    v.widgets.noninteractive = widget(p.panel, p.line, p.text);
    v.widgets.inactive = widget(p.control, Color32::TRANSPARENT, p.text);
    // Checkboxes are small and flat, so that an empty one needs a contrasting fill.
    v.widgets.inactive.bg_fill = p.control.lerp_to_gamma(p.text, 0.22);
    v.widgets.hovered =
        widget(p.control.lerp_to_gamma(p.accent, 0.12), p.accent.gamma_multiply(0.6), p.strong);
    v.widgets.active = widget(p.accent_fill, p.accent, p.strong);
    v.widgets.open = widget(p.control, p.line, p.strong);
    v.selection.bg_fill = p.accent_fill;
    v.selection.stroke = Stroke::new(1.0, p.strong);
    v.text_cursor.stroke = Stroke::new(2.0, p.accent);
    v.hyperlink_color = p.accent;
    v.weak_text_color = Some(p.weak);
    v.faint_bg_color = p.header;
    v.extreme_bg_color = p.well;
    v.code_bg_color = p.header;
    v.warn_fg_color = p.warning;
    v.error_fg_color = p.error;
    v.panel_fill = p.panel;
    v.window_fill = p.panel;
    v.window_stroke = Stroke::new(1.0, p.line);
    v.window_corner_radius = CornerRadius::same(8);
    v.menu_corner_radius = CornerRadius::same(6);
    let shade = if theme == Theme::Dark { 110 } else { 40 };
    let shadow = Shadow { offset: [0, 6], blur: 18, spread: 0, color: Color32::from_black_alpha(shade) };
    (v.window_shadow, v.popup_shadow) = (shadow, shadow);
    v.indent_has_left_vline = false;
    v.interact_cursor = None;
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(c: Color32) -> f32 {
        let [r, g, b, _] = egui::Rgba::from(c).to_array();
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// Contrast ratio of WCAG 2.
    fn contrast(a: Color32, b: Color32) -> f32 {
        let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
        (a / b).max(b / a)
    }

    #[test]
    fn text_is_readable_in_both_themes() {
        for theme in [Theme::Dark, Theme::Light] {
            let p = Palette::of(theme);
            for background in [p.panel, p.bar, p.header, p.well] {
                for text in [p.text, p.strong, p.weak, p.warning, p.error, p.accent] {
                    let ratio = contrast(text, background);
                    assert!(ratio >= 4.5, "{theme:?}: {text:?} on {background:?} is {ratio:.2}");
                }
            }
        }
    }
}
