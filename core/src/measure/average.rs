//! Mean and standard error of a quantity over a region.

use rayon::prelude::*;

use super::picture::is_finite;
use super::{MeasureError, Measured, Picture, ReferencePicture, Region};

/// One channel of one pixel.
#[derive(Clone, Copy)]
pub(super) struct Channel {
    /// Value of the image.
    pub a: f64,
    /// Value of the reference.
    pub r: f64,
    /// Standard error of the reference; 0 if the reference is assumed to be exact.
    pub noise: f64,
    /// Index of the channel within the region, independent of the region's position in the image.
    pub key: u64,
}

/// Averages over pixels and channels: `of` returns the value of a channel and the reference's share in it.
pub(super) fn average(
    picture: &Picture,
    reference: &ReferencePicture,
    region: Region,
    of: impl Fn(Channel) -> (f64, f64) + Sync,
) -> Result<Measured, MeasureError> {
    picture.check_against(&reference.picture)?;
    average_pixels(
        reference,
        region,
        |i| is_finite(picture.pixels[i]),
        |i, key| {
            let noise = reference.standard_error.map_or([0.0; 3], |e| e[i]);
            let (mut value, mut share) = (0.0, 0.0);
            for (c, noise) in noise.into_iter().enumerate() {
                let (a, r) = (f64::from(picture.pixels[i][c]), f64::from(reference.picture.pixels[i][c]));
                let (v, s) = of(Channel { a, r, noise: f64::from(noise), key: 3 * key + c as u64 });
                value += v / 3.0;
                share += s / 3.0;
            }
            (value, share)
        },
    )
}

/// Averages over the pixels of a region that are finite in the reference and by `finite`: `of` returns a
/// pixel's value and the reference's share in it, from its index in the image and in the region.
pub(super) fn average_pixels(
    reference: &ReferencePicture,
    region: Region,
    finite: impl Fn(usize) -> bool + Sync,
    of: impl Fn(usize, u64) -> (f64, f64) + Sync,
) -> Result<Measured, MeasureError> {
    reference.picture.check("the reference")?;
    reference.check()?;
    let width = reference.picture.width;
    let region = region.clipped(width, reference.picture.height);
    let rows: Vec<Moments> = (region.y0..region.y1)
        .into_par_iter()
        .map(|y| {
            let mut row = Moments::default();
            for x in region.x0..region.x1 {
                let index = y * width + x;
                if finite(index) && reference.is_finite(index) {
                    let (value, share) = of(index, ((y - region.y0) * region.width() + x - region.x0) as u64);
                    row.add(value, share);
                } else {
                    row.excluded += 1;
                }
            }
            row
        })
        .collect();
    // In the order of rows, so that the sum does not depend on the threads.
    Ok(rows.iter().fold(Moments::default(), Moments::merged).finish())
}

/// Running mean and squared deviations, by Welford's update (1962), merged by the formula of Chan, Golub and
/// LeVeque.
#[derive(Clone, Copy, Default)]
struct Moments {
    count: u64,
    mean: f64,
    m2: f64,
    share: f64,
    excluded: u64,
}

impl Moments {
    fn add(&mut self, value: f64, share: f64) {
        self.count += 1;
        let delta = value - self.mean;
        self.mean += delta / self.count as f64;
        self.m2 += delta * (value - self.mean);
        self.share += share;
    }

    fn merged(self, other: &Self) -> Self {
        let count = self.count + other.count;
        let fraction = other.count as f64 / count.max(1) as f64;
        let delta = other.mean - self.mean;
        Self {
            count,
            mean: self.mean + delta * fraction,
            m2: self.m2 + other.m2 + delta * delta * self.count as f64 * fraction,
            share: self.share + other.share,
            excluded: self.excluded + other.excluded,
        }
    }

    fn finish(self) -> Measured {
        let Self { count: pixels, excluded, .. } = self;
        let n = pixels as f64;
        if pixels == 0 {
            return Measured {
                value: f64::NAN,
                error: f64::INFINITY,
                reference_share: 0.0,
                pixels,
                excluded,
            };
        }
        let error = if pixels < 2 { f64::INFINITY } else { (self.m2 / ((n - 1.0) * n)).sqrt() };
        Measured { value: self.mean, error, reference_share: self.share / n, pixels, excluded }
    }
}
