//! Reference values for the scenes of the covering array: transmittance and single scattering by quadrature,
//! and a furnace.

use glam::DVec3;
use majorant_core::spectrum::{Components, Sampled, Wavelengths};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Number of values per axis of every grid.
pub const SIZE: usize = 5;
/// Quantization step of the grids. The largest value of every channel is 255 steps, so that every precision
/// stores the values exactly.
const STEP: f32 = 1.0 / 128.0;

/// Size of the medium: long along the view direction, so that most paths scatter, and thin to the sides, so
/// that most paths leave it again.
pub const EXTENT: [f64; 3] = [0.5, 0.5, 1.5];

/// Centre of the spherical lamp.
pub const LAMP: [f64; 3] = [0.9, 1.1, 0.2];
pub const LAMP_RADIUS: f64 = 0.4;
pub const LAMP_RADIANCE: f64 = 3.0;
pub const SKY_RADIANCE: f64 = 0.6;
pub const ASYMMETRY: f64 = 0.2;

/// Relative error bound of the quadrature.
pub const QUADRATURE: f64 = 4e-4;

/// Pseudo-random grid values from 1/4 to 255/128, so that the control is non-zero in every cell.
pub fn rough_values(channels: usize) -> Vec<f32> {
    let count = SIZE.pow(3) * channels;
    let mut values: Vec<f32> = (0..count)
        .map(|i| {
            let x =
                ((i + 1) as f64 * 0.381_966_011_250_105).fract() * ((i + 1) as f64 * 0.754_877_666).fract();
            (32.0 + x.sqrt() * 223.0).round() as f32 * STEP
        })
        .collect();
    for value in values.iter_mut().take(channels) {
        *value = 255.0 * STEP;
    }
    values
}

/// Quadrature sample of single scattering: its weight, and the density and optical depth per channel of the
/// grid.
struct Sample {
    weight: f64,
    density: [f64; 3],
    depth: [f64; 3],
}

/// Quadrature of a density field over its box.
pub struct Field {
    single: Vec<Sample>,
    /// Optical depth through the box along the axis.
    through: [f64; 3],
}

fn integrate(cells: u32, mut f: impl FnMut(f64)) {
    let off = 0.5 / 3f64.sqrt();
    for i in 0..cells {
        for side in [-off, off] {
            f((f64::from(i) + 0.5 + side) / f64::from(cells));
        }
    }
}

/// Directions within a spherical cap, with their solid angles.
fn cap(axis: DVec3, height: f64, cells: u32) -> Vec<(DVec3, f64)> {
    let (u, v) = axis.any_orthonormal_pair();
    let mut directions = Vec::new();
    let weight = 2.0 * PI * height / f64::from(2 * cells) / f64::from(4 * cells);
    integrate(cells, |a| {
        let cos = 1.0 - height * a;
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        integrate(2 * cells, |b| {
            let (s, c) = (2.0 * PI * b).sin_cos();
            directions.push((axis * cos + (u * c + v * s) * sin, weight));
        });
    });
    directions
}

fn to_face(point: DVec3, direction: DVec3) -> f64 {
    (0..3)
        .map(|axis| {
            let d = direction[axis];
            if d == 0.0 { f64::INFINITY } else { (0.5 * EXTENT[axis] * d.signum() - point[axis]) / d }
        })
        .fold(f64::INFINITY, f64::min)
        .max(0.0)
}

fn phase(cosine: f64) -> f64 {
    let g = ASYMMETRY;
    (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cosine).powf(1.5))
}

impl Field {
    /// Computes the quadrature samples; `raster` scales the resolution and is 1 for the reference values.
    pub fn new(raster: f64, density: impl Fn(DVec3) -> [f64; 3] + Sync) -> Self {
        let column = |from: DVec3, direction: DVec3, length: f64, cells: u32| {
            let mut sum = [0.0; 3];
            integrate(cells, |t| {
                let here = density(from + direction * (length * t));
                for (s, d) in sum.iter_mut().zip(here) {
                    *s += d * length / f64::from(2 * cells);
                }
            });
            sum
        };
        let fine = |cells: f64| (raster * cells).round() as u32;
        let length = EXTENT[2];
        let face = DVec3::new(0.0, 0.0, 0.5 * length);
        let along = fine(40.0);
        let sky = cap(DVec3::Y, 2.0, fine(16.0));
        let mut places = Vec::new();
        integrate(along, |s| places.push(s * length));
        let from = |s: f64| {
            let point = face - DVec3::Z * s;
            let here = density(point);
            let before = column(face, -DVec3::Z, s, fine(24.0));
            let to_lamp = DVec3::from(LAMP) - point;
            let height = 1.0 - (1.0 - (LAMP_RADIUS / to_lamp.length()).powi(2)).sqrt();
            let lamp = cap(to_lamp.normalize(), height, fine(5.0));
            // The lamp occludes the sky behind it.
            let lights = [(&sky, SKY_RADIANCE), (&lamp, LAMP_RADIANCE - SKY_RADIANCE)];
            let mut samples = Vec::new();
            for (directions, radiance) in lights {
                for (omega, solid) in directions {
                    let after = column(point, *omega, to_face(point, *omega), fine(12.0));
                    samples.push(Sample {
                        weight: radiance * solid * phase(-omega.z) * length / f64::from(2 * along),
                        density: here,
                        depth: std::array::from_fn(|c| before[c] + after[c]),
                    });
                }
            }
            samples
        };
        let single = places.par_iter().flat_map_iter(|s| from(*s)).collect();
        Self { single, through: column(face, -DVec3::Z, length, 200) }
    }

    /// Single scattering for albedo 1 and an extinction equal to the densities weighted by `sigma`.
    pub fn single(&self, sigma: [f64; 3]) -> f64 {
        let dot = |a: &[f64; 3]| a[0] * sigma[0] + a[1] * sigma[1] + a[2] * sigma[2];
        self.single.iter().map(|s| s.weight * dot(&s.density) * (-dot(&s.depth)).exp()).sum()
    }

    /// Transmittance of the box along the axis.
    pub fn transmittance(&self, sigma: [f64; 3]) -> f64 {
        let t = self.through;
        (-(t[0] * sigma[0] + t[1] * sigma[1] + t[2] * sigma[2])).exp()
    }
}

/// Density 1 everywhere.
pub static CONSTANT: LazyLock<Field> = LazyLock::new(|| constant(1.0));
/// Single-channel grid of [`rough_values`].
pub static ROUGH: LazyLock<Field> = LazyLock::new(|| rough(1.0));
/// Three-channel grid of [`rough_values`].
pub static COLOURS: LazyLock<Field> = LazyLock::new(|| colours(1.0));

pub fn constant(raster: f64) -> Field {
    Field::new(raster, |_| [1.0, 0.0, 0.0])
}

pub fn rough(raster: f64) -> Field {
    let values = rough_values(1);
    Field::new(raster, |p| [trilinear(&values, 1, p)[0], 0.0, 0.0])
}

pub fn colours(raster: f64) -> Field {
    let values = rough_values(3);
    Field::new(raster, |p| trilinear(&values, 3, p))
}

/// Trilinear interpolation of values at cell centres over the box about the origin, clamped at the outermost
/// centres.
fn trilinear(values: &[f32], channels: usize, p: DVec3) -> [f64; 3] {
    let n = SIZE as f64;
    let index = (p / DVec3::from(EXTENT) + 0.5) * n - 0.5;
    let floor = index.floor();
    let f = index - floor;
    let mut sum = [0.0; 3];
    for corner in 0..8usize {
        let mut weight = 1.0;
        let mut at = [0usize; 3];
        for axis in 0..3 {
            let up = corner >> axis & 1;
            weight *= if up == 1 { f[axis] } else { 1.0 - f[axis] };
            at[axis] = (floor[axis] as i64 + up as i64).clamp(0, SIZE as i64 - 1) as usize;
        }
        let place = (at[0] + SIZE * (at[1] + SIZE * at[2])) * channels;
        for c in 0..channels {
            sum[c] += weight * f64::from(values[place + c]);
        }
    }
    sum
}

/// Film response to a spectral radiance, in linear sRGB.
pub fn film(radiance: impl Fn(f32) -> f64 + Sync) -> [f64; 3] {
    let step = 2.5f32;
    let values: Vec<[f64; 3]> = (0..=188u8)
        .into_par_iter()
        .map(|i| {
            let lambda = 360.0 + step * f32::from(i);
            let at = Wavelengths::<1> { lambda_nm: [lambda], density_per_nm: [1.0] };
            let end = if i == 0 || i == 188 { 0.5 } else { 1.0 };
            let value = radiance(lambda) * f64::from(step) * end;
            at.to_film(Sampled::ONE).to_array().map(|response| f64::from(response) * value)
        })
        .collect();
    std::array::from_fn(|c| values.iter().map(|value| value[c]).sum())
}

/// Upsampled spectra of unit red, green and blue at a wavelength in nanometres.
pub fn basis(lambda: f32) -> [f64; 3] {
    let at = Wavelengths::<1> { lambda_nm: [lambda], density_per_nm: [1.0] };
    glam::Vec3::AXES.map(|axis| f64::from(at.upsample(axis).hero()))
}

/// Value of a piecewise linear spectrum at a wavelength, constant beyond the outermost points.
pub fn by_points(points: &[(f64, f64)], lambda: f64) -> f64 {
    let after = points.partition_point(|p| p.0 <= lambda);
    match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (lambda - a.0) / (b.0 - a.0),
        (Some(end), None) => end.1,
        (None, Some(end)) => end.1,
        (None, None) => 0.0,
    }
}

/// Planck's law at 3000 K, normalized to 1 at 560 nm.
pub fn blackbody(lambda_nm: f64) -> f64 {
    // hc/(kT) in nanometres.
    let c: f64 = 1.438_776_877e7 / 3000.0;
    (560.0_f64 / lambda_nm).powi(5) * (c / 560.0).exp_m1() / (c / lambda_nm).exp_m1()
}
