//! 3D view of a path: bounding box of the medium, lights, and events by kind. Dragging orbits the view.

use super::super::Cx;
use super::event::colour;
use crate::theme::Palette;
use crate::view::camera_control::{dolly, orbit};
use crate::wall::inspector::Replayed;
use egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};
use glam::Vec3;
use majorant_core::inspect::{Branch, Row, Step};
use majorant_core::medium::Region;
use majorant_core::scene::{Camera, CameraDoc, LightDoc, Scene, SceneDoc, SceneMedium};
use majorant_core::surface::{self, MeshInstance, Solid};
use majorant_core::transport::Note;

/// Number of steps in the search for the visible part of a line.
const STEPS: u8 = 64;

/// Projection and painter of the 3D view.
struct Eye<'a> {
    camera: Camera,
    rect: Rect,
    painter: Painter,
    palette: &'a Palette,
}

impl Eye<'_> {
    fn see(&self, point: Vec3) -> Option<Pos2> {
        let at = self.camera.pixel_of(point)?;
        at.is_finite().then(|| self.rect.min + vec2(at.x, at.y))
    }

    /// Screen end points of the part of a line in front of the camera.
    fn seen_part(&self, a: Vec3, b: Vec3) -> Option<[Pos2; 2]> {
        let near = |end: Vec3, other: Vec3| {
            // The end point itself, or the visible point closest to it.
            (0..=STEPS).find_map(|i| self.see(end.lerp(other, f32::from(i) / f32::from(STEPS))))
        };
        Some([near(a, b)?, near(b, a)?])
    }

    fn line(&self, a: Vec3, b: Vec3, stroke: Stroke) {
        if let Some(ends) = self.seen_part(a, b) {
            self.painter.line_segment(ends, stroke);
        }
    }

    fn dashed(&self, a: Vec3, b: Vec3, stroke: Stroke) {
        if let Some(ends) = self.seen_part(a, b) {
            self.painter.extend(Shape::dashed_line(&ends, stroke, 5.0, 4.0));
        }
    }
}

pub(super) fn space_ui(ui: &mut Ui, cx: &mut Cx<'_>, replayed: &Replayed) {
    let palette = Palette::get(ui);
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "The path in space"));
    let view = cx.wall.selected();
    let Some(probe) = cx.wall.slots().get(view).and_then(|slot| slot.probe().cloned()) else { return };
    let Some(doc) = cx.doc.view_doc(view) else { return };
    let scene = probe.scene();
    let (center, size) = extent(scene);
    let state = &mut cx.inspector.path;
    let eye = state.eye.get_or_insert_with(|| first_look(&doc, center, size));
    if response.dragged() {
        let by = response.drag_delta() / rect.size();
        *eye = orbit(eye, by.x, by.y);
    }
    if response.hovered() {
        let scrolled = ui.input(|input| input.smooth_scroll_delta().y);
        if scrolled != 0.0 {
            *eye = dolly(eye, (-scrolled * 0.004).exp());
        }
    }
    if response.double_clicked() {
        *eye = first_look(&doc, center, size);
    }
    let camera = Camera::new(eye, rect.width() as u32, rect.height() as u32);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 3.0, palette.well);
    let eye = Eye { camera, rect, painter, palette };
    eye.media(scene);
    eye.objects(scene);
    eye.lights(&doc, center, size);
    eye.path(replayed, center, size);
    if let Some(row) = replayed.ledger.rows.get(state.step) {
        eye.cell(scene, row);
        eye.lobe(scene, replayed, row, size);
        eye.mark(row);
    }
    eye.legend();
    // A click selects the nearest event.
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked()) {
        let near =
            |row: &Row| row.point.and_then(|p| eye.see(p)).map_or(f32::INFINITY, |seen| seen.distance(at));
        let rows = replayed.ledger.rows.iter().enumerate();
        let nearest = rows.map(|(i, row)| (i, near(row))).min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((i, distance)) = nearest
            && distance < 12.0
        {
            (state.step, state.scroll) = (i, true);
        }
    }
    response.on_hover_text_at_pointer(
        "Drag to orbit, scroll to zoom, click to select an event, double-click to reset",
    );
}

/// Colour of lights.
const LIGHT: Color32 = Color32::from_rgb(236, 190, 60);

/// Number of triangles up to which all edges of a mesh are drawn.
const MOST_EDGES: u32 = 400;

/// Centre and diagonal of the bounds of all media.
fn extent(scene: &Scene) -> (Vec3, f32) {
    let [lo, hi] = [scene.info.world_min, scene.info.world_max].map(Vec3::from);
    (0.5 * (lo + hi), (hi - lo).length())
}

/// The medium of an event: that of its collision, or else the only medium.
fn medium_of<'s>(scene: &'s Scene, row: &Row) -> Option<&'s SceneMedium> {
    let index = row.found.map_or(0, |found| found.medium);
    scene.media.get(index as usize)
}

/// Initial camera: beside the scene's camera and slightly higher, so that the camera ray is visible.
fn first_look(doc: &SceneDoc, center: Vec3, size: f32) -> CameraDoc {
    let up = Vec3::from(doc.camera.up).normalize_or(Vec3::Y);
    let back = (Vec3::from(doc.camera.origin) - center).normalize_or(Vec3::Z);
    let side = up.cross(back).normalize_or(up.any_orthonormal_vector());
    let from = (back * 0.75 + side * 0.75 + up * 0.4).normalize();
    CameraDoc {
        origin: (center + from * (1.9 * size)).to_array(),
        target: center.to_array(),
        fov_deg: 42.0,
        ..doc.camera.clone()
    }
}

impl Eye<'_> {
    /// Draws the boundaries of all media: the edges of boxes, balls by three circles.
    fn media(&self, scene: &Scene) {
        let stroke = Stroke::new(1.0, self.palette.line);
        for medium in &scene.media {
            match &medium.placed.region {
                Region::Cube(medium_from_world) => {
                    let world = medium_from_world.inverse();
                    self.frame(|unit| world.transform_point3(unit), stroke);
                }
                Region::Ball(radius) => self.circles(Vec3::ZERO, *radius, stroke),
                Region::Inside { solid, .. } => self.solid(solid, stroke),
                Region::Everywhere => {}
            }
        }
    }

    /// Draws the edges of a box, a sphere by three circles, and the bounds of a mesh.
    fn solid(&self, solid: &Solid, stroke: Stroke) {
        match solid {
            Solid::Sphere(sphere) => self.circles(sphere.center, sphere.radius, stroke),
            Solid::Box(b) => {
                let corner = |unit: Vec3| (unit * 2.0 - 1.0) * b.half_size;
                self.frame(|unit| b.center + b.world_from_box * corner(unit), stroke);
            }
            Solid::Mesh(mesh) => self.mesh(mesh, stroke),
        }
    }

    /// Draws the edges of a small mesh, or the bounds of a large one.
    fn mesh(&self, mesh: &MeshInstance, stroke: Stroke) {
        let count = mesh.mesh().triangle_count() as u32;
        if count > MOST_EDGES {
            let (lo, hi) = mesh.bounds();
            self.frame(|unit| lo + unit * (hi - lo), stroke);
            return;
        }
        for [a, b, c] in (0..count).map(|triangle| mesh.corners(triangle)) {
            [(a, b), (b, c), (c, a)].into_iter().for_each(|(from, to)| self.line(from, to, stroke));
        }
    }

    /// Draws the outlines of surfaces, except for those of lights, which are drawn from the document.
    fn objects(&self, scene: &Scene) {
        for visible in scene.surfaces.iter().filter(|surface| surface.material.is_some()) {
            let color = if visible.light.is_some() { LIGHT } else { self.palette.weak };
            let stroke = Stroke::new(0.8, color);
            match &visible.shape {
                surface::Shape::Sphere(s) => self.solid(&Solid::Sphere(*s), stroke),
                surface::Shape::Box(b) => self.solid(&Solid::Box(*b), stroke),
                surface::Shape::Mesh(mesh) => self.mesh(mesh, stroke),
                surface::Shape::Disk(disk) => {
                    let (u, v) = disk.normal.any_orthonormal_pair();
                    self.circle(disk.center, (u, v), disk.radius, stroke);
                }
                surface::Shape::Rectangle(r) => {
                    let corners =
                        [r.half_u + r.half_v, r.half_v - r.half_u, -r.half_u - r.half_v, r.half_u - r.half_v];
                    for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                        self.line(r.center + *from, r.center + *to, stroke);
                    }
                }
                // An infinite plane has no outline.
                surface::Shape::Plane(_) => {}
            }
        }
    }

    /// Draws three circles of a sphere.
    fn circles(&self, center: Vec3, radius: f32, stroke: Stroke) {
        for axes in [(Vec3::X, Vec3::Y), (Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X)] {
            self.circle(center, axes, radius, stroke);
        }
    }

    /// Draws a circle in the plane of two unit vectors.
    fn circle(&self, center: Vec3, axes: (Vec3, Vec3), radius: f32, stroke: Stroke) {
        let at = |i: u16| {
            let (sin, cos) = (f32::from(i) * std::f32::consts::TAU / 32.0).sin_cos();
            center + (axes.0 * cos + axes.1 * sin) * radius
        };
        (0..32).for_each(|i| self.line(at(i), at(i + 1), stroke));
    }

    fn frame(&self, at: impl Fn(Vec3) -> Vec3, stroke: Stroke) {
        for axis in 0..3 {
            for corner in 0..4u8 {
                let mut from = Vec3::ZERO;
                from[(axis + 1) % 3] = f32::from(corner & 1);
                from[(axis + 2) % 3] = f32::from(corner >> 1);
                self.line(at(from), at(from + Vec3::AXES[axis]), stroke);
            }
        }
    }

    /// Draws rectangle and sphere lights as outlines, and suns as arrows.
    fn lights(&self, doc: &SceneDoc, center: Vec3, size: f32) {
        let stroke = Stroke::new(1.4, LIGHT);
        for light in &doc.lights {
            match light {
                LightDoc::Rectangle { center, target, up, size, .. } => {
                    let center = Vec3::from(*center);
                    let facing = (Vec3::from(*target) - center).normalize_or(Vec3::Z);
                    let right = facing.cross(Vec3::from(*up)).normalize_or(facing.any_orthonormal_vector());
                    let (right, up) = (right * (0.5 * size[0]), right.cross(facing) * (0.5 * size[1]));
                    let corners = [-right - up, right - up, right + up, up - right];
                    for i in 0..4 {
                        self.line(center + corners[i], center + corners[(i + 1) % 4], stroke);
                    }
                }
                LightDoc::Sphere { center, radius, .. } => {
                    self.circles(Vec3::from(*center), *radius, Stroke::new(0.7, stroke.color));
                }
                LightDoc::Sun { toward, .. } => {
                    let toward = Vec3::from(*toward).normalize_or(Vec3::Y);
                    let (far, near) = (center + toward * (1.25 * size), center + toward * (0.85 * size));
                    if let (Some(far), Some(near)) = (self.see(far), self.see(near)) {
                        self.painter.arrow(far, near - far, stroke);
                    }
                }
                _ => {}
            }
        }
    }

    /// Draws the path's segments, connections and events.
    fn path(&self, replayed: &Replayed, center: Vec3, size: f32) {
        let ledger = &replayed.ledger;
        let strong = Stroke::new(1.6, self.palette.text);
        let mut last = None;
        for row in ledger.rows.iter().filter(|row| row.branch == Branch::Path) {
            if let Some(point) = row.point {
                if let Some(from) = last {
                    self.line(from, point, strong);
                }
                last = Some(point);
            }
        }
        // A path that is not absorbed continues out of the medium.
        if let (Some(from), Some(direction)) = (last, last_direction(replayed))
            && ledger
                .rows
                .iter()
                .rfind(|row| row.branch == Branch::Path)
                .is_some_and(|r| r.step != Step::Absorb)
        {
            let far = from.distance(center) + size;
            self.line(from, from + direction * far, Stroke::new(1.2, self.palette.weak));
        }
        for note in &replayed.recording.notes {
            if let Note::Connect { ray, distance, .. } = note {
                let end = ray.origin + ray.direction * distance.min(1.2 * size);
                self.dashed(ray.origin, end, Stroke::new(1.1, Color32::from_rgb(228, 138, 62)));
            }
        }
        for row in &ledger.rows {
            let Some(at) = row.point.and_then(|point| self.see(point)) else { continue };
            let colour = colour(row, self.palette);
            match row.step {
                Step::Null => {
                    self.painter.circle_stroke(at, 2.6, Stroke::new(1.2, colour));
                }
                Step::Absorb | Step::Terminate(_) => {
                    self.painter.rect_filled(Rect::from_center_size(at, vec2(7.0, 7.0)), 0.0, colour);
                }
                Step::Scatter | Step::Reflect => {
                    self.painter.circle_filled(at, 4.0, colour);
                }
                Step::Camera => {
                    self.painter.circle_filled(at, 4.5, self.palette.strong);
                }
                _ => {}
            }
        }
    }

    /// Draws the majorant cell that contains the selected event.
    fn cell(&self, scene: &Scene, row: &Row) {
        let (Some(medium), Some(point)) = (medium_of(scene, row), row.point) else { return };
        let Some(cells) = medium.placed.medium.majorant_cells() else { return };
        let n = cells.cells() as f32;
        let unit = medium.medium_from_world().transform_point3(point);
        if unit.min_element() < 0.0 || unit.max_element() > 1.0 {
            return;
        }
        let corner = (unit * n).floor().min(Vec3::splat(n - 1.0));
        let world = medium.medium_from_world().inverse();
        let stroke = Stroke::new(1.0, self.palette.good);
        self.frame(|within| world.transform_point3((corner + within) / n), stroke);
    }

    /// Draws the phase function at the selected vertex, in the plane through the incident direction that
    /// faces the camera.
    fn lobe(&self, scene: &Scene, replayed: &Replayed, row: &Row, size: f32) {
        if !matches!(row.step, Step::Scatter | Step::Direction(..) | Step::Connect(..)) {
            return;
        }
        let (Some(medium), Some(point)) = (medium_of(scene, row), row.point) else { return };
        let phase = &medium.phase;
        let Some(arrived) = direction_before(replayed, row.note) else { return };
        let across =
            arrived.cross(point - self.camera.origin()).normalize_or(arrived.any_orthonormal_vector());
        let angles: Vec<f32> = (0..=96u8).map(|i| f32::from(i) * std::f32::consts::TAU / 96.0).collect();
        let largest = angles.iter().map(|a| phase.value(a.cos())).fold(f32::MIN_POSITIVE, f32::max);
        let outline = angles.iter().filter_map(|angle| {
            // Logarithmic over three decades below the peak, as in the panel.
            let radius = (1.0 + (phase.value(angle.cos()) / largest).max(1e-9).log10() / 3.0).max(0.0);
            let direction = arrived * angle.cos() + across * angle.sin();
            self.see(point + direction * (radius * 0.22 * size))
        });
        let outline: Vec<Pos2> = outline.collect();
        let stroke = Stroke::new(1.2, self.palette.accent.gamma_multiply(0.8));
        self.painter.add(Shape::line(outline, stroke));
    }

    fn mark(&self, row: &Row) {
        if let Some(at) = row.point.and_then(|point| self.see(point)) {
            self.painter.circle_stroke(at, 8.0, Stroke::new(2.0, self.palette.strong));
        }
    }

    fn legend(&self) {
        let entries = [
            ("scattering", self.palette.accent),
            ("null", self.palette.weak),
            ("connection", Color32::from_rgb(228, 138, 62)),
            ("majorant cell", self.palette.good),
        ];
        let mut at = self.rect.left_bottom() + vec2(8.0, -8.0);
        for (name, colour) in entries {
            let font = FontId::proportional(11.0);
            let drawn = self.painter.text(pos2(at.x, at.y), Align2::LEFT_BOTTOM, name, font, colour);
            at.x = drawn.right() + 10.0;
            if at.x > self.rect.right() - 60.0 {
                break;
            }
        }
    }
}

/// Direction of the path segment that precedes a note.
fn direction_before(replayed: &Replayed, note: usize) -> Option<Vec3> {
    replayed.recording.notes[..note].iter().rev().find_map(|note| match note {
        Note::Camera { ray, .. } | Note::Direction { ray, .. } | Note::Boundary { ray, .. } => {
            Some(ray.direction)
        }
        _ => None,
    })
}

fn last_direction(replayed: &Replayed) -> Option<Vec3> {
    direction_before(replayed, replayed.recording.notes.len())
}
