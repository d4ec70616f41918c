//! Spectra computed from two others, wavelength by wavelength.

use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum};

/// Function of two values at one wavelength. On an interval where both arguments are linear in wavelength,
/// its maximum has to be at an end of the interval: a sum, a ratio, a reciprocal, a monotone function of one
/// of them.
pub type Rule = fn(f32, f32) -> f32;

/// A rule applied to two spectra, times a factor.
#[derive(Clone, Debug)]
pub(super) struct Combined {
    pub a: Spectrum,
    pub b: Spectrum,
    pub rule: Rule,
    pub factor: f32,
}

impl Combined {
    /// Value at a wavelength in nanometres.
    pub fn at(&self, lambda_nm: f32) -> f32 {
        self.factor * (self.rule)(self.a.at(lambda_nm), self.b.at(lambda_nm))
    }

    /// Wavelengths between which both spectra are linear, besides the rows of the sensor's table.
    pub fn knots(&self) -> Vec<f32> {
        let mut knots = self.a.knots();
        knots.extend(self.b.knots());
        knots
    }

    /// Maximum over the rendered wavelengths, found at a knot, on either side of it, or at a row of the
    /// table.
    pub fn largest(&self) -> f32 {
        let rows = (0..=94u8).map(|i| LAMBDA_MIN_NM + 5.0 * f32::from(i));
        let knots = self.knots().into_iter().flat_map(|l| [l.next_down(), l, l.next_up()]);
        let inside = knots.filter(|l| (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(l));
        rows.chain(inside).map(|lambda| self.at(lambda)).fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Quantity, SpectrumDoc};

    fn points(text: &str) -> Spectrum {
        let points = SpectrumDoc::parse_points(text).unwrap();
        Spectrum::new(&SpectrumDoc::Points { points, outside: Default::default() }, Quantity::Coefficient)
    }

    fn rgb(rgb: [f32; 3]) -> Spectrum {
        Spectrum::new(&SpectrumDoc::Rgb(rgb), Quantity::Coefficient)
    }

    #[test]
    fn values_follow_the_rule_and_nothing_exceeds_the_largest() {
        let sum: Rule = |a, b| a + b;
        let inverse: Rule = |a, _| 1.0 / a;
        for (a, b, rule) in [
            (points("400:1, 500:8, 613.3:2"), points("433.3:5, 610:0.1, 700:9"), sum),
            (rgb([1.0, 4.0, 0.3]), points("480:0, 486:7, 492:0"), sum),
            (points("400:1, 500:8, 613.3:0.2"), Spectrum::constant(0.0), inverse),
            (rgb([0.1, 4.0, 0.3]), Spectrum::constant(0.0), inverse),
        ] {
            let both = Spectrum::combined(a.clone(), b.clone(), rule).scaled(3.0);
            let mut seen = 0.0f32;
            for i in 0..=47_000u16 {
                let lambda = 360.0 + 0.01 * f32::from(i);
                assert_eq!(both.at(lambda), 3.0 * rule(a.at(lambda), b.at(lambda)));
                seen = seen.max(both.at(lambda));
            }
            let largest = both.max_over_wavelengths();
            assert!(seen <= largest * (1.0 + 1e-5) && seen > 0.99 * largest, "{seen} {largest}");
            for c in 0..3 {
                assert_eq!(both.rgb()[c], 3.0 * rule(a.rgb()[c], b.rgb()[c]));
            }
        }
        let flat = Spectrum::combined(Spectrum::constant(2.0), Spectrum::constant(3.0), sum);
        assert!(flat.is_flat() && flat.at(500.0) == 5.0);
    }
}
