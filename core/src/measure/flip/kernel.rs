//! One-dimensional filter kernels.

/// Pixels per degree of visual angle: 0.7 m from a display 0.7 m and 3840 pixels wide.
pub(super) const PIXELS_PER_DEGREE: f32 = 0.7 * (3840.0 / 0.7) * (std::f32::consts::PI / 180.0);

/// Centred kernel with an odd number of taps.
#[derive(Clone, Debug)]
pub(super) struct Kernel {
    /// Weights, from the left or the top.
    pub weights: Vec<f32>,
}

impl Kernel {
    /// Samples a function at integer offsets up to `radius`.
    pub(super) fn sampled(radius: usize, f: impl Fn(f32) -> f32) -> Self {
        Self { weights: (0..=2 * radius).map(|i| f(i as f32 - radius as f32)).collect() }
    }

    /// Number of taps on either side of the centre.
    pub(super) fn radius(&self) -> usize {
        self.weights.len() / 2
    }

    pub(super) fn sum(&self) -> f32 {
        self.weights.iter().sum()
    }

    /// Multiplies every weight.
    pub(super) fn scaled(mut self, factor: f32) -> Self {
        self.weights.iter_mut().for_each(|w| *w *= factor);
        self
    }

    /// Scales positive weights to a sum of 1, and negative weights to a sum of −1.
    pub(super) fn balanced(mut self) -> Self {
        let of_sign = |positive: bool| -> f32 {
            self.weights.iter().filter(|w| (**w > 0.0) == positive).map(|w| w.abs()).sum()
        };
        let (above, below) = (of_sign(true), of_sign(false));
        self.weights.iter_mut().for_each(|w| *w /= if *w > 0.0 { above } else { below });
        self
    }

    /// Removes outer taps that are negligible in single precision: some Gaussians are much narrower than the
    /// widest, which sets the radius of all.
    pub(super) fn trimmed(mut self) -> Self {
        let seen = 1e-9 * self.weights.iter().fold(0.0f32, |m, w| m.max(w.abs()));
        let outer = self.weights.iter().take(self.radius()).take_while(|w| w.abs() < seen).count();
        let kept = self.weights.len() - outer;
        self.weights = self.weights.drain(outer..kept).collect();
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_balance_and_tails_go() {
        let derivative = Kernel::sampled(4, |x| -x * (-x * x).exp()).balanced();
        let positive: f32 = derivative.weights.iter().filter(|w| **w > 0.0).sum();
        assert!((positive - 1.0).abs() < 1e-6 && derivative.sum().abs() < 1e-6);
        let narrow = Kernel::sampled(9, |x| (-x * x).exp()).trimmed();
        assert_eq!((narrow.radius(), narrow.weights.len()), (4, 9));
        assert!((PIXELS_PER_DEGREE - 67.020_64).abs() < 1e-4);
    }
}
