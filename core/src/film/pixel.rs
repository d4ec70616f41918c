//! One pixel's running moments.

/// Count, mean and sum of squared deviations of linear sRGB samples, by Welford's update (1962).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Samples added.
    pub count: u32,
    /// Mean of the samples.
    pub mean: [f64; 3],
    /// Σ (x − mean)².
    pub m2: [f64; 3],
}

impl Pixel {
    /// Adds one sample. The caller has checked that it is finite.
    pub fn add(&mut self, sample: [f32; 3]) {
        self.count += 1;
        let n = f64::from(self.count);
        for ((mean, m2), x) in self.mean.iter_mut().zip(&mut self.m2).zip(sample) {
            let x = f64::from(x);
            let delta = x - *mean;
            *mean += delta / n;
            *m2 += delta * (x - *mean);
        }
    }

    /// Unbiased estimate of the variance of the mean, per channel; infinite below two samples.
    #[must_use]
    pub fn variance_of_mean(&self) -> [f64; 3] {
        if self.count < 2 {
            return [f64::INFINITY; 3];
        }
        let n = f64::from(self.count);
        self.m2.map(|m2| m2 / (n * (n - 1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_match_their_definition() {
        let samples = [[1.0, 0.0, -2.0], [3.0, 0.5, 2.0], [8.0, 0.25, 0.0]];
        let mut pixel = Pixel::default();
        for s in samples {
            pixel.add(s);
        }
        assert_eq!(pixel.mean, [4.0, 0.25, 0.0]);
        let variance = pixel.variance_of_mean();
        for (v, expected) in variance.iter().zip([26.0 / 6.0, 0.125 / 6.0, 8.0 / 6.0]) {
            assert!((v - expected).abs() < 1e-12);
        }
        assert_eq!(Pixel::default().variance_of_mean()[0], f64::INFINITY);
    }
}
