//! Reference images for error measurement.

use super::estimate::Estimate;
use super::fitness::{LOST, unfit_document};
use crate::film::{Noise, Snapshot};
use crate::io::picture::{self, PictureError};
use crate::io::scene_file;
use crate::measure::{Picture, Region};
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;

/// A reference image with its noise and the fingerprint of the image that it estimates.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    picture: Source,
    /// Fingerprint of the image ([`crate::io::Library::fingerprint`]); `None` if unknown, as for an image by
    /// another renderer.
    pub target: Option<String>,
    /// Display text that describes its source.
    pub origin: String,
    /// Seed stated by its file; no view may have the same.
    pub seed: Option<u64>,
    /// Changes and omissions when its file was read.
    pub notices: Vec<String>,
    /// Reason stated by its file why it cannot serve as a reference: biased settings, infinite variance, or
    /// excluded samples.
    pub unfit: Option<&'static str>,
}

/// Pixel storage: those of a view are shared, not copied.
#[derive(Clone, Debug)]
enum Source {
    View(Arc<Snapshot>),
    Own { mean: Vec<[f32; 3]>, standard_error: Option<Vec<[f32; 3]>>, noise: Option<Vec<Noise>> },
}

impl Reference {
    /// Creates a reference from the image of a view.
    #[must_use]
    pub fn of(snapshot: &Arc<Snapshot>, origin: impl Into<String>) -> Self {
        Self {
            width: snapshot.width,
            height: snapshot.height,
            target: (!snapshot.target.is_empty()).then(|| snapshot.target.clone()),
            picture: Source::View(Arc::clone(snapshot)),
            origin: origin.into(),
            seed: None,
            notices: Vec::new(),
            unfit: None,
        }
    }

    /// Adds the seed with which it was rendered.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed: Some(seed), ..self }
    }

    /// Creates a reference from an image with its standard error, independent of any view.
    #[must_use]
    pub fn own(
        (width, height): (usize, usize),
        mean: Vec<[f32; 3]>,
        standard_error: Vec<[f32; 3]>,
        origin: String,
    ) -> Self {
        let picture = Source::Own { mean, standard_error: Some(standard_error), noise: None };
        Self { width, height, picture, target: None, origin, seed: None, notices: Vec::new(), unfit: None }
    }

    /// Snapshot of the view whose image this is, if it is one.
    #[must_use]
    pub fn snapshot(&self) -> Option<&Arc<Snapshot>> {
        match &self.picture {
            Source::View(snapshot) => Some(snapshot),
            Source::Own { .. } => None,
        }
    }

    /// Mean linear sRGB, row by row from the top.
    #[must_use]
    pub fn mean(&self) -> &[[f32; 3]] {
        match &self.picture {
            Source::View(snapshot) => &snapshot.mean,
            Source::Own { mean, .. } => mean,
        }
    }

    /// Standard error; `None` if the means are treated as exact.
    #[must_use]
    pub fn standard_error(&self) -> Option<&[[f32; 3]]> {
        match &self.picture {
            Source::View(snapshot) => Some(&snapshot.standard_error),
            Source::Own { standard_error, .. } => standard_error.as_deref(),
        }
    }

    /// Further noise statistics.
    fn noise(&self) -> Option<&[Noise]> {
        match &self.picture {
            Source::View(snapshot) => {
                Some(snapshot.noise.as_slice()).filter(|n| n.len() == snapshot.mean.len())
            }
            Source::Own { noise, .. } => noise.as_deref(),
        }
    }

    /// Reads an EXR file: R, G, B and, if present, standard errors and fingerprint.
    ///
    /// # Errors
    /// When the file is missing, damaged, or has no R, G and B.
    pub fn read(path: &Path) -> Result<Self, PictureError> {
        let read = picture::read_estimate(path)?;
        let metadata = read.metadata.and_then(|text| serde_json::from_str::<serde_json::Value>(&text).ok());
        let target = metadata.as_ref().and_then(|m| m["target"].as_str()).filter(|t| !t.is_empty());
        let name = path.file_name().map_or_else(|| path.to_string_lossy(), |n| n.to_string_lossy());
        Ok(Self {
            width: read.picture.width,
            height: read.picture.height,
            picture: Source::Own {
                mean: read.picture.pixels,
                standard_error: read.standard_error,
                noise: None,
            },
            target: target.map(str::to_owned),
            origin: name.into_owned(),
            seed: metadata.as_ref().and_then(|m| m["seed"].as_u64()),
            notices: read.notices,
            unfit: metadata.as_ref().and_then(unfit),
        })
    }

    /// Mean of independent images of the same scene, weighted by the inverse of their average variance. There
    /// is one weight per image, since the variance and the mean of a pixel are correlated. `None` without
    /// images.
    #[must_use]
    pub fn pooled(snapshots: &[&Snapshot], origin: impl Into<String>) -> Option<Self> {
        let estimates: Vec<Estimate<'_>> = snapshots.iter().filter_map(|s| Estimate::of(s)).collect();
        let first = snapshots.first()?;
        let alike = |s: &&Snapshot| {
            (s.width, s.height) == (first.width, first.height)
                && [s.mean.len(), s.standard_error.len(), s.noise.len()] == [first.mean.len(); 3]
        };
        if estimates.len() != snapshots.len() || !snapshots.iter().all(alike) {
            return None;
        }
        let whole = Region::whole(first.width, first.height);
        let inverse: Vec<f64> = estimates
            .iter()
            .map(|e| super::RegionNoise::of(e, whole, |_| true).average_variance())
            // An image without noise is given a very small variance.
            .map(|v| 1.0 / v.max(1e-30))
            .collect();
        let total: f64 = inverse.iter().sum();
        let weights: Vec<f64> = inverse.iter().map(|w| w / total).collect();
        let count = first.mean.len();
        let pixel = |i: usize| {
            let (mut mean, mut variance) = ([0.0f64; 3], [0.0f64; 3]);
            let (mut chroma, mut third, mut spread) = (0.0, 0.0, 0.0);
            let mut noise = Noise { samples: 0, lookups: 0.0, ..Noise::default() };
            for (s, w) in snapshots.iter().zip(&weights) {
                let n = &s.noise[i];
                for c in 0..3 {
                    mean[c] += w * f64::from(s.mean[i][c]);
                    variance[c] += (w * f64::from(s.standard_error[i][c])).powi(2);
                }
                chroma += w * w * f64::from(n.chroma_variance);
                third += w.powi(3) * f64::from(n.third_moment);
                spread += (w * w * f64::from(n.variance_error)).powi(2);
                noise.samples += n.samples;
                noise.lookups += n.lookups;
            }
            noise.chroma_variance = chroma as f32;
            noise.third_moment = third as f32;
            noise.variance_error = spread.sqrt() as f32;
            (mean.map(|x| x as f32), (variance.map(|v| v.sqrt() as f32), noise))
        };
        let (mean, (standard_error, noise)) =
            (0..count).into_par_iter().with_min_len(4096).map(pixel).unzip();
        Some(Self {
            width: first.width,
            height: first.height,
            picture: Source::Own { mean, standard_error: Some(standard_error), noise: Some(noise) },
            target: Some(first.target.clone()),
            origin: origin.into(),
            seed: None,
            notices: Vec::new(),
            unfit: None,
        })
    }

    /// The image with its noise statistics.
    #[must_use]
    pub fn estimate(&self) -> Estimate<'_> {
        Estimate {
            picture: Picture { width: self.width, height: self.height, pixels: self.mean() },
            standard_error: self.standard_error(),
            noise: self.noise(),
        }
    }

    /// Whether it shows the image with this fingerprint.
    #[must_use]
    pub fn fits(&self, target: &str) -> bool {
        self.target.as_deref() == Some(target)
    }
}

/// Reason in the metadata of a file why it cannot serve as a reference. A scene that this version cannot read
/// gives none.
fn unfit(metadata: &serde_json::Value) -> Option<&'static str> {
    let lost = metadata["non_finite"].as_u64().is_some_and(|n| n > 0).then_some(LOST);
    let doc = metadata["scene"].as_str().and_then(|text| scene_file::parse(text, "the reference").ok());
    doc.as_ref().and_then(unfit_document).or(lost)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Film, Images, Tally};
    use crate::math::Sampler;

    fn noisy(seed: u64, size: usize, spp: u64) -> Snapshot {
        let mut film = Film::new(size, size);
        for (i, pixel) in film.pixels.iter_mut().enumerate() {
            for s in 0..spp {
                let mut sampler = Sampler::new(seed, i as u64, s);
                pixel.add(std::array::from_fn(|_| sampler.next_optical_depth()));
            }
        }
        let Images { mean, standard_error, noise } = Images::of(&film);
        Snapshot {
            generation: 1,
            width: size,
            height: size,
            mean,
            standard_error,
            noise,
            spp,
            coarse: None,
            seconds: 1.0,
            cpu_seconds: 1.0,
            tally: Tally::default(),
            threads: 1,
            cost_error: 0.0,
            target: "image".into(),
        }
    }

    /// Exponential noise of mean 1: the pool of 30 and 90 samples has the error of 120 samples, and states
    /// it.
    #[test]
    fn a_pool_is_as_good_as_its_samples_together() {
        let size = 40;
        let (a, b) = (noisy(1, size, 30), noisy(2, size, 90));
        let pool = Reference::pooled(&[&a, &b], "A, B").unwrap();
        let n = (size * size * 3) as f64;
        let actual = pool.mean().iter().flatten().map(|x| f64::from(x - 1.0).powi(2)).sum::<f64>() / n;
        let stated = pool.standard_error().unwrap().iter().flatten();
        let stated = stated.map(|e| f64::from(*e).powi(2)).sum::<f64>() / n;
        assert!((actual * 120.0 - 1.0).abs() < 0.1, "{actual}");
        assert!((stated * 120.0 - 1.0).abs() < 0.1, "{stated}");
        let third = pool.noise().unwrap().iter().map(|n| f64::from(n.third_moment)).sum::<f64>();
        // Grey of three independent exponentials has μ₃ = 3·2/27.
        let third = third / (size * size) as f64 * 120.0f64.powi(2);
        assert!((third / (6.0 / 27.0) - 1.0).abs() < 0.25, "{third}");
        assert!(Reference::pooled(&[&a, &noisy(3, 8, 30)], "").is_none());
        assert!(Reference::pooled(&[], "").is_none());
    }
}
