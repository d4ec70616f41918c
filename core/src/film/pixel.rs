//! Running moments of one pixel.

/// Running moments of linear sRGB samples, by Welford's update (1962) and its extension to the third moment
/// (Pébay 2008).
///
/// Grey is the mean of the three channels, and chroma the component perpendicular to it: in the orthonormal
/// opponent basis (R+G+B)/√3, (R−G)/√2, (R+G−2B)/√6 the squared deviations of grey and chroma add up to those
/// of R, G and B.
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Zeroable)]
pub struct Pixel {
    /// Number of samples added.
    pub count: u64,
    /// Evaluations of the medium's coefficients for all samples, including rejected ones.
    pub lookups: u64,
    /// Mean of the samples.
    pub mean: [f64; 3],
    /// Σ (x − mean)².
    pub m2: [f64; 3],
    /// Σ of the squared deviations perpendicular to grey.
    pub chroma_m2: f64,
    /// Σ (grey − mean)³.
    pub grey_m3: f64,
    /// Σ q², with q the increment of the mean of `m2` over channels by each sample: a measure of the accuracy
    /// of `m2`.
    pub growth_m2: f64,
}

impl Pixel {
    /// Adds one sample, which has to be finite.
    pub fn add(&mut self, sample: [f32; 3]) {
        let before = self.count as f64;
        self.count += 1;
        let n = before + 1.0;
        let (mut grey, mut squares) = (0.0, 0.0);
        let grey_m2 = self.grey_m2();
        for ((mean, m2), x) in self.mean.iter_mut().zip(&mut self.m2).zip(sample) {
            let delta = f64::from(x) - *mean;
            *mean += delta / n;
            let grown = delta * delta * (before / n);
            *m2 += grown;
            squares += grown;
            grey += delta;
        }
        self.chroma_m2 += (squares - grey * grey / 3.0 * (before / n)).max(0.0);
        let delta = grey / 3.0;
        let share = delta / n;
        self.grey_m3 += share * (delta * share * before * (n - 2.0) - 3.0 * grey_m2);
        self.growth_m2 += (squares / 3.0).powi(2);
    }

    /// Σ (grey − mean)².
    fn grey_m2(&self) -> f64 {
        (self.m2.iter().sum::<f64>() - self.chroma_m2) / 3.0
    }

    /// Unbiased estimate of the variance of the mean, per channel; infinite below two samples.
    #[must_use]
    pub fn variance_of_mean(&self) -> [f64; 3] {
        if self.count < 2 {
            return [f64::INFINITY; 3];
        }
        let n = self.count as f64;
        self.m2.map(|m2| m2 / (n * (n - 1.0)))
    }

    /// Part of the variance of the mean, averaged over channels, that is perpendicular to grey; infinite
    /// below two samples.
    #[must_use]
    pub fn chroma_variance_of_mean(&self) -> f64 {
        if self.count < 2 {
            return f64::INFINITY;
        }
        let n = self.count as f64;
        self.chroma_m2 / (3.0 * n * (n - 1.0))
    }

    /// Unbiased estimate of the third central moment of the mean's grey, E(ḡ − E ḡ)³ = μ₃/n²; infinite below
    /// three samples.
    #[must_use]
    pub fn third_moment_of_mean(&self) -> f64 {
        if self.count < 3 {
            return f64::INFINITY;
        }
        let n = self.count as f64;
        self.grey_m3 / (n * (n - 1.0) * (n - 2.0))
    }

    /// Variance of the estimated variance of the mean, averaged over channels. Infinite below three samples.
    ///
    /// The increment of Σ(x − mean)² by sample i has the expectation σ² for every i ≥ 2, and for normal
    /// samples the increments are independent (Helmert), so the variance follows from their spread.
    #[must_use]
    pub fn variance_of_variance(&self) -> f64 {
        if self.count < 3 {
            return f64::INFINITY;
        }
        let n = self.count as f64;
        let additions = n - 1.0;
        let sum = self.m2.iter().sum::<f64>() / 3.0;
        let scatter = (self.growth_m2 - sum * sum / additions).max(0.0);
        scatter / (additions * (additions - 1.0)) / (n * n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(samples: &[[f32; 3]]) -> Pixel {
        let mut pixel = Pixel::default();
        for s in samples {
            pixel.add(*s);
        }
        pixel
    }

    #[test]
    fn moments_match_their_definition() {
        let pixel = filled(&[[1.0, 0.0, -2.0], [3.0, 0.5, 2.0], [8.0, 0.25, 0.0]]);
        assert_eq!(pixel.mean, [4.0, 0.25, 0.0]);
        let variance = pixel.variance_of_mean();
        for (v, expected) in variance.iter().zip([26.0 / 6.0, 0.125 / 6.0, 8.0 / 6.0]) {
            assert!((v - expected).abs() < 1e-12);
        }
        assert_eq!(Pixel::default().variance_of_mean()[0], f64::INFINITY);
    }

    #[test]
    fn more_than_32_bits_of_samples_are_counted() {
        let billions = 1u64 << 33;
        // Half of the samples are 1, half 3.
        let m2 = [billions as f64; 3];
        let mut pixel = Pixel { count: billions, mean: [2.0; 3], m2, ..Pixel::default() };
        pixel.add([2.0; 3]);
        assert_eq!(pixel.count, billions + 1);
        let expected = 1.0 / billions as f64;
        assert!((pixel.variance_of_mean()[0] / expected - 1.0).abs() < 1e-6);
        assert!(pixel.third_moment_of_mean().is_finite() && pixel.variance_of_variance().is_finite());
        // The same size as with 32-bit counters, which were padded.
        assert_eq!(size_of::<Pixel>(), 88);
    }

    #[test]
    fn third_moment_and_chroma_match_their_definition() {
        let samples: Vec<[f32; 3]> =
            (0..9u8).map(|i| [f32::from(i * i), f32::from(i) * 0.5, f32::from(7 * i % 5)]).collect();
        let pixel = filled(&samples);
        let n = samples.len() as f64;
        let grey = |s: &[f32; 3]| s.iter().map(|x| f64::from(*x)).sum::<f64>() / 3.0;
        let mean = samples.iter().map(grey).sum::<f64>() / n;
        let m3: f64 = samples.iter().map(|s| (grey(s) - mean).powi(3)).sum();
        assert!((pixel.grey_m3 - m3).abs() < 1e-9 * m3.abs(), "{} {m3}", pixel.grey_m3);
        assert!((pixel.third_moment_of_mean() - m3 / (n * (n - 1.0) * (n - 2.0))).abs() < 1e-9);
        let comparisons =
            [[1.0 / 2f64.sqrt(), -1.0 / 2f64.sqrt(), 0.0], [1.0, 1.0, -2.0].map(|x| x / 6f64.sqrt())];
        let chroma: f64 = comparisons
            .iter()
            .map(|axis| {
                let along = |s: &[f32; 3]| s.iter().zip(axis).map(|(x, a)| f64::from(*x) * a).sum::<f64>();
                let mean = samples.iter().map(along).sum::<f64>() / n;
                samples.iter().map(|s| (along(s) - mean).powi(2)).sum::<f64>()
            })
            .sum();
        assert!((pixel.chroma_m2 - chroma).abs() < 1e-9 * chroma);
        let grey_samples = filled(&[[1.0; 3], [4.0; 3], [2.5; 3]]);
        assert!(grey_samples.chroma_variance_of_mean() < 1e-12);
    }

    /// Over many pixels the estimated variance of the variance equals the variance of the estimates.
    #[test]
    fn the_variance_of_the_variance_matches_its_spread() {
        use crate::math::Sampler;
        let (pixels, n) = (4000u64, 24u64);
        let all: Vec<Pixel> = (0..pixels)
            .map(|p| {
                let sample = |s| {
                    // Skewed like typical path contributions: an exponential, equal in all channels up to a
                    // factor.
                    let x = Sampler::new(5, p, s).next_optical_depth();
                    [x, 0.5 * x, 2.0 * x]
                };
                filled(&(0..n).map(sample).collect::<Vec<_>>())
            })
            .collect();
        let mean = |f: &dyn Fn(&Pixel) -> f64| all.iter().map(f).sum::<f64>() / pixels as f64;
        let variance = |p: &Pixel| p.variance_of_mean().iter().sum::<f64>() / 3.0;
        let average = mean(&variance);
        let scatter = mean(&|p| (variance(p) - average).powi(2));
        let stated = mean(&Pixel::variance_of_variance);
        // The increments of one firefly are slightly correlated: within a quarter.
        assert!((stated / scatter - 1.0).abs() < 0.25, "{stated} {scatter}");
        // An exponential of mean 1 has μ₃ = 2; grey is 3.5/3 times it.
        let third = mean(&Pixel::third_moment_of_mean) * (n * n) as f64;
        let expected = 2.0 * (3.5f64 / 3.0).powi(3);
        assert!((third / expected - 1.0).abs() < 0.1, "{third} {expected}");
    }
}
