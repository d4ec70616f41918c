//! Layout of Markdown: headings, paragraphs, lists, and TeX equations between dollar signs.

use super::equation::{Equation, PADDING, Place, check, equation};
use crate::theme::{Palette, UNIT};
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, FontFamily, FontId, Frame, Label, Margin, Rect, Response, RichText, TextStyle, Ui, Vec2};
use egui::{Color32, Pos2, Role, WidgetInfo};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use std::sync::Arc;

/// Placeholder for an inline equation: a non-breaking space, so that lines do not break inside it.
const HELD: char = '\u{a0}';

/// Font size of equations relative to text: KaTeX glyphs are smaller at the same size.
const MATHS_SCALE: f32 = 1.16;

/// Style of a run of text.
#[derive(Clone, Copy, Default)]
struct Style {
    strong: bool,
    emphasis: bool,
    code: bool,
}

/// Kind of the current Markdown block.
#[derive(Clone, Copy, PartialEq)]
enum Block {
    Paragraph,
    Heading,
    Item,
    Code,
}

/// An inline equation: its source, its raster, and the number of placeholder characters.
struct Inline {
    tex: String,
    equation: Arc<Equation>,
    letters: usize,
}

/// A paragraph under construction.
#[derive(Default)]
struct Paragraph {
    job: LayoutJob,
    equations: Vec<Inline>,
}

fn parser(markdown: &str) -> Parser<'_> {
    Parser::new_ext(markdown, Options::ENABLE_MATH)
}

/// Returns a message about the first invalid equation of a text.
#[must_use]
pub fn damaged_equation(markdown: &str) -> Option<String> {
    parser(markdown).find_map(|event| match event {
        Event::InlineMath(tex) | Event::DisplayMath(tex) => {
            check(&tex).err().map(|reason| format!("the equation `{}`: {reason}", tex.trim()))
        }
        _ => None,
    })
}

/// Draws Markdown text.
pub fn prose_ui(ui: &mut Ui, markdown: &str) {
    let mut paragraph = Paragraph::default();
    let mut style = Style::default();
    let mut block = Block::Paragraph;
    let mut code = String::new();
    for event in parser(markdown) {
        match event {
            Event::Start(Tag::Heading { .. }) => block = Block::Heading,
            Event::Start(Tag::Item) => block = Block::Item,
            Event::Start(Tag::CodeBlock(_)) => block = Block::Code,
            Event::Start(Tag::Strong) => style.strong = true,
            Event::End(TagEnd::Strong) => style.strong = false,
            Event::Start(Tag::Emphasis) => style.emphasis = true,
            Event::End(TagEnd::Emphasis) => style.emphasis = false,
            Event::Text(text) if block == Block::Code => code.push_str(&text),
            Event::Text(text) => paragraph.text(ui, &text, style, block),
            Event::Code(text) => paragraph.text(ui, &text, Style { code: true, ..style }, block),
            Event::InlineMath(tex) => paragraph.equation(ui, &tex, style, block),
            Event::DisplayMath(tex) => {
                paragraph.end(ui, block);
                equation_ui(ui, tex.trim());
            }
            Event::SoftBreak | Event::HardBreak => paragraph.text(ui, " ", style, block),
            Event::End(TagEnd::CodeBlock) => {
                plate_ui(ui, |ui| drop(ui.label(RichText::new(code.trim_end()).monospace())));
                code.clear();
                block = Block::Paragraph;
            }
            Event::End(TagEnd::Paragraph | TagEnd::Heading(_) | TagEnd::Item) => {
                paragraph.end(ui, block);
                block = Block::Paragraph;
            }
            _ => {}
        }
    }
}

fn format(ui: &Ui, style: Style, block: Block) -> TextFormat {
    let palette = Palette::get(ui);
    let body = TextStyle::Body.resolve(ui.style()).size;
    let size = if block == Block::Heading { body + 4.0 } else { body + 1.0 };
    let family = if style.code { FontFamily::Monospace } else { FontFamily::Proportional };
    TextFormat {
        font_id: FontId::new(size, family),
        color: if style.strong || block == Block::Heading { palette.strong } else { palette.text },
        italics: style.emphasis,
        line_height: Some(1.38 * size),
        valign: Align::Center,
        background: if style.code { palette.well } else { Color32::TRANSPARENT },
        ..TextFormat::default()
    }
}

impl Paragraph {
    fn text(&mut self, ui: &Ui, text: &str, style: Style, block: Block) {
        self.job.append(&text.replace(HELD, " "), 0.0, format(ui, style, block));
    }

    /// Appends placeholder characters whose total width is that of the equation.
    fn equation(&mut self, ui: &Ui, tex: &str, style: Style, block: Block) {
        let format = format(ui, style, block);
        let em = MATHS_SCALE * format.font_id.size;
        let Ok(equation) = equation(ui.ctx(), tex, Place::Inline, em) else {
            let color = Palette::get(ui).error;
            return self.job.append(tex, 0.0, TextFormat { color, ..format });
        };
        let letter = ui.fonts_mut(|fonts| fonts.glyph_width(&format.font_id, HELD)).max(1.0);
        let width = equation.size.x - 2.0 * PADDING;
        let letters = ((width / letter) as usize).max(2);
        let extra_letter_spacing = (width - letters as f32 * letter) / (letters - 1) as f32;
        let held: String = std::iter::repeat_n(HELD, letters).collect();
        self.job.append(&held, 0.0, TextFormat { extra_letter_spacing, ..format });
        self.equations.push(Inline { tex: tex.to_owned(), equation, letters });
    }

    /// Draws the paragraph and clears it.
    fn end(&mut self, ui: &mut Ui, block: Block) {
        let Self { job, equations } = std::mem::take(self);
        if job.is_empty() {
            return;
        }
        if block == Block::Item {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
                ui.label("•");
                paragraph_ui(ui, job, &equations);
            });
        } else {
            paragraph_ui(ui, job, &equations);
        }
        ui.add_space(if block == Block::Item { 0.5 * UNIT } else { 1.5 * UNIT });
    }
}

fn paragraph_ui(ui: &mut Ui, mut job: LayoutJob, equations: &[Inline]) {
    job.wrap.max_width = ui.available_width();
    let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let label = ui.add(Label::new(Arc::clone(&galley)));
    let corner = label.rect.min;
    let mut held = galley.rows.iter().flat_map(|row| {
        let from = corner + row.pos.to_vec2();
        row.glyphs.iter().filter(|glyph| glyph.chr == HELD).map(move |glyph| from + glyph.pos.to_vec2())
    });
    for (i, Inline { tex, equation, letters }) in equations.iter().enumerate() {
        let Some(baseline) = held.next() else { return };
        held.by_ref().take(letters - 1).for_each(drop);
        let rect = Rect::from_min_size(baseline - Vec2::new(PADDING, equation.baseline), equation.size);
        paint(ui, equation, rect.min, Palette::get(ui).strong);
        spoken(&ui.interact(rect, label.id.with(i), egui::Sense::hover()), tex);
    }
}

fn paint(ui: &Ui, equation: &Equation, corner: Pos2, colour: Color32) {
    use egui::emath::GuiRounding as _;
    let rect = Rect::from_min_size(corner.round_to_pixels(ui.pixels_per_point()), equation.size);
    let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    ui.painter().image(equation.texture.id(), rect, whole, colour);
}

/// Gives screen readers the TeX source of an equation.
fn spoken(response: &Response, tex: &str) {
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, tex));
}

/// Draws a display equation in a frame, at a smaller font size if it is wider than the column.
fn equation_ui(ui: &mut Ui, tex: &str) {
    let palette = Palette::get(ui);
    plate_ui(ui, |ui| {
        let em = MATHS_SCALE * (TextStyle::Body.resolve(ui.style()).size + 2.0);
        let room = ui.available_width();
        let fitting = equation(ui.ctx(), tex, Place::Display, em).and_then(|at_full_size| {
            let scale = room / at_full_size.size.x;
            let smaller = || equation(ui.ctx(), tex, Place::Display, (scale * em).floor().max(6.0));
            if scale < 1.0 { smaller() } else { Ok(at_full_size) }
        });
        match fitting {
            Ok(equation) => {
                let (rect, response) = ui.allocate_exact_size(equation.size, egui::Sense::hover());
                paint(ui, &equation, rect.min, palette.strong);
                spoken(&response, tex);
            }
            Err(reason) => {
                ui.add(Label::new(RichText::new(format!("{tex}\n{reason}")).color(palette.error)).wrap());
            }
        }
    });
}

fn plate_ui(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    let palette = Palette::get(ui);
    Frame::NONE.fill(palette.well).corner_radius(4.0).inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.vertical_centered(content);
    });
    ui.add_space(2.0 * UNIT);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_of_a_text_are_found_and_checked() {
        assert_eq!(damaged_equation("costs 5 $, or $x^2$\n\n$$\n\\frac{1}{2}\n$$\n"), None);
        let said = damaged_equation("so $\\nosuch{1}$ it is").unwrap_or_default();
        assert!(said.contains("\\nosuch{1}"), "{said}");
    }
}
