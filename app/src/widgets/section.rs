//! Collapsible section of a column: title left, summary of its content right.

use crate::theme::{Palette, UNIT};
use egui::{
    Align2, Color32, FontSelection, Frame, Margin, Pos2, Response, Role, Sense, Shape, Stroke, TextStyle, Ui,
    WidgetInfo, collapsing_header::CollapsingState, pos2, vec2,
};

/// Header of a section.
pub struct Header<'a> {
    /// Stable id.
    pub id: &'a str,
    /// Title.
    pub title: &'a str,
    /// Short summary of the content.
    pub summary: &'a str,
    /// Colour of a warning dot.
    pub alert: Option<Color32>,
    /// Whether it is open by default.
    pub open: bool,
}

/// Draws a section; the body is drawn only while it is open.
pub fn section(ui: &mut Ui, header: &Header<'_>, body: impl FnOnce(&mut Ui)) {
    let id = ui.make_persistent_id(("section", header.id));
    let mut state = CollapsingState::load_with_default_open(ui.ctx(), id, header.open);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 28.0), Sense::click());
    if response.clicked() {
        state.toggle(ui);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::DisclosureTriangle, true, header.title));
    let open = state.is_open();
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_expanded(open));
    let openness = state.openness(ui.ctx());
    paint(ui, header, rect, &response, openness);
    state.show_body_unindented(ui, |ui| {
        let margin = Margin { left: 12, right: 8, top: 8, bottom: 12 };
        Frame::NONE.inner_margin(margin).show(ui, |ui| {
            ui.set_width(ui.available_width());
            body(ui);
        });
    });
    ui.add_space(-ui.spacing().item_spacing.y);
}

fn paint(ui: &Ui, header: &Header<'_>, rect: egui::Rect, response: &Response, openness: f32) {
    let palette = Palette::get(ui);
    let hot = response.hovered() || response.has_focus();
    let fill = if hot { palette.header.lerp_to_gamma(palette.accent, 0.10) } else { palette.header };
    let painter = ui.painter();
    painter.rect_filled(rect, 0.0, fill);
    painter.hline(rect.x_range(), rect.bottom() - 0.5, Stroke::new(1.0, palette.line));
    let colour = if hot { palette.strong } else { palette.weak };
    chevron(ui, pos2(rect.left() + 13.0, rect.center().y), openness, colour);
    let font = FontSelection::from(TextStyle::Button).resolve(ui.style());
    let title = painter.text(
        pos2(rect.left() + 24.0, rect.center().y),
        Align2::LEFT_CENTER,
        header.title,
        font,
        palette.strong,
    );
    let mut right = rect.right() - 2.0 * UNIT;
    if let Some(alert) = header.alert {
        painter.circle_filled(pos2(right - 3.0, rect.center().y), 3.5, alert);
        right -= 14.0;
    }
    let small = FontSelection::from(TextStyle::Small).resolve(ui.style());
    let room = right - title.right() - 12.0;
    let mut job = egui::text::LayoutJob::simple_singleline(header.summary.into(), small, palette.weak);
    job.wrap = egui::text::TextWrapping::truncate_at_width(room.max(0.0));
    let galley = painter.layout_job(job);
    let at = pos2(right - galley.size().x, rect.center().y - 0.5 * galley.size().y);
    painter.galley(at, galley, palette.weak);
}

/// Draws the chevron, which points right when closed and down when open.
fn chevron(ui: &Ui, centre: Pos2, openness: f32, colour: Color32) {
    let turn = egui::emath::Rot2::from_angle(openness * std::f32::consts::FRAC_PI_2);
    let points = [vec2(-2.0, -4.0), vec2(2.5, 0.0), vec2(-2.0, 4.0)].map(|v| centre + turn * v);
    ui.painter().add(Shape::line(points.to_vec(), Stroke::new(1.6, colour)));
}
