//! FLIP: the difference that a person sees who alternates between the pictures.
//!
//! LDR-FLIP (P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020) blurs both
//! as the eye's contrast sensitivity does (`csf.rs`), takes a colour difference ΔE_c (`colour.rs`), sharpens it
//! where edges or points differ by ΔE_f (`feature.rs`):
//!
//! ```text
//!   ΔE = ΔE_c^(1 − ΔE_f),  between 0 and 1
//! ```
//!
//! HDR-FLIP (P. Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images", EG 2021) is the
//! largest of it over a range of exposures (`exposure.rs`) under a tone curve. Numbers agree with version 1.7
//! of the authors' evaluator at its defaults: the constants, separated filters and rounding of radii are its.

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

/// FLIP for high dynamic range.
pub(super) const MEASURE: Measure = Measure {
    id: "flip",
    name: "FLIP",
    formula: "mean HDR-FLIP: the largest over exposures of ΔE_colour^(1 − ΔE_feature), 67 pixels per degree",
    doc: "What a person sees who flips between picture and reference, from 0 to 1.",
    measure: flip,
    // A colour difference enters by its 0.7th power, that is, N^(−0.7/2); features, which only sharpen that,
    // vanish with it.
    slope: -0.35,
};

/// Exposed radiance is kept below this, so that its square is finite. White is far below.
const BRIGHTEST: f32 = 1e15;

/// Mean HDR-FLIP over the region, without unit, evaluated on the whole picture: what surrounds the region is
/// seen too. Pixels that are not finite are black in both pictures and not counted. `error` takes pixels as
/// independent, which the filters make them not quite be. `reference_share` is 0: it is not known.
///
/// # Errors
/// Picture and reference differ in size.
fn flip(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    let map = map(picture, &reference.picture)?;
    average_pixels(reference, region, |i| is_finite(picture.pixels[i]), |i, _| (f64::from(map[i]), 0.0))
}

/// HDR-FLIP of every pixel, from 0 to 1 (Andersson et al. 2021). Input is linear sRGB; below 0 counts as 0, and
/// a pixel that is not finite in either picture as black in both.
///
/// # Errors
/// The pictures differ in size.
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

/// LDR-FLIP of every pixel, from 0 to 1 (Andersson et al. 2020). Input is what a display emits, linear sRGB
/// from 0 to 1: decode pictures in the sRGB curve first. It is clamped.
///
/// # Errors
/// The pictures differ in size.
pub fn ldr(picture: &Picture, reference: &Picture) -> Result<Vec<f32>, MeasureError> {
    picture.check_against(reference)?;
    let mut largest = vec![0.0; picture.pixels.len()];
    Pair::new(picture, reference).raise(&mut largest, clamped);
    Ok(largest)
}

#[cfg(test)]
mod tests;
