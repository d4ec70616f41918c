//! Result of an error measure.

/// Value of an error measure, with its standard error and the part due to noise of the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Value of the plain formula; NaN if no pixel was counted.
    pub value: f64,
    /// Standard error of the value, from the spread over pixels: σ/√pixels, with the n − 1 estimate of σ;
    /// infinite below two pixels. Pixels are assumed to be independent.
    pub error: f64,
    /// Expected contribution of the reference's noise to the value.
    pub reference_share: f64,
    /// Number of pixels counted.
    pub pixels: u64,
    /// Number of pixels excluded because they or their standard errors are not finite.
    pub excluded: u64,
}

impl Measured {
    /// The value without the contribution of the reference's noise, at least 0.
    #[must_use]
    pub fn corrected(&self) -> f64 {
        // `max` would turn NaN into 0.
        if self.value.is_nan() { self.value } else { (self.value - self.reference_share).max(0.0) }
    }

    /// Uncertainty of [`Self::corrected`]: the standard error combined with the full correction for the
    /// reference's noise. A reference about as noisy as the image therefore yields a large uncertainty.
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
