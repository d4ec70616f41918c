//! What errors are measured against.

use super::estimate::Estimate;
use crate::film::{Noise, Snapshot};
use crate::io::picture::{self, PictureError};
use crate::measure::{Picture, Region};
use std::path::Path;

/// A picture that others are held against, with its own noise and the image that it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Mean linear sRGB.
    pub mean: Vec<[f32; 3]>,
    /// Its standard error; absent: taken as exact.
    pub standard_error: Option<Vec<[f32; 3]>>,
    /// What else is known of its noise.
    pub noise: Option<Vec<Noise>>,
    /// Names the image that it estimates ([`crate::io::Library::fingerprint`]); absent if nobody knows, as for
    /// a picture by another renderer.
    pub target: Option<String>,
    /// Where it comes from, for people.
    pub origin: String,
}

impl Reference {
    /// The picture of a view.
    #[must_use]
    pub fn of(snapshot: &Snapshot, origin: impl Into<String>) -> Self {
        Self {
            width: snapshot.width,
            height: snapshot.height,
            mean: snapshot.mean.clone(),
            standard_error: Some(snapshot.standard_error.clone()),
            noise: (snapshot.noise.len() == snapshot.mean.len()).then(|| snapshot.noise.clone()),
            target: (!snapshot.target.is_empty()).then(|| snapshot.target.clone()),
            origin: origin.into(),
        }
    }

    /// Reads an EXR: R, G, B and, if they are there, standard errors and the name of the image.
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
            mean: read.picture.pixels,
            standard_error: read.standard_error,
            noise: None,
            target: target.map(str::to_owned),
            origin: name.into_owned(),
        })
    }

    /// The mean of independent pictures of one image, weighted by the inverse of their average variance: one
    /// weight per picture, since a pixel's own variance and mean hang together. `None` if there is none.
    #[must_use]
    pub fn pooled(snapshots: &[&Snapshot], origin: impl Into<String>) -> Option<Self> {
        let estimates: Vec<Estimate<'_>> = snapshots.iter().filter_map(|s| Estimate::of(s)).collect();
        let first = snapshots.first()?;
        if estimates.len() != snapshots.len() {
            return None;
        }
        let whole = Region::whole(first.width, first.height);
        let inverse: Vec<f64> = estimates
            .iter()
            .map(|e| super::RegionNoise::of(e, whole, |_| true).average_variance())
            // A picture without noise counts as one with very little.
            .map(|v| 1.0 / v.max(1e-30))
            .collect();
        let total: f64 = inverse.iter().sum();
        let weights: Vec<f64> = inverse.iter().map(|w| w / total).collect();
        let sum = |value: &dyn Fn(&Snapshot) -> Option<f64>, power: i32| -> f64 {
            snapshots.iter().zip(&weights).map(|(s, w)| w.powi(power) * value(s).unwrap_or(f64::NAN)).sum()
        };
        let count = whole.x1 * whole.y1;
        let of_pixels = |value: &dyn Fn(&Snapshot, usize, usize) -> Option<f32>, power: i32, root: bool| {
            (0..count)
                .map(|i| {
                    std::array::from_fn(|c| {
                        let squared = |x: f32| if root { f64::from(x).powi(2) } else { f64::from(x) };
                        let sum = sum(&|s| value(s, i, c).map(squared), power);
                        (if root { sum.sqrt() } else { sum }) as f32
                    })
                })
                .collect::<Vec<[f32; 3]>>()
        };
        let noise = (0..count).map(|i| {
            let at = |s: &Snapshot| s.noise.get(i).copied();
            Noise {
                chroma_variance: sum(&|s| at(s).map(|n| n.chroma_variance.into()), 2) as f32,
                third_moment: sum(&|s| at(s).map(|n| n.third_moment.into()), 3) as f32,
                variance_error: sum(&|s| at(s).map(|n| f64::from(n.variance_error).powi(2)), 4).sqrt() as f32,
                samples: snapshots.iter().filter_map(|s| at(s)).map(|n| n.samples).sum(),
                lookups: snapshots.iter().filter_map(|s| at(s)).map(|n| n.lookups).sum(),
            }
        });
        Some(Self {
            width: first.width,
            height: first.height,
            mean: of_pixels(&|s, i, c| Some(s.mean.get(i)?[c]), 1, false),
            standard_error: Some(of_pixels(&|s, i, c| Some(s.standard_error.get(i)?[c]), 2, true)),
            noise: Some(noise.collect()),
            target: Some(first.target.clone()),
            origin: origin.into(),
        })
    }

    /// The picture with its noise.
    #[must_use]
    pub fn estimate(&self) -> Estimate<'_> {
        Estimate {
            picture: Picture { width: self.width, height: self.height, pixels: &self.mean },
            standard_error: self.standard_error.as_deref(),
            noise: self.noise.as_deref(),
        }
    }

    /// Whether this is a picture of the image with this name.
    #[must_use]
    pub fn fits(&self, target: &str) -> bool {
        self.target.as_deref() == Some(target)
    }
}
