//! Mapping from values to colours, and its inverse for legends.
//!
//! The colour maps are perceptually uniform and suitable for colour-vision deficiencies: Viridis for
//! magnitudes, red to blue around white for differences (red: too bright).

use colorous::Gradient;

/// Mapping from values to colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Linear from 0.
    Linear,
    /// Logarithmic.
    Logarithmic,
    /// Symmetric around 0.
    Diverging,
    /// Around 0, from −`.0` to `.0`, independent of the values.
    Fixed(f32),
}

/// Range of values that the colour map covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lowest value.
    pub lo: f32,
    /// Highest value.
    pub hi: f32,
    /// Mapping of values in between.
    pub scale: Scale,
}

/// Fraction of the values inside the range; the others are clamped.
const INSIDE: f64 = 0.98;
/// Maximum number of decades of a logarithmic range.
const DECADES: i32 = 4;

impl Range {
    /// Common range of several views, so that their colours are comparable.
    #[must_use]
    pub fn of<'a>(scale: Scale, values: impl Iterator<Item = &'a [f32]>) -> Self {
        if let Scale::Fixed(end) = scale {
            return Self { lo: -end, hi: end, scale };
        }
        let mut sizes: Vec<f32> =
            values.flatten().map(|v| v.abs()).filter(|v| v.is_finite() && *v > 0.0).collect();
        if sizes.is_empty() {
            return Self { lo: 0.0, hi: 1.0, scale: Scale::Linear };
        }
        let at = (((sizes.len() - 1) as f64) * INSIDE) as usize;
        let (_, hi, _) = sizes.select_nth_unstable_by(at, f32::total_cmp);
        let hi = *hi;
        match scale {
            Scale::Logarithmic => Self { lo: hi / 10f32.powi(DECADES), hi, scale },
            Scale::Diverging => Self { lo: -hi, hi, scale },
            _ => Self { lo: 0.0, hi, scale },
        }
    }

    /// Position of a value in the range, from 0 to 1; `None` for NaN.
    #[must_use]
    pub fn position(&self, value: f32) -> Option<f32> {
        let share = match self.scale {
            Scale::Logarithmic if value <= 0.0 => 0.0,
            Scale::Logarithmic => (value / self.lo).ln() / (self.hi / self.lo).ln(),
            _ => (value - self.lo) / (self.hi - self.lo),
        };
        (!share.is_nan()).then(|| share.clamp(0.0, 1.0))
    }

    /// Value at a position from 0 to 1.
    #[must_use]
    pub fn value(&self, position: f32) -> f32 {
        match self.scale {
            Scale::Logarithmic => self.lo * (self.hi / self.lo).powf(position),
            _ => self.lo + (self.hi - self.lo) * position,
        }
    }

    /// Colour at a position from 0 to 1.
    #[must_use]
    pub fn colour(&self, position: f32) -> [u8; 3] {
        let position = f64::from(position);
        let (gradient, at): (Gradient, f64) = match self.scale {
            // Red above, blue below.
            Scale::Diverging | Scale::Fixed(_) => (colorous::RED_BLUE, 1.0 - position),
            Scale::Linear | Scale::Logarithmic => (colorous::VIRIDIS, position),
        };
        let colour = gradient.eval_continuous(at);
        [colour.r, colour.g, colour.b]
    }

    /// Colour of a value; NaN is magenta, which is in neither colour map.
    #[must_use]
    pub fn paint(&self, value: f32) -> [u8; 3] {
        self.position(value).map_or([255, 0, 255], |position| self.colour(position))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_most_values_and_colours_run_through_them() {
        let values: Vec<f32> = (1..=1000).map(|i| i as f32).chain([1e9, f32::NAN]).collect();
        let range = Range::of(Scale::Linear, [values.as_slice()].into_iter());
        assert!((970.0..=1000.0).contains(&range.hi) && range.lo == 0.0, "{range:?}");
        let range = Range::of(Scale::Logarithmic, [values.as_slice()].into_iter());
        for position in [0.0, 0.3, 1.0] {
            assert!((range.position(range.value(position)).unwrap() - position).abs() < 1e-5);
        }
        let range = Range::of(Scale::Fixed(4.0), std::iter::empty());
        assert_eq!(range.position(0.0), Some(0.5));
        let (red, blue) = (range.paint(4.0), range.paint(-4.0));
        assert!(red[0] > red[2] && blue[2] > blue[0]);
        assert_eq!(range.paint(f32::NAN), [255, 0, 255]);
        // No values.
        assert_eq!(
            Range::of(Scale::Diverging, std::iter::empty()).paint(0.0),
            Range::of(Scale::Linear, std::iter::empty()).paint(0.0)
        );
    }
}
