//! Radiance by direction from an equirectangular picture, sampled in proportion to it.
//!
//! The top row is +y, the middle column −z, and x grows to the right of it. Texels are constant, so the
//! density is exactly proportional to what is emitted: a texel is drawn with its luminance times its
//! solid angle, and a direction uniformly over the texel's solid angle.

use super::{Emitter, LightSample};
use crate::spectrum::{Components, Sampled};
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};
use std::sync::Arc;

/// A picture prepared for sampling; shared by every edit that does not change the file.
#[derive(Debug)]
pub struct Panorama {
    width: usize,
    height: usize,
    /// Linear sRGB, finite and not negative.
    texels: Vec<[f32; 3]>,
    /// Cumulative probability of the rows, `height + 1` entries from 0 to 1.
    rows: Vec<f32>,
    /// Cumulative probability along each row, `width + 1` entries from 0 to 1.
    columns: Vec<f32>,
}

impl Panorama {
    /// Prepares a picture of finite, non-negative linear sRGB; `None` if it is empty or black.
    #[must_use]
    pub fn new(width: usize, height: usize, texels: Vec<[f32; 3]>) -> Option<Self> {
        if width == 0 || height == 0 || texels.len() != width * height {
            return None;
        }
        let mut rows = vec![0.0f64];
        let mut columns = Vec::with_capacity((width + 1) * height);
        for (y, row) in texels.chunks_exact(width).enumerate() {
            let mut sum = 0.0f64;
            let start = columns.len();
            columns.push(0.0f64);
            for texel in row {
                sum += f64::from(luminance(*texel));
                columns.push(sum);
            }
            for c in &mut columns[start..] {
                *c = if sum > 0.0 { *c / sum } else { 0.0 };
            }
            rows.push(rows[y] + sum * f64::from(band(y, height)));
        }
        let total = rows[height];
        if total <= 0.0 || !total.is_finite() {
            return None;
        }
        let rows = rows.iter().map(|r| (r / total) as f32).collect();
        let columns = columns.iter().map(|c| *c as f32).collect();
        Some(Self { width, height, texels, rows, columns })
    }

    fn column(&self, y: usize) -> &[f32] {
        &self.columns[y * (self.width + 1)..(y + 1) * (self.width + 1)]
    }

    /// Density per steradian over a texel.
    fn density(&self, x: usize, y: usize) -> f32 {
        let columns = self.column(y);
        let probability = (self.rows[y + 1] - self.rows[y]) * (columns[x + 1] - columns[x]);
        probability * self.width as f32 / (TAU * band(y, self.height))
    }

    fn texel_at(&self, d: Vec3) -> (usize, usize) {
        let u = 0.5 + d.x.atan2(-d.z) / TAU;
        let v = d.y.clamp(-1.0, 1.0).acos() / PI;
        (
            ((u * self.width as f32) as usize).min(self.width - 1),
            ((v * self.height as f32) as usize).min(self.height - 1),
        )
    }

    fn sample(&self, u: Vec2) -> (Vec3, f32) {
        let (y, v) = invert(&self.rows, u.x);
        let (x, s) = invert(self.column(y), u.y);
        let phi = TAU * ((x as f32 + s) / self.width as f32 - 0.5);
        let cos = cos_edge(y, self.height) - v * band(y, self.height);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        (Vec3::new(sin * phi.sin(), cos, -sin * phi.cos()), self.density(x, y))
    }
}

/// An environment map as placed in a scene.
#[derive(Clone, Debug)]
pub struct EnvironmentMap {
    /// The picture.
    pub panorama: Arc<Panorama>,
    /// Multiplies the picture.
    pub scale: f32,
    /// Turns the picture about +y, in radians.
    pub rotate: f32,
}

impl EnvironmentMap {
    fn turned(&self, d: Vec3, angle: f32) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        Vec3::new(cos * d.x + sin * d.z, d.y, cos * d.z - sin * d.x)
    }
}

impl Emitter for EnvironmentMap {
    fn sample(&self, _from: Vec3, u: Vec2) -> Option<LightSample> {
        let (direction, density) = self.panorama.sample(u);
        (density > 0.0).then(|| LightSample {
            direction: self.turned(direction, self.rotate),
            distance: f32::INFINITY,
            density,
        })
    }

    fn density(&self, _from: Vec3, direction: Vec3, _distance: f32) -> f32 {
        let (x, y) = self.panorama.texel_at(self.turned(direction, -self.rotate));
        self.panorama.density(x, y)
    }

    fn radiance<const N: usize, C: Components<N>>(&self, direction: Vec3, components: &C) -> Sampled<N> {
        let (x, y) = self.panorama.texel_at(self.turned(direction, -self.rotate));
        let texel = self.panorama.texels[y * self.panorama.width + x];
        components.upsample_radiance(Vec3::from(texel) * self.scale)
    }
}

fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// cos θ at the upper edge of row `y`.
fn cos_edge(y: usize, height: usize) -> f32 {
    (PI * y as f32 / height as f32).cos()
}

/// Difference of cos θ across row `y`: its solid angle divided by 2π.
fn band(y: usize, height: usize) -> f32 {
    cos_edge(y, height) - cos_edge(y + 1, height)
}

/// The step of a cumulative table that holds `u`, and where in it.
fn invert(cumulative: &[f32], u: f32) -> (usize, f32) {
    let i = cumulative.partition_point(|c| *c <= u).saturating_sub(1).min(cumulative.len() - 2);
    let width = cumulative[i + 1] - cumulative[i];
    (i, if width > 0.0 { ((u - cumulative[i]) / width).min(1.0) } else { 0.5 })
}
