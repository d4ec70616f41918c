//! Closed forms in double precision, written from their definitions. They share no code with the renderer, so
//! that they do not repeat its errors.

use glam::DVec3;
use std::f64::consts::PI;

/// Film value of a spectral radiance L(λ): ∫ L(λ) response(λ) dλ in linear sRGB. The response consists of the
/// CIE 1931 curves, each scaled to integral 1, and of the primaries of IEC 61966-2-1. Published matrices
/// round the white point differently, by up to 3·10⁻⁴ in blue.
pub(super) fn film(radiance: impl Fn(f64) -> f64) -> [f64; 3] {
    let xyz = colour_matching();
    let mut totals = [0.0; 3];
    let mut sums = [0.0; 3];
    let (step, count) = (0.5, 940);
    for i in 0..count {
        let lambda = 360.0 + step * (f64::from(i) + 0.5);
        let at = xyz.at(lambda);
        let l = radiance(lambda);
        for c in 0..3 {
            totals[c] += at[c];
            sums[c] += at[c] * l;
        }
    }
    rgb_from_xyz(std::array::from_fn(|c| sums[c] / totals[c]))
}

/// Colour of constant radiance 1.
pub(super) fn white() -> [f64; 3] {
    film(|_| 1.0)
}

struct Curves(Vec<[f64; 4]>);

impl Curves {
    fn at(&self, lambda: f64) -> [f64; 3] {
        let last = self.0.len().saturating_sub(2);
        let i = self.0.partition_point(|row| row[0] <= lambda).saturating_sub(1).min(last);
        let (a, b) = (&self.0[i], &self.0[i + 1]);
        let s = (lambda - a[0]) / (b[0] - a[0]);
        std::array::from_fn(|c| a[c + 1] + (b[c + 1] - a[c + 1]) * s)
    }
}

fn colour_matching() -> Curves {
    let text = include_str!("../../../assets/spectra/cie1931_2deg_5nm.csv");
    let rows = text.lines().filter_map(|line| {
        let mut numbers = line.split(',').map(|field| field.trim().parse::<f64>().ok());
        Some([numbers.next()??, numbers.next()??, numbers.next()??, numbers.next()??])
    });
    Curves(rows.collect())
}

/// Linear sRGB from XYZ, derived from the chromaticities of the primaries and of D65: RGB (1, 1, 1) is the
/// white point, and each primary has its chromaticity.
fn rgb_from_xyz(xyz: [f64; 3]) -> [f64; 3] {
    let of = |x: f64, y: f64| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let primaries = glam::DMat3::from_cols(of(0.64, 0.33), of(0.30, 0.60), of(0.15, 0.06));
    let white = primaries.inverse() * of(0.3127, 0.3290);
    let xyz_from_rgb = primaries * glam::DMat3::from_diagonal(white);
    (xyz_from_rgb.inverse() * DVec3::from(xyz)).to_array()
}

/// A spectrum given by points, linear between them and constant beyond the ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points(pub &'static [(f64, f64)]);

impl Points {
    pub fn at(&self, lambda: f64) -> f64 {
        let after = self.0.partition_point(|p| p.0 <= lambda);
        match (after.checked_sub(1).and_then(|i| self.0.get(i)), self.0.get(after)) {
            (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (lambda - a.0) / (b.0 - a.0),
            (Some(end), None) | (None, Some(end)) => end.1,
            (None, None) => 0.0,
        }
    }

    /// The points in the notation of a scene file.
    pub fn toml(&self) -> String {
        let points: Vec<_> = self.0.iter().map(|(l, v)| format!("{l}:{v}")).collect();
        format!("\"{}\"", points.join(", "))
    }
}

/// Henyey–Greenstein phase function of the cosine between the directions of propagation, per steradian.
pub(super) fn henyey_greenstein(g: f64, cosine: f64) -> f64 {
    (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cosine).powf(1.5))
}

/// Draine phase function, per steradian.
pub(super) fn draine(g: f64, alpha: f64, cosine: f64) -> f64 {
    let moment = (1.0 + 2.0 * g * g) / 3.0;
    henyey_greenstein(g, cosine) * (1.0 + alpha * cosine * cosine) / (1.0 + alpha * moment)
}

/// Jendersie and d'Eon's phase function for droplets of 5 to 50 µm, per steradian.
pub(super) fn droplets(d: f64, cosine: f64) -> f64 {
    let g_hg = (-0.0990567 / (d - 1.67154)).exp();
    let g_d = (-2.20679 / (d + 3.91029) - 0.428934).exp();
    let alpha = (3.62489 - 8.29288 / (d + 5.52825)).exp();
    let w = (-0.599085 / (d - 0.641583) - 0.665888).exp();
    (1.0 - w) * henyey_greenstein(g_hg, cosine) + w * draine(g_d, alpha, cosine)
}

/// Rayleigh phase function, per steradian.
pub(super) fn rayleigh(cosine: f64) -> f64 {
    3.0 / (16.0 * PI) * (1.0 + cosine * cosine)
}

/// Interval of t in which a line is inside an axis-aligned box of half size `half` about `center`.
pub(super) fn box_interval(
    origin: DVec3,
    direction: DVec3,
    center: DVec3,
    half: DVec3,
) -> Option<(f64, f64)> {
    let (mut t0, mut t1) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (o, d, h) = (origin[axis] - center[axis], direction[axis], half[axis]);
        if d == 0.0 {
            if o.abs() > h {
                return None;
            }
            continue;
        }
        let (a, b) = ((-h - o) / d, (h - o) / d);
        t0 = t0.max(a.min(b));
        t1 = t1.min(a.max(b));
    }
    (t0 < t1).then_some((t0, t1))
}

/// ∫ f over the unit interval by Gauss's two-point rule in each of `cells` equal parts. The error is of
/// fourth order where f is smooth; kinks are harmless.
pub(super) fn integrate(cells: u32, mut f: impl FnMut(f64) -> f64) -> f64 {
    let width = 1.0 / f64::from(cells);
    let off = 0.5 / 3f64.sqrt();
    let sum: f64 = (0..cells)
        .map(|i| {
            let middle = f64::from(i) + 0.5;
            f((middle - off) * width) + f((middle + off) * width)
        })
        .sum();
    0.5 * width * sum
}

/// ∫ f(ω) dω over the directions within `half_angle` of the unit vector `axis`.
pub(super) fn over_cap(axis: DVec3, half_angle: f64, cells: u32, mut f: impl FnMut(DVec3) -> f64) -> f64 {
    let (u, v) = axis.any_orthonormal_pair();
    let height = 1.0 - half_angle.cos();
    2.0 * PI
        * height
        * integrate(cells, |a| {
            let cos = 1.0 - height * a;
            let sin = (1.0 - cos * cos).max(0.0).sqrt();
            integrate(2 * cells, |b| {
                let (s, c) = (2.0 * PI * b).sin_cos();
                f(axis * cos + (u * c + v * s) * sin)
            })
        })
}

/// A grid of values with trilinear interpolation, implemented index by index from the definition.
#[derive(Clone, Debug)]
pub(super) struct Lattice3 {
    /// Values per axis.
    pub size: [usize; 3],
    /// Values, x fastest.
    pub values: Vec<f32>,
}

impl Lattice3 {
    /// Value at continuous index coordinates; `beyond` maps the indices beyond the ends.
    pub fn at(&self, index: DVec3, beyond: impl Fn(i64, i64) -> Option<i64>) -> f64 {
        let floor = index.floor();
        let f = index - floor;
        let mut sum = 0.0;
        for corner in 0..8u8 {
            let mut weight = 1.0;
            let mut place = Some(0i64);
            let mut stride = 1i64;
            for axis in 0..3 {
                let up = corner >> axis & 1 == 1;
                weight *= if up { f[axis] } else { 1.0 - f[axis] };
                let n = self.size[axis] as i64;
                let i = beyond(floor[axis] as i64 + i64::from(up), n);
                place = place.zip(i).map(|(p, i)| p + stride * i);
                stride *= n;
            }
            let value = place.and_then(|p| self.values.get(p as usize)).copied().unwrap_or(0.0);
            sum += weight * f64::from(value);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phase_functions_integrate_to_one() {
        let total = |p: &dyn Fn(f64) -> f64| 4.0 * PI * integrate(20_000, |u| p(2.0 * u - 1.0));
        assert!((total(&|c| henyey_greenstein(0.9, c)) - 1.0).abs() < 1e-4);
        assert!((total(&|c| henyey_greenstein(-0.5, c)) - 1.0).abs() < 1e-6);
        assert!((total(&rayleigh) - 1.0).abs() < 1e-6);
        assert!((total(&|c| draine(0.6, 20.0, c)) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn illuminant_e_has_its_published_colour() {
        let e = white();
        for (c, published) in e.iter().zip([1.2048, 0.9483, 0.9089]) {
            assert!((c - published).abs() < 5e-4, "{e:?}");
        }
    }

    #[test]
    fn a_cap_has_its_solid_angle() {
        let solid = over_cap(DVec3::Y, 0.3, 8, |_| 1.0);
        assert!((solid - 2.0 * PI * (1.0 - 0.3f64.cos())).abs() < 1e-9);
    }
}
