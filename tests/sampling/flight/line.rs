//! A line through a rough grid, and the optical depth along it by quadrature in double precision, independent
//! of the renderer.

use glam::{DVec3, Vec3};
use majorant_core::math::Ray;
use std::path::Path;

const SIZE: [usize; 3] = [5, 4, 6];

/// Name of the raw file, which has to contain the size.
pub const FILE: &str = "rough_5x4x6.raw";

/// Placement of the box in a scene file; [`place_in_box`] is its inverse.
pub const PLACEMENT: &str = "{ fit = 1.0, scale = [1.0, 1.3, 0.8], rotate_deg = [0.0, 0.0, 30.0], \
                             translate = [0.2, -0.1, 0.3] }";

/// A line through the box, and the density along it.
pub struct Line {
    pub ray: Ray,
    /// Distance at which the line enters the box.
    pub enter: f64,
    /// Distance at which the line leaves the box.
    pub exit: f64,
    /// Maximum density of the box.
    pub max_density: f64,
    /// ∫ density from `enter` to each of equally spaced points.
    columns: Vec<f64>,
}

/// Density of a voxel, zero for some.
fn rough(x: usize, y: usize, z: usize) -> f32 {
    let hash = (x * 7 + y * 13 + z * 29 + x * y * z * 5) % 11;
    if hash < 3 { 0.0 } else { 0.15 * hash as f32 }
}

/// All densities, x fastest.
fn values() -> impl Iterator<Item = f32> {
    let [nx, ny, nz] = SIZE;
    (0..nx * ny * nz).map(move |i| rough(i % nx, i / nx % ny, i / (nx * ny)))
}

/// Writes the grid as a raw file.
pub fn write(folder: &Path) {
    let bytes: Vec<u8> = values().flat_map(f32::to_le_bytes).collect();
    std::fs::write(folder.join(FILE), bytes).unwrap();
}

/// Position of a world point in the box, 0 to 1.
fn place_in_box(point: DVec3, grid: bool) -> DVec3 {
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let p = point - DVec3::new(0.2, -0.1, 0.3);
    let turned_back = DVec3::new(cos * p.x + sin * p.y, cos * p.y - sin * p.x, p.z);
    // With `fit`, the longest side is 1.
    let sides = if grid { DVec3::from(SIZE.map(|n| n as f64 / 6.0)) } else { DVec3::ONE };
    turned_back / (DVec3::new(1.0, 1.3, 0.8) * sides) + 0.5
}

/// Trilinear interpolation between cell centres, constant beyond the outermost.
fn density(place: DVec3) -> f64 {
    let along = |axis: usize| {
        let s = (place[axis] * SIZE[axis] as f64 - 0.5).clamp(0.0, SIZE[axis] as f64 - 1.0);
        let i = (s as usize).min(SIZE[axis] - 2);
        [(i, 1.0 - (s - i as f64)), (i + 1, s - i as f64)]
    };
    let mut sum = 0.0;
    for (x, wx) in along(0) {
        for (y, wy) in along(1) {
            for (z, wz) in along(2) {
                sum += wx * wy * wz * f64::from(rough(x, y, z));
            }
        }
    }
    sum
}

impl Line {
    /// Creates a line through the grid, or through a box of density 1.
    pub fn new(grid: bool) -> Self {
        let ray =
            Ray { origin: Vec3::new(-1.5, 0.4, 0.9), direction: Vec3::new(1.7, -0.6, -0.5).normalize() };
        let at = |t: f64| place_in_box(ray.origin.as_dvec3() + ray.direction.as_dvec3() * t, grid);
        let (a, b) = (at(0.0), at(1.0));
        let (t0, t1) = (-a / (b - a), (1.0 - a) / (b - a));
        let (enter, exit) = (t0.min(t1).max_element(), t0.max(t1).min_element());
        assert!(0.0 < enter && enter + 0.5 < exit, "the line should cross the box: {enter} to {exit}");
        let steps = 30_000;
        let h = (exit - enter) / f64::from(steps);
        let mut columns = vec![0.0];
        for i in 0..steps {
            let middle = at(enter + (f64::from(i) + 0.5) * h);
            columns.push(columns[i as usize] + h * if grid { density(middle) } else { 1.0 });
        }
        let max_density = if grid { f64::from(values().fold(0.0, f32::max)) } else { 1.0 };
        Self { ray, enter, exit, max_density, columns }
    }

    /// ∫ density from the origin to distance `t`.
    pub fn column(&self, t: f64) -> f64 {
        let last = self.columns.len() - 1;
        let s = ((t - self.enter) / (self.exit - self.enter)).clamp(0.0, 1.0) * last as f64;
        let i = (s as usize).min(last - 1);
        self.columns[i] + (self.columns[i + 1] - self.columns[i]) * (s - i as f64)
    }
}
