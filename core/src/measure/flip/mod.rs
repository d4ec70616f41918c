//! FLIP: the perceived difference when alternating between two images.
//!
//! LDR-FLIP (P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020) blurs both
//! images by the eye's contrast sensitivity (`csf.rs`), computes a colour difference ΔE_c (`colour.rs`), and
//! amplifies it where edges or points differ by ΔE_f (`feature.rs`):
//!
//! ```text
//!   ΔE = ΔE_c^(1 − ΔE_f),  between 0 and 1
//! ```
//!
//! HDR-FLIP (P. Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images", EG 2021) is its
//! maximum over a range of exposures (`exposure.rs`) with a tone curve. Results agree with version 1.7 of the
//! authors' evaluator at its default settings, and use its constants, separated filters and rounding of
//! radii.

mod colour;
mod csf;
mod exposure;
mod feature;
mod filter;
mod kernel;
mod pair;

use super::average::average_pixels;
use super::picture::is_finite;
use super::{Measure, MeasureError, Measured, Picture, ReferencePicture, Region};
use colour::{aces, clamped, each};
use exposure::exposures;
use pair::Pair;

/// FLIP for high dynamic range images.
pub(super) const MEASURE: Measure = Measure {
    id: "flip",
    name: "FLIP",
    formula: "mean HDR-FLIP: maximum over exposures of ΔE_colour^(1 − ΔE_feature), 67 pixels per degree",
    doc: "Perceived difference when flipping between image and reference, from 0 to 1.",
    measure: flip,
    // A colour difference enters with the power 0.7, which gives N^(−0.7/2); features only amplify it, and
    // vanish with it.
    slope: -0.35,
};

/// Upper limit of exposed radiance, far above white, so that its square is finite.
const BRIGHTEST: f32 = 1e15;

/// Mean HDR-FLIP over the region, dimensionless. It is evaluated on the whole image, since the surroundings
/// of the region affect it. Non-finite pixels are black in both images and not counted. `error` assumes
/// independent pixels, which is not exact because of the filters. `reference_share` is 0, since it is
/// unknown.
///
/// # Errors
/// When image and reference differ in size.
fn flip(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    let map = map(picture, &reference.picture)?;
    average_pixels(reference, region, |i| is_finite(picture.pixels[i]), |i, _| (f64::from(map[i]), 0.0))
}

/// HDR-FLIP of every pixel, from 0 to 1 (Andersson et al. 2021). The input is linear sRGB. Negative values
/// count as 0, and a pixel that is not finite in either image is black in both.
///
/// # Errors
/// When the images differ in size.
pub fn map(picture: &Picture, reference: &Picture) -> Result<Vec<f32>, MeasureError> {
    picture.check_against(reference)?;
    let mut largest = vec![0.0; picture.pixels.len()];
    let mut pair = Pair::new(picture, reference);
    for exposure in exposures(reference.pixels) {
        let scale = exposure.exp2();
        let toned = |x: f32| aces((x.max(0.0) * scale).min(BRIGHTEST));
        pair.raise(&mut largest, |rgb| clamped(each(rgb, toned)));
    }
    Ok(largest)
}

/// LDR-FLIP of every pixel, from 0 to 1 (Andersson et al. 2020). The input is linear light of a display, sRGB
/// from 0 to 1: decode images with the sRGB curve first. Values are clamped.
///
/// # Errors
/// When the images differ in size.
pub fn ldr(picture: &Picture, reference: &Picture) -> Result<Vec<f32>, MeasureError> {
    picture.check_against(reference)?;
    let mut largest = vec![0.0; picture.pixels.len()];
    Pair::new(picture, reference).raise(&mut largest, clamped);
    Ok(largest)
}

#[cfg(test)]
mod tests;
