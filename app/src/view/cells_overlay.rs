//! Overlay of the majorant grid, coloured by the tightness of each local bound.
//!
//! One slice of the grid is shown, perpendicular to the axis closest to the view direction.
//! A cell's colour is its tightness, mean density over bound: 1 where every collision is real, near 0 where
//! nearly all are null. Cells in which a free flight found the extinction to exceed the majorant are red, and
//! their opacity increases with the ratio. Empty cells are transparent.

use super::image_view::ImageView;
use crate::theme::Palette;
use egui::{Align2, Color32, Mesh, Painter, Pos2, Rect, Shape, Stroke, TextStyle, Ui, Vec2, pos2, vec2};
use glam::{Affine3A, Vec3};
use majorant_core::medium::MajorantCells;
use majorant_core::scene::Camera;
use majorant_core::session::Probe;

/// Maximum resolution at which lines are drawn between cells.
const MOST_LINED: usize = 32;
const ALPHA: f32 = 0.45;

/// Slice of the majorant grid of a medium.
#[derive(Clone, Copy, Debug)]
pub struct Slice {
    /// Index of the medium in the document.
    pub medium: usize,
    /// Depth from 0 (nearest) to 1 (farthest).
    pub depth: f32,
}

/// Draws a slice and its legend.
pub fn paint(
    ui: &Ui,
    canvas: Rect,
    view: ImageView,
    image: Vec2,
    probe: &Probe,
    camera: &Camera,
    slice: Slice,
) {
    let Some(medium) = probe.scene().medium_of_document(slice.medium) else { return };
    let Some(cells) = medium.placed.medium.majorant_cells() else { return };
    let Some(violations) = probe.violations(slice.medium) else { return };
    let world_from_medium = medium.medium_from_world().inverse();
    let painter = ui.painter_at(canvas);
    let slice = Layer::facing(&world_from_medium, camera, &cells, slice.depth);
    let corners = slice.corners(&world_from_medium, camera, |at| view.screen_from_image(canvas, image, at));
    let n = cells.cells();
    let mut mesh = Mesh::default();
    let mut lines = Vec::new();
    let mut violated = false;
    let line = Stroke::new(0.5, Color32::from_white_alpha(60));
    for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
        let at = |i: usize, j: usize| corners[i + (n + 1) * j];
        let [Some(a), Some(b), Some(c), Some(d)] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
        else {
            continue;
        };
        let cell = slice.cell(i, j);
        let Some(tightness) = cells.tightness(cell) else { continue };
        let first = mesh.vertices.len() as u32;
        let excess = violations.largest(cell);
        violated |= excess > 1.0;
        let colour = if excess > 1.0 { violation(excess) } else { colour(tightness).gamma_multiply(ALPHA) };
        for corner in [a, b, c, d] {
            mesh.colored_vertex(corner, colour);
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
        if n <= MOST_LINED {
            lines.push(Shape::closed_line(vec![a, b, c, d], line));
        }
    }
    painter.add(mesh);
    painter.extend(lines);
    legend(ui, &painter, canvas, &slice, n);
    if violated {
        violation_legend(ui, &painter, canvas);
    }
}

/// One layer of majorant cells, perpendicular to an axis.
struct Layer {
    axis: usize,
    layer: usize,
    cells: usize,
}

impl Layer {
    fn facing(world_from_medium: &Affine3A, camera: &Camera, cells: &MajorantCells<'_>, depth: f32) -> Self {
        let middle = world_from_medium.transform_point3(Vec3::splat(0.5));
        let toward = (middle - camera.origin()).normalize_or(Vec3::Z);
        let along = |axis: usize| {
            world_from_medium.transform_vector3(Vec3::AXES[axis]).normalize_or_zero().dot(toward)
        };
        let axis =
            (0..3).fold(0, |best, axis| if along(axis).abs() > along(best).abs() { axis } else { best });
        let n = cells.cells();
        let nearest_first = ((depth * n as f32) as usize).min(n - 1);
        let layer = if along(axis) >= 0.0 { nearest_first } else { n - 1 - nearest_first };
        Self { axis, layer, cells: n }
    }

    fn cell(&self, i: usize, j: usize) -> [usize; 3] {
        match self.axis {
            0 => [self.layer, i, j],
            1 => [i, self.layer, j],
            _ => [i, j, self.layer],
        }
    }

    /// Screen positions of the cell corners in the middle of the layer; `None` behind the camera.
    fn corners(
        &self,
        world_from_medium: &Affine3A,
        camera: &Camera,
        screen: impl Fn(Pos2) -> Pos2,
    ) -> Vec<Option<Pos2>> {
        let n = self.cells as f32;
        let middle = (self.layer as f32 + 0.5) / n;
        let side = 0..=self.cells;
        let at = |(j, i): (usize, usize)| {
            let (u, v) = (i as f32 / n, j as f32 / n);
            let unit = match self.axis {
                0 => Vec3::new(middle, u, v),
                1 => Vec3::new(u, middle, v),
                _ => Vec3::new(u, v, middle),
            };
            let pixel = camera.pixel_of(world_from_medium.transform_point3(unit))?;
            Some(screen(pos2(pixel.x, pixel.y)))
        };
        side.clone().flat_map(|j| side.clone().map(move |i| (j, i))).map(at).collect()
    }
}

fn colour(tightness: f32) -> Color32 {
    let colorous::Color { r, g, b } = colorous::VIRIDIS.eval_continuous(f64::from(tightness.clamp(0.0, 1.0)));
    Color32::from_rgb(r, g, b)
}

/// Colour of a cell in which extinction divided by majorant reached `excess`.
fn violation(excess: f32) -> Color32 {
    let fullness = 0.35 + 0.5 * (1.0 - 1.0 / excess.max(1.0));
    Color32::from_rgb(225, 40, 40).gamma_multiply(fullness)
}

/// Legend of violated cells, above the tightness bar.
fn violation_legend(ui: &Ui, painter: &Painter, canvas: Rect) {
    let palette = Palette::get(ui);
    let font = TextStyle::Small.resolve(ui.style());
    let at = canvas.left_bottom() + vec2(8.0, -80.0);
    let plate = Rect::from_min_size(at, vec2(236.0, 24.0).min(canvas.size() - Vec2::splat(16.0)));
    painter.rect_filled(plate, 4.0, palette.panel.gamma_multiply(0.9));
    let swatch = Rect::from_center_size(plate.left_center() + vec2(14.0, 0.0), Vec2::splat(10.0));
    painter.rect_filled(swatch, 2.0, violation(4.0));
    let text = "the extinction exceeds the majorant";
    painter.text(swatch.right_center() + vec2(8.0, 0.0), Align2::LEFT_CENTER, text, font, palette.text);
}

/// Legend of the tightness scale, in the lower left corner.
fn legend(ui: &Ui, painter: &Painter, canvas: Rect, slice: &Layer, cells: usize) {
    let palette = Palette::get(ui);
    let font = TextStyle::Small.resolve(ui.style());
    let size = vec2(236.0, 44.0).min(canvas.size() - Vec2::splat(16.0));
    if size.min_elem() < 40.0 {
        return;
    }
    let plate = Rect::from_min_size(canvas.left_bottom() + vec2(8.0, -8.0 - size.y), size);
    painter.rect_filled(plate, 4.0, palette.panel.gamma_multiply(0.9));
    let axis = ["x", "y", "z"][slice.axis];
    let text = format!("{cells}³ majorants, {axis} layer {} of {cells}", slice.layer + 1);
    painter.text(plate.min + vec2(8.0, 5.0), Align2::LEFT_TOP, text, font.clone(), palette.strong);
    let y = plate.bottom() - 12.0;
    let label =
        |x: f32, align: Align2, text: &str| painter.text(pos2(x, y), align, text, font.clone(), palette.text);
    let left = label(plate.left() + 8.0, Align2::LEFT_CENTER, "null");
    let right = label(plate.right() - 8.0, Align2::RIGHT_CENTER, "real");
    let bar = Rect::from_x_y_ranges(left.right() + 6.0..=right.left() - 6.0, y - 4.0..=y + 4.0);
    for step in 0..64u8 {
        let share = |i: u8| f32::from(i) / 64.0;
        let x = egui::lerp(bar.x_range(), share(step))..=egui::lerp(bar.x_range(), share(step + 1)) + 0.5;
        painter.rect_filled(Rect::from_x_y_ranges(x, bar.y_range()), 0.0, colour(share(step)));
    }
}
