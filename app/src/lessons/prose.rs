//! Markdown as it is read: headings, paragraphs, lists, and equations in code blocks.

use crate::theme::{Palette, UNIT};
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, FontFamily, FontId, Frame, Label, Margin, RichText, TextStyle, Ui};
use pulldown_cmark::{Event, Parser, Tag, TagEnd};

/// How a run of text is set.
#[derive(Clone, Copy, Default)]
struct Style {
    strong: bool,
    emphasis: bool,
    code: bool,
}

/// What is being collected.
#[derive(Clone, Copy, PartialEq)]
enum Block {
    Paragraph,
    Heading,
    Item,
    Equation,
}

/// Shows a text.
pub fn prose_ui(ui: &mut Ui, markdown: &str) {
    let mut job = LayoutJob::default();
    let mut style = Style::default();
    let mut block = Block::Paragraph;
    let mut equation = String::new();
    for event in Parser::new(markdown) {
        match event {
            Event::Start(Tag::Heading { .. }) => block = Block::Heading,
            Event::Start(Tag::Item) => block = Block::Item,
            Event::Start(Tag::CodeBlock(_)) => block = Block::Equation,
            Event::Start(Tag::Strong) => style.strong = true,
            Event::End(TagEnd::Strong) => style.strong = false,
            Event::Start(Tag::Emphasis) => style.emphasis = true,
            Event::End(TagEnd::Emphasis) => style.emphasis = false,
            Event::Text(text) if block == Block::Equation => equation.push_str(&text),
            Event::Text(text) => append(ui, &mut job, &text, style, block),
            Event::Code(text) => append(ui, &mut job, &text, Style { code: true, ..style }, block),
            Event::SoftBreak | Event::HardBreak => append(ui, &mut job, " ", style, block),
            Event::End(TagEnd::CodeBlock) => {
                equation_ui(ui, equation.trim_end());
                equation.clear();
                block = Block::Paragraph;
            }
            Event::End(TagEnd::Paragraph | TagEnd::Heading(_) | TagEnd::Item) => {
                block_ui(ui, std::mem::take(&mut job), block);
                block = Block::Paragraph;
            }
            _ => {}
        }
    }
}

fn append(ui: &Ui, job: &mut LayoutJob, text: &str, style: Style, block: Block) {
    let palette = Palette::get(ui);
    let body = TextStyle::Body.resolve(ui.style()).size;
    let size = if block == Block::Heading { body + 4.0 } else { body + 1.0 };
    let family = if style.code { FontFamily::Monospace } else { FontFamily::Proportional };
    let format = TextFormat {
        font_id: FontId::new(size, family),
        color: if style.strong || block == Block::Heading { palette.strong } else { palette.text },
        italics: style.emphasis,
        line_height: Some(1.38 * size),
        valign: Align::Center,
        background: if style.code { palette.well } else { egui::Color32::TRANSPARENT },
        ..TextFormat::default()
    };
    job.append(text, 0.0, format);
}

fn block_ui(ui: &mut Ui, job: LayoutJob, block: Block) {
    if job.is_empty() {
        return;
    }
    match block {
        Block::Item => {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
                ui.label("•");
                ui.add(Label::new(job).wrap());
            });
        }
        _ => {
            ui.add(Label::new(job).wrap());
        }
    }
    ui.add_space(if block == Block::Item { 0.5 * UNIT } else { 1.5 * UNIT });
}

/// In the middle of a plate of its own.
fn equation_ui(ui: &mut Ui, text: &str) {
    let palette = Palette::get(ui);
    Frame::NONE.fill(palette.well).corner_radius(4.0).inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.vertical_centered(|ui| {
            for line in text.lines() {
                let size = TextStyle::Body.resolve(ui.style()).size + 2.0;
                ui.add(Label::new(RichText::new(line).size(size).italics().color(palette.strong)).wrap());
            }
        });
    });
    ui.add_space(2.0 * UNIT);
}
