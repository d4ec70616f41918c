//! Exposures of HDR-FLIP.

use super::super::picture::is_finite;
use super::colour::{ACES, luminance};

/// Value of the tone curve to which the brightest and the median pixel are exposed (Andersson et al. 2021).
const TARGET: f32 = 0.85;

/// Exposures in stops, at most one apart and at least two: from the exposure that brings the reference's
/// brightest pixel to [`TARGET`] on the tone curve to the one that brings its median there. As in the
/// authors' evaluator, the median is at least 2⁻²³, so an image more than half black has more than 20
/// exposures. Here the maximum is at least 2⁻²³, too, so that an all-black image has an exposure. Non-finite
/// pixels are omitted.
pub(super) fn exposures(reference: &[[f32; 3]]) -> Vec<f32> {
    let mut luminances: Vec<f32> = reference
        .iter()
        .filter(|rgb| is_finite(**rgb))
        // Three finite channels may sum to infinity.
        .map(|rgb| luminance(*rgb).clamp(0.0, f32::MAX))
        .collect();
    let Some(middle) = luminances.len().checked_div(2).filter(|_| !luminances.is_empty()) else {
        return vec![0.0];
    };
    let median = luminances.select_nth_unstable_by(middle, f32::total_cmp).1.max(f32::EPSILON);
    let brightest = luminances.iter().fold(f32::EPSILON, |m, y| m.max(*y));
    let radiance = toned_to_target();
    let (start, stop) = ((radiance / brightest).log2(), (radiance / median).log2());
    let count = (stop - start).ceil().max(2.0) as usize;
    if start == stop {
        return vec![start];
    }
    let step = (stop - start) / (count - 1) as f32;
    (0..count).map(|i| start + i as f32 * step).collect()
}

/// Radiance that the tone curve maps to [`TARGET`], the larger root of a quadratic.
fn toned_to_target() -> f32 {
    let [above, below] = ACES;
    let [a, b, c] = [0, 1, 2].map(|i| above[i] - TARGET * below[i]);
    let half = -0.5 * (b / a);
    half + (half * half - c / a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::colour::aces;
    use super::*;

    #[test]
    fn from_the_brightest_to_the_median() {
        assert!((aces(toned_to_target()) - TARGET).abs() < 1e-6);
        // The authors' evaluator, version 1.7, for an 8 × 8 image of 10⁻⁵ with one pixel of 1.
        let mut picture = vec![[1e-5; 3]; 64];
        picture[18] = [1.0; 3];
        let found = exposures(&picture);
        assert_eq!(found.len(), 17);
        assert!((found[0] - 1.083_297_3).abs() < 1e-5 && (found[16] - 17.692_938).abs() < 1e-5, "{found:?}");
        // The same image with 0 in place of 10⁻⁵.
        picture.fill([0.0; 3]);
        picture[18] = [1.0; 3];
        let found = exposures(&picture);
        assert_eq!(found.len(), 23);
        assert!((found[22] - 24.083_298).abs() < 1e-5, "{found:?}");
    }

    #[test]
    fn any_image_has_exposures() {
        for picture in [
            vec![],
            vec![[f32::NAN; 3]],
            vec![[0.0; 3]; 9],
            vec![[-1.0; 3]; 9],
            vec![[f32::MAX; 3], [f32::MIN_POSITIVE; 3], [f32::INFINITY; 3]],
        ] {
            let found = exposures(&picture);
            assert!(!found.is_empty() && found.len() < 200, "{}", found.len());
            assert!(found.iter().all(|e| e.is_finite()));
        }
        // One luminance, one exposure: a second would be the same.
        assert_eq!(exposures(&[[0.3; 3]; 4]).len(), 1);
    }
}
