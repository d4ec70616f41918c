//! Colour spaces of FLIP, and the colour difference in them.

/// White point D65: X, Y and Z at Y = 1.
const WHITE: [f32; 3] = [0.950_428_55, 1.0, 1.088_900_4];
/// Reciprocal of [`WHITE`].
const INVERSE_WHITE: [f32; 3] = [1.052_156_9, 1.0, 0.918_357_7];

/// Matrix from linear sRGB to XYZ, whose rows sum to [`WHITE`].
const XYZ_FROM_RGB: [[f32; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];
/// Inverse of [`XYZ_FROM_RGB`].
const RGB_FROM_XYZ: [[f32; 3]; 3] = [
    [3.241_003_3, -1.537_398_9, -0.498_615_86],
    [-0.969_224_33, 1.875_930_1, 0.041_554_224],
    [0.055_639_423, -0.204_011_2, 1.057_149],
];

/// Exponent of the colour difference, q_c of Andersson et al. (2020), section 4.1.3.
const POWER: f32 = 0.7;
/// Fraction p_c of the largest colour difference that is mapped to the fraction p_t of the range.
const KNEE: [f32; 2] = [0.4, 0.95];

/// Like `array::map`, which the compiler does not unroll here.
#[inline]
pub(super) fn each([x, y, z]: [f32; 3], f: impl Fn(f32) -> f32) -> [f32; 3] {
    [f(x), f(y), f(z)]
}

#[inline]
fn times(matrix: &[[f32; 3]; 3], v: [f32; 3]) -> [f32; 3] {
    let dot = |row: &[f32; 3]| row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
    [dot(&matrix[0]), dot(&matrix[1]), dot(&matrix[2])]
}

/// Clamps a colour to the display's range.
#[inline]
pub(super) fn clamped(rgb: [f32; 3]) -> [f32; 3] {
    each(rgb, |x| x.clamp(0.0, 1.0))
}

/// Numerator and denominator of Narkowicz's fit of the ACES curve (2015) with his exposure of 0.6,
/// coefficients from the square down.
pub(super) const ACES: [[f32; 3]; 2] =
    [[0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0], [0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14]];

/// Tone curve of HDR-FLIP; exceeds 1 for bright values.
#[inline]
pub(super) fn aces(x: f32) -> f32 {
    let curve = |c: [f32; 3]| x * x * c[0] + x * c[1] + c[2];
    curve(ACES[0]) / curve(ACES[1])
}

/// Luminance of linear sRGB.
pub(super) fn luminance(rgb: [f32; 3]) -> f32 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

/// Converts linear sRGB to the opponent space YCxCz, a linear space, so that blurring in it is blurring of
/// light.
#[inline]
pub(super) fn comparison(rgb: [f32; 3]) -> [f32; 3] {
    let xyz = times(&XYZ_FROM_RGB, rgb);
    let [x, y, z] = [xyz[0] * INVERSE_WHITE[0], xyz[1], xyz[2] * INVERSE_WHITE[2]];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Converts YCxCz to linear sRGB.
#[inline]
fn rgb_of_opponent([y, cx, cz]: [f32; 3]) -> [f32; 3] {
    let y = (y + 16.0) / 116.0;
    times(&RGB_FROM_XYZ, [(y + cx / 500.0) * WHITE[0], y, (y - cz / 200.0) * WHITE[2]])
}

/// Converts linear sRGB to CIELAB (CIE 15:2004).
#[inline]
fn lab(rgb: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let xyz = times(&XYZ_FROM_RGB, rgb);
    let [x, y, z] = each([xyz[0] * INVERSE_WHITE[0], xyz[1], xyz[2] * INVERSE_WHITE[2]], |t| {
        if t > DELTA * DELTA * DELTA { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// CIELAB with the Hunt effect: chroma is perceived in proportion to lightness.
#[inline]
fn hunt([l, a, b]: [f32; 3]) -> [f32; 3] {
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// City-block distance in lightness plus Euclidean distance in chroma (Abasi, Tehran and Fairchild 2020).
#[inline]
fn hyab(p: [f32; 3], q: [f32; 3]) -> f32 {
    let (da, db) = (p[1] - q[1], p[2] - q[2]);
    (p[0] - q[0]).abs() + (da * da + db * db).sqrt()
}

/// Colour difference with its scale.
#[derive(Clone, Copy)]
pub(super) struct ColourDifference {
    /// Difference of green and blue, the largest on a display.
    largest: f32,
    knee: f32,
}

impl ColourDifference {
    pub(super) fn new() -> Self {
        let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|rgb| hunt(lab(rgb)));
        let largest = hyab(green, blue).powf(POWER);
        Self { largest, knee: KNEE[0] * largest }
    }

    /// ΔE_c of two blurred colours in YCxCz, from 0 to 1 (Andersson et al. 2020, section 4.1.3).
    #[inline]
    pub(super) fn of(self, p: [f32; 3], q: [f32; 3]) -> f32 {
        // Common case: many pixels are as black as the reference.
        if p == q {
            return 0.0;
        }
        let seen = |ycc| hunt(lab(clamped(rgb_of_opponent(ycc))));
        let difference = hyab(seen(p), seen(q)).powf(POWER);
        if difference < self.knee {
            difference * (KNEE[1] / self.knee)
        } else {
            KNEE[1] + (difference - self.knee) / (self.largest - self.knee) * (1.0 - KNEE[1])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opponent_space_goes_there_and_back() {
        for rgb in [[0.0; 3], [1.0; 3], [0.2, 0.5, 0.9]] {
            for (x, y) in rgb.iter().zip(rgb_of_opponent(comparison(rgb))) {
                assert!((x - y).abs() < 1e-5, "{rgb:?}");
            }
        }
        let [l, a, b] = lab([1.0; 3]);
        assert!((l - 100.0).abs() < 1e-3 && a.abs() < 1e-2 && b.abs() < 1e-2, "white is {l}, {a}, {b}");
    }

    #[test]
    fn differences_run_from_zero_to_one() {
        let scale = ColourDifference::new();
        let of = |p, q| scale.of(comparison(p), comparison(q));
        assert_eq!(of([0.3, 0.2, 0.1], [0.3, 0.2, 0.1]), 0.0);
        assert!((of([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]) - 1.0).abs() < 1e-5);
        assert!(of([0.5; 3], [0.51; 3]) < of([0.5; 3], [0.6; 3]));
    }
}
