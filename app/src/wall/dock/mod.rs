//! Tabs of statistics below the images. A tab is a file and a line in [`TABS`].

mod curves;
mod noise;
mod parts;
mod path;
mod pixel;
mod plots;
mod ranking;
pub(crate) mod ray;
mod scanline;

use super::inspector::Inspector;
use super::state::Wall;
use crate::model::{Command, Pair, WindowDoc};
use crate::theme::{Palette, UNIT};
use egui::{Align, Button, ComboBox, Frame, Label, Layout, Margin, RichText, Ui};
use majorant_core::scene::SceneDoc;

/// Context of a tab.
pub struct Cx<'a> {
    /// Views, images and statistics.
    pub wall: &'a Wall,
    /// The document.
    pub doc: &'a SceneDoc,
    /// State of the tabs that persists between frames.
    pub inspector: &'a mut Inspector,
    /// Commands issued by the tab.
    pub commands: &'a mut Vec<Command>,
}

/// A tab of the dock.
pub trait Tab: Sync {
    /// Stable id.
    fn id(&self) -> &'static str;
    /// Title.
    fn title(&self) -> &'static str;
    /// Draws the content.
    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>);
    /// Content as CSV, computed on request; `None` without data.
    fn csv(&self, cx: &mut Cx<'_>) -> Option<String>;
    /// Default height, as a fraction of the height of images and dock.
    fn share(&self) -> f32 {
        0.37
    }
    /// Whether the tab applies to a single view; the others need several.
    fn for_one_view(&self) -> bool {
        false
    }
}

/// Every tab, from left to right.
pub const TABS: &[&dyn Tab] = &[
    &ranking::Ranking,
    &curves::Curves,
    &pixel::Pixel,
    &scanline::Scanline,
    &path::Path,
    &ray::Ray,
    &parts::Parts,
    &noise::Noise,
];

/// Default height of the tab with an id, as a fraction of the height of images and dock.
#[must_use]
pub fn share(chosen: &str) -> f32 {
    TABS.iter().find(|tab| tab.id() == chosen).map_or(0.37, |tab| tab.share())
}

/// Draws the dock; `chosen` is the id of the current tab.
pub fn dock_ui(ui: &mut Ui, chosen: &str, cx: &mut Cx<'_>) {
    let palette = Palette::get(ui);
    let several = cx.doc.view_count() > 1;
    let offered: Vec<_> = TABS.iter().filter(|t| several || t.for_one_view()).collect();
    let Some(tab) = offered.iter().find(|t| t.id() == chosen).or(offered.first()) else { return };
    Frame::NONE.fill(palette.bar).inner_margin(Margin::symmetric(8, 3)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            let choose = |ui: &mut Ui, cx: &mut Cx<'_>, t: &dyn Tab| {
                let on = t.id() == tab.id();
                let text =
                    RichText::new(t.title()).small().color(if on { palette.strong } else { palette.text });
                if ui.add(Button::selectable(on, text)).clicked() {
                    cx.commands.push(Command::ShowTab(t.id()));
                }
            };
            if ui.available_width() < 72.0 * offered.len() as f32 {
                let list = ComboBox::from_id_salt("tabs").selected_text(RichText::new(tab.title()).small());
                let list = list.show_ui(ui, |ui| offered.iter().for_each(|t| choose(ui, cx, **t)));
                list.response.accessible_name("Tab of numbers");
            } else {
                offered.iter().for_each(|t| choose(ui, cx, **t));
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let button = Button::new(RichText::new("Copy as CSV").small());
                if ui.add_enabled(!cx.wall.analysis().standings.is_empty(), button).clicked()
                    && let Some(csv) = tab.csv(cx)
                {
                    ui.ctx().copy_text(csv);
                }
                let pair = cx.wall.analysis().pair.filter(|(pair, _)| *pair == WindowDoc::of(cx.doc).pair);
                if let Some((_, found)) = pair.filter(|_| cx.doc.view_count() > 1) {
                    let (text, colour) = pair_verdict(cx, &found, palette);
                    ui.add_space(UNIT);
                    ui.add(
                        Label::new(RichText::new(text).small().color(colour)).truncate().selectable(false),
                    );
                }
            });
        });
    });
    Frame::NONE.inner_margin(Margin::same(6)).show(ui, |ui| tab.ui(ui, cx));
}

/// Verdict on a pair of views, such as "A and B agree (p = .43)", with its colour.
fn pair_verdict(
    cx: &Cx<'_>,
    found: &majorant_core::compare::Agreement,
    palette: &Palette,
) -> (String, egui::Color32) {
    use super::caption::probability;
    use majorant_core::compare::{Verdict, label};
    let Pair(a, b) = WindowDoc::of(cx.doc).pair;
    let (a, b) = (label(a), label(b));
    let place = if cx.doc.compare.region.is_some() { " in the box" } else { "" };
    match found.verdict {
        Verdict::Agrees => (format!("{a} and {b} agree{place} ({})", probability(found.p)), palette.good),
        Verdict::Undecided => (format!("{a} and {b}: too noisy to tell{place}"), palette.weak),
        Verdict::Differs => {
            (format!("{a} and {b} differ: {}{place}", super::caption::size(found)), palette.error)
        }
    }
}

/// Draws the explanation of an empty tab.
fn empty(ui: &mut Ui, text: &str) {
    ui.add_space(12.0);
    ui.vertical_centered(|ui| ui.label(RichText::new(text).color(Palette::get(ui).weak)));
}
