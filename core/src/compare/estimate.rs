//! An image with its noise statistics, independent of its source.

use crate::film::{Noise, Snapshot};
use crate::measure::{Picture, Region};

/// An estimate of an image: means and their uncertainty.
#[derive(Clone, Copy, Debug)]
pub struct Estimate<'a> {
    /// Mean linear sRGB.
    pub picture: Picture<'a>,
    /// Standard error of every mean; `None` if the means are treated as exact.
    pub standard_error: Option<&'a [[f32; 3]]>,
    /// Skewness of the noise and uncertainty of its variance; `None` if treated as normal and known.
    pub noise: Option<&'a [Noise]>,
}

impl<'a> Estimate<'a> {
    /// The image of a view; `None` while it is a coarse preview or has fewer than three samples per pixel,
    /// which give no noise estimate.
    #[must_use]
    pub fn of(snapshot: &'a Snapshot) -> Option<Self> {
        let known = snapshot.spp >= 3 && snapshot.noise.len() == snapshot.mean.len();
        known.then_some(Self {
            picture: Picture { width: snapshot.width, height: snapshot.height, pixels: &snapshot.mean },
            standard_error: Some(&snapshot.standard_error),
            noise: Some(&snapshot.noise),
        })
    }
}

/// Moments of the mean over a region, from sums over its pixels. All variances are those of the region mean;
/// pixels are independent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegionNoise {
    /// Number of pixels included.
    pub pixels: u64,
    /// Mean of R, G, B.
    pub mean: [f64; 3],
    /// Variance of that mean, per channel.
    pub variance: [f64; 3],
    /// Variance of the grey mean, (R+G+B)/3.
    pub grey_variance: f64,
    /// Third central moment of the grey mean.
    pub third_moment: f64,
    /// Variance of the estimated variance, for the mean of `variance` over channels.
    pub variance_of_variance: f64,
}

impl RegionNoise {
    /// Sums over the finite pixels of a region for which `counts` returns true.
    #[must_use]
    pub fn of(estimate: &Estimate<'_>, region: Region, counts: impl Fn(usize) -> bool) -> Self {
        let width = estimate.picture.width;
        let region = region.clipped(width, estimate.picture.height);
        let mut sum = Self::default();
        for y in region.y0..region.y1 {
            for i in y * width + region.x0..y * width + region.x1 {
                if counts(i) {
                    sum.add(estimate, i);
                }
            }
        }
        sum.averaged()
    }

    fn add(&mut self, estimate: &Estimate<'_>, i: usize) {
        let (Some(mean), errors) = (estimate.picture.pixels.get(i), estimate.standard_error) else { return };
        let error = errors.map_or(Some(&[0.0; 3]), |e| e.get(i));
        let Some(error) = error.filter(|e| e.iter().chain(mean).all(|x| x.is_finite())) else { return };
        self.pixels += 1;
        let variance = error.map(|e| f64::from(e).powi(2));
        for c in 0..3 {
            self.mean[c] += f64::from(mean[c]);
            self.variance[c] += variance[c];
        }
        let average = variance.iter().sum::<f64>() / 3.0;
        match estimate.noise.and_then(|n| n.get(i)) {
            Some(noise) => {
                self.grey_variance += (average - f64::from(noise.chroma_variance)).max(0.0);
                self.third_moment += f64::from(noise.third_moment);
                self.variance_of_variance += f64::from(noise.variance_error).powi(2);
            }
            // The correlation of the channels is unknown: full correlation gives the largest grey variance.
            None => self.grey_variance += average,
        }
    }

    /// Converts sums over pixels to moments of their mean.
    fn averaged(mut self) -> Self {
        let n = self.pixels.max(1) as f64;
        self.mean = self.mean.map(|m| m / n);
        self.variance = self.variance.map(|v| v / (n * n));
        self.grey_variance /= n * n;
        self.third_moment /= n.powi(3);
        self.variance_of_variance /= n.powi(4);
        self
    }

    /// Mean over pixels and channels.
    #[must_use]
    pub fn grey(&self) -> f64 {
        self.mean.iter().sum::<f64>() / 3.0
    }

    /// Skewness of the grey mean; 0 without noise.
    #[must_use]
    pub fn skewness(&self) -> f64 {
        if self.grey_variance > 0.0 { self.third_moment / self.grey_variance.powf(1.5) } else { 0.0 }
    }

    /// Mean over channels of the variance of the mean.
    #[must_use]
    pub fn average_variance(&self) -> f64 {
        self.variance.iter().sum::<f64>() / 3.0
    }

    /// Variance of the mean of a pixel, averaged over pixels and channels, with its standard error.
    #[must_use]
    pub fn pixel_variance(&self) -> (f64, f64) {
        let n = self.pixels as f64;
        (self.average_variance() * n, self.variance_of_variance.sqrt() * n)
    }

    /// Component of [`Self::pixel_variance`] perpendicular to grey: colour noise.
    #[must_use]
    pub fn pixel_chroma_variance(&self) -> f64 {
        ((self.average_variance() - self.grey_variance) * self.pixels as f64).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_regions_mean_has_the_variance_of_independent_pixels() {
        let pixels = [[1.0, 2.0, 3.0], [3.0, 2.0, 1.0], [f32::NAN; 3], [9.0; 3]];
        let errors = [[0.3; 3], [0.4; 3], [0.1; 3], [0.2; 3]];
        let picture = Picture { width: 4, height: 1, pixels: &pixels };
        let estimate = Estimate { picture, standard_error: Some(&errors), noise: None };
        let noise = RegionNoise::of(&estimate, Region { x0: 0, y0: 0, x1: 3, y1: 1 }, |_| true);
        assert_eq!(noise.pixels, 2);
        assert_eq!(noise.mean, [2.0; 3]);
        assert!((noise.variance[0] - (0.09 + 0.16) / 4.0).abs() < 1e-8);
        assert_eq!(noise.skewness(), 0.0);
        let exact = Estimate { standard_error: None, ..estimate };
        assert_eq!(RegionNoise::of(&exact, Region::whole(4, 1), |i| i == 3).grey(), 9.0);
    }
}
