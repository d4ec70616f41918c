//! Sensor model: the CIE 1931 2° observer, and linear sRGB (IEC 61966-2-1) derived from it.
//!
//! Normalised so that constant radiance 1 gives X = Y = Z = 1, as illuminant E does by definition (the
//! integrals of the tabulated curves differ by 0.03 %). Its linear sRGB is (1.2050, 0.9483, 0.9086). Tables
//! are sampled every 5 nm and linear between; sources are listed in `assets/spectra/README.md`.

use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM};
use glam::{Mat3, Vec3};
use std::sync::LazyLock;

const STEP_NM: f32 = 5.0;
const ROWS: usize = 95;

/// Three curves over 360–830 nm, sampled every 5 nm and linear between; zero outside.
struct Table([Vec3; ROWS]);

impl Table {
    /// Parses `lambda_nm,a[,b,c]` lines. The files are embedded in the program and covered by a test.
    fn parse(csv: &str) -> Self {
        let mut rows = [Vec3::ZERO; ROWS];
        let lines = csv.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
        for (row, line) in rows.iter_mut().zip(lines) {
            let mut fields = line.split(',').skip(1).map(|f| f.trim().parse().unwrap_or(f32::NAN));
            let first = fields.next().unwrap_or(f32::NAN);
            *row = Vec3::new(first, fields.next().unwrap_or(first), fields.next().unwrap_or(first));
        }
        Self(rows)
    }

    fn map(&self, f: impl Fn(Vec3) -> Vec3) -> Self {
        Self(self.0.map(f))
    }

    fn at(&self, lambda_nm: f32) -> Vec3 {
        let x = (lambda_nm - LAMBDA_MIN_NM) / STEP_NM;
        if !(0.0..=(ROWS - 1) as f32).contains(&x) {
            return Vec3::ZERO;
        }
        let i = (x as usize).min(ROWS - 2);
        self.0[i].lerp(self.0[i + 1], x - i as f32)
    }

    /// ∫ dλ by the trapezoid rule, exact for curves that are linear between the rows.
    fn integral(&self) -> Vec3 {
        let ends = 0.5 * (self.0[0] + self.0[ROWS - 1]);
        (self.0.iter().sum::<Vec3>() - ends) * STEP_NM
    }
}

static OBSERVER: LazyLock<Table> = LazyLock::new(|| {
    let table = Table::parse(include_str!("../../../assets/spectra/cie1931_2deg_5nm.csv"));
    let integral = table.integral();
    table.map(|xyz| xyz / integral)
});

static RESPONSE: LazyLock<Table> = LazyLock::new(|| OBSERVER.map(|xyz| SRGB_FROM_XYZ * xyz));

static BASIS: LazyLock<Table> =
    LazyLock::new(|| Table::parse(include_str!("../../../assets/spectra/srgb_basis_5nm.csv")));

static ILLUMINANT: LazyLock<Table> = LazyLock::new(|| {
    let table = Table::parse(include_str!("../../../assets/spectra/d65_5nm.csv"));
    let mut product = Table(table.0);
    for (row, xyz) in product.0.iter_mut().zip(&OBSERVER.0) {
        *row *= xyz.y;
    }
    let y = product.integral().y;
    table.map(|power| power / y)
});

/// Linear sRGB from XYZ, by columns, computed from the chromaticities of IEC 61966-2-1 with the white point
/// D65. Published matrices round the white point, with errors of up to 3·10⁻⁴ in blue.
const SRGB_FROM_XYZ: Mat3 = Mat3::from_cols(
    Vec3::new(3.240_97, -0.969_243_6, 0.055_630_08),
    Vec3::new(-1.537_383_2, 1.875_967_5, -0.203_976_96),
    Vec3::new(-0.498_610_76, 0.041_555_06, 1.056_971_5),
);

/// Contribution of radiance 1 per nanometre at one wavelength to the film, in linear sRGB per nm.
#[must_use]
pub fn response(lambda_nm: f32) -> Vec3 {
    RESPONSE.at(lambda_nm)
}

/// The three basis spectra at a wavelength: each in 0..1, with sum 1. Under daylight (D65) each has the
/// colour of one sRGB primary, to 0.3 %. After Mallett and Yuksel 2019.
pub(super) fn basis(lambda_nm: f32) -> Vec3 {
    BASIS.at(lambda_nm)
}

/// Daylight (CIE D65), scaled to Y = 1: its linear sRGB is (1, 1, 1).
pub(super) fn daylight(lambda_nm: f32) -> f32 {
    ILLUMINANT.at(lambda_nm).x
}

/// Displayable colour (linear sRGB, 0 to 1) of a wavelength, for labelling axes.
#[must_use]
pub fn wavelength_colour(lambda_nm: f32) -> [f32; 3] {
    // Monochromatic light lies outside sRGB: move it into the gamut, then scale it by the observer's curve.
    let rgb = response(lambda_nm);
    let lifted = rgb - Vec3::splat(rgb.min_element().min(0.0));
    let visible = (OBSERVER.at(lambda_nm).element_sum() * 55.0).clamp(0.0, 1.0);
    (lifted / lifted.max_element().max(1e-9) * visible).to_array()
}

/// ∫ response(λ) f(λ) dλ, for an `f` that is a polynomial of degree at most 4 between the rows of the
/// sensor's table and the wavelengths `cuts`: exact up to rounding. `f` is not evaluated at the cuts
/// themselves.
pub(super) fn film_colour(f: impl Fn(f32) -> f32, cuts: impl Iterator<Item = f32>) -> Vec3 {
    let rows = (0..ROWS).map(|i| LAMBDA_MIN_NM + STEP_NM * i as f32);
    let inside = cuts.filter(|l| (LAMBDA_MIN_NM..LAMBDA_MAX_NM).contains(l));
    let mut nodes: Vec<f32> = rows.chain(inside).collect();
    nodes.sort_by(f32::total_cmp);
    // Three-point Gauss–Legendre rule.
    let offset = 0.6f32.sqrt();
    let rule = [(-offset, 5.0 / 18.0), (0.0, 8.0 / 18.0), (offset, 5.0 / 18.0)];
    let mut sum = Vec3::ZERO;
    for pair in nodes.windows(2) {
        let (middle, width) = (0.5 * (pair[0] + pair[1]), pair[1] - pair[0]);
        for (x, weight) in rule {
            let lambda = middle + 0.5 * width * x;
            sum += response(lambda) * (f(lambda) * weight * width);
        }
    }
    sum
}

static FILM_FROM_RGB: LazyLock<Mat3> = LazyLock::new(|| {
    let column = |i: usize| film_colour(|l| basis(l)[i] * daylight(l), std::iter::empty());
    Mat3::from_cols(column(0), column(1), column(2))
});

/// Film colour of a radiance given as linear sRGB, integrated over all wavelengths: equal to the input to 0.3
/// %.
pub(super) fn film_colour_of_rgb(rgb: Vec3) -> Vec3 {
    *FILM_FROM_RGB * rgb
}

/// Means of a spectrum under the positive part of each channel's response: the components of RGB mode.
pub(super) fn band_means(f: impl Fn(f32) -> f32) -> Vec3 {
    let weight = |lambda| response(lambda).max(Vec3::ZERO);
    integrate(|l| weight(l) * f(l)) / integrate(weight)
}

/// ∫ f(λ) dλ over the rendered range by the midpoint rule at 1 nm.
pub(super) fn integrate(f: impl Fn(f32) -> Vec3) -> Vec3 {
    let mut sum = Vec3::ZERO;
    let mut lambda = LAMBDA_MIN_NM + 0.5;
    while lambda < LAMBDA_MAX_NM {
        sum += f(lambda);
        lambda += 1.0;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Vec3, b: [f32; 3], tolerance: f32) {
        assert!((a - Vec3::from(b)).abs().max_element() < tolerance, "{a} is not {b:?}");
    }

    #[test]
    fn constant_radiance_shows_as_illuminant_e() {
        close(integrate(response), [1.204_976, 0.948_279, 0.908_625], 2e-5);
    }

    #[test]
    fn daylight_is_white_and_the_basis_gives_the_primaries() {
        close(integrate(|l| response(l) * daylight(l)), [1.0; 3], 3e-3);
        for (axis, primary) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
            close(integrate(|l| response(l) * daylight(l) * basis(l)[axis]), primary, 3e-3);
        }
    }

    #[test]
    fn the_basis_is_a_partition_of_unity() {
        for i in 0..=470u16 {
            let b = basis(360.0 + f32::from(i));
            assert!((b.element_sum() - 1.0).abs() < 1e-5 && b.min_element() >= 0.0, "{b}");
        }
    }
}
