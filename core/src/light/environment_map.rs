//! Environment map from an equirectangular image, importance-sampled by luminance.
//!
//! The top row is +y, the middle column −z, and x increases to the right of it. Texels are constant, so that
//! sampling in proportion to luminance is exact: a texel is drawn by its luminance times its solid angle,
//! then a direction uniformly within it. One direction in twenty is drawn uniformly over the sphere
//! instead, so that faint texels beside bright ones are also drawn.

use super::{Emitter, LightPoint, LightSample};
use crate::math::{INV_4PI, uniform_direction};
use crate::spectrum::Components;
use glam::{Vec2, Vec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Probability of drawing a direction uniformly over the sphere.
const UNIFORM: f32 = 0.05;

/// Image prepared for sampling; shared by all edits that do not change the file.
#[derive(Debug)]
pub struct Panorama {
    width: usize,
    height: usize,
    /// Linear sRGB, finite and not negative.
    texels: Vec<[f32; 3]>,
    /// Integral of luminance over the sphere.
    total: f64,
    /// Integral of luminance over the rows above, `height + 1` entries from 0 to `total`.
    rows: Vec<f64>,
    /// Sum of luminance of the texels to the left, `width + 1` entries per row.
    columns: Vec<f64>,
}

impl Panorama {
    /// Prepares an image in finite, non-negative linear sRGB; `None` if it is empty or black.
    #[must_use]
    pub fn new(width: usize, height: usize, texels: Vec<[f32; 3]>) -> Option<Self> {
        if width == 0 || height == 0 || texels.len() != width * height {
            return None;
        }
        let mut rows = vec![0.0f64];
        let mut columns = Vec::with_capacity((width + 1) * height);
        for (y, row) in texels.chunks_exact(width).enumerate() {
            let mut sum = 0.0f64;
            columns.push(sum);
            for texel in row {
                sum += luminance(*texel);
                columns.push(sum);
            }
            rows.push(rows[y] + sum * band(y, height) * TAU / width as f64);
        }
        let total = rows[height];
        (total > 0.0 && total.is_finite()).then_some(Self { width, height, texels, total, rows, columns })
    }

    /// Density of a direction, per steradian.
    fn density(&self, d: Vec3) -> f32 {
        let bright = luminance(self.texel(d)) / self.total;
        UNIFORM * INV_4PI + (1.0 - UNIFORM) * bright as f32
    }

    /// The texel in a direction.
    fn texel(&self, d: Vec3) -> [f32; 3] {
        let u = 0.5 + d.x.atan2(-d.z) / TAU as f32;
        let v = d.y.clamp(-1.0, 1.0).acos() / PI as f32;
        let x = ((u * self.width as f32) as usize).min(self.width - 1);
        let y = ((v * self.height as f32) as usize).min(self.height - 1);
        self.texels[y * self.width + x]
    }

    /// Draws a direction.
    fn sample(&self, u: Vec2) -> Vec3 {
        if u.x < UNIFORM {
            return uniform_direction(Vec2::new(u.x / UNIFORM, u.y));
        }
        let (y, v) = invert(&self.rows, f64::from((u.x - UNIFORM) / (1.0 - UNIFORM)));
        let row = &self.columns[y * (self.width + 1)..(y + 1) * (self.width + 1)];
        let (x, s) = invert(row, f64::from(u.y));
        let phi = TAU * ((x as f64 + s) / self.width as f64 - 0.5);
        let cos = cos_edge(y, self.height) - v * band(y, self.height);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        Vec3::new((sin * phi.sin()) as f32, cos as f32, (-sin * phi.cos()) as f32)
    }
}

/// Environment map placed in a scene.
#[derive(Clone, Debug)]
pub struct EnvironmentMap {
    /// Image.
    pub panorama: Arc<Panorama>,
    /// Scale factor of the image.
    pub scale: f32,
    /// Rotation of the image about +y, in radians.
    pub rotate: f32,
}

impl EnvironmentMap {
    /// Luminance integrated over all directions.
    #[must_use]
    pub fn illuminance(&self) -> f32 {
        self.panorama.total as f32 * self.scale
    }

    fn turned(&self, d: Vec3, angle: f32) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        Vec3::new(cos * d.x + sin * d.z, d.y, cos * d.z - sin * d.x)
    }
}

impl Emitter for EnvironmentMap {
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample> {
        let direction = self.turned(self.panorama.sample(u), self.rotate);
        // Density of the rounded direction, which at a texel's border may fall into the neighbouring texel.
        let point = LightPoint { direction, distance: f32::INFINITY, triangle: 0 };
        Some(LightSample { point, density: self.density(from, &point) })
    }

    fn density(&self, _from: Vec3, at: &LightPoint) -> f32 {
        self.panorama.density(self.turned(at.direction, -self.rotate))
    }

    fn radiance<const N: usize, C: Components<N>>(&self, direction: Vec3, components: &C) -> C::Radiance {
        let texel = self.panorama.texel(self.turned(direction, -self.rotate));
        components.radiance_of_rgb(Vec3::from(texel) * self.scale)
    }
}

fn luminance([r, g, b]: [f32; 3]) -> f64 {
    0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
}

/// cos θ at the upper edge of row `y`.
fn cos_edge(y: usize, height: usize) -> f64 {
    (PI * y as f64 / height as f64).cos()
}

/// Difference of cos θ across row `y`, its solid angle divided by 2π, as a product without cancellation
/// at the poles.
fn band(y: usize, height: usize) -> f64 {
    let step = PI / height as f64;
    2.0 * ((y as f64 + 0.5) * step).sin() * (0.5 * step).sin()
}

/// Inverts a cumulative table at the share `u` of its last entry: index of the step, and position within it.
fn invert(cumulative: &[f64], u: f64) -> (usize, f64) {
    let last = cumulative.len() - 1;
    let target = u * cumulative[last];
    let i = cumulative.partition_point(|c| *c <= target).saturating_sub(1).min(last - 1);
    let width = cumulative[i + 1] - cumulative[i];
    (i, if width > 0.0 { ((target - cumulative[i]) / width).min(1.0) } else { 0.5 })
}
