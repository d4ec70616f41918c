//! What a measure found.

/// A measure's value, how well it is known, and what of it the reference is to blame for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The plain formula's value; NaN if no pixel was counted.
    pub value: f64,
    /// Standard error of the value, as far as the scatter over pixels tells: σ/√pixels, with the n − 1
    /// estimate of σ; infinite below two pixels. Pixels are taken as independent.
    pub error: f64,
    /// What the reference's own noise is expected to have added to the value.
    pub reference_share: f64,
    /// Pixels counted.
    pub pixels: u64,
    /// Pixels left out because something in them, or in their standard error, is not finite.
    pub excluded: u64,
}

impl Measured {
    /// The value without the reference's share, not below 0.
    #[must_use]
    pub fn corrected(&self) -> f64 {
        // `max` would turn a value that is not known into 0.
        if self.value.is_nan() { self.value } else { (self.value - self.reference_share).max(0.0) }
    }

    /// How far [`Self::corrected`] may be off: the scatter over pixels and, in full, what was taken off for the
    /// reference's noise. A reference that is about as noisy as the picture thus measures nothing, and shows it.
    #[must_use]
    pub fn uncertainty(&self) -> f64 {
        self.error.hypot(self.reference_share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn correction_stops_at_zero_and_keeps_what_is_unknown() {
        let with = |value, reference_share| {
            Measured { value, error: 0.0, reference_share, pixels: 1, excluded: 0 }.corrected()
        };
        assert_eq!(with(3.0, 1.0), 2.0);
        assert_eq!(with(1.0, 3.0), 0.0);
        assert!(with(f64::NAN, 0.0).is_nan());
    }

    #[test]
    fn the_references_noise_is_part_of_the_uncertainty() {
        let measured = Measured { value: 5.0, error: 0.3, reference_share: 0.4, pixels: 1, excluded: 0 };
        assert!((measured.uncertainty() - 0.5).abs() < 1e-12);
    }
}
