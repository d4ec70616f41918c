//! The exposures under which HDR-FLIP looks.

use super::super::picture::is_finite;
use super::colour::{ACES, luminance};

/// The tone curve's value that the brightest and the median pixel are brought to (Andersson et al. 2021).
const TARGET: f32 = 0.85;

/// Exposures in stops, at most one apart, but two at least: from the one that brings the reference's brightest
/// pixel to the tone curve's shoulder to the one that brings its median there. As in the authors' evaluator,
/// median is not taken below 2⁻²³, so a picture more than half black is looked at in more than 20 stops; here
/// the maximum is not either, so that an all-black one is looked at too. Pixels that are not finite are left out.
pub(super) fn exposures(reference: &[[f32; 3]]) -> Vec<f32> {
    let mut luminances: Vec<f32> = reference
        .iter()
        .filter(|rgb| is_finite(**rgb))
        // Three finite channels may sum to more than a float holds.
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

/// The radiance that the curve brings to [`TARGET`], the larger root of a quadratic.
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
        // The authors' evaluator, version 1.7, for an 8 × 8 picture of 10⁻⁵ with one pixel of 1.
        let mut picture = vec![[1e-5; 3]; 64];
        picture[18] = [1.0; 3];
        let found = exposures(&picture);
        assert_eq!(found.len(), 17);
        assert!((found[0] - 1.083_297_3).abs() < 1e-5 && (found[16] - 17.692_938).abs() < 1e-5, "{found:?}");
        // The same of 0.
        picture.fill([0.0; 3]);
        picture[18] = [1.0; 3];
        let found = exposures(&picture);
        assert_eq!(found.len(), 23);
        assert!((found[22] - 24.083_298).abs() < 1e-5, "{found:?}");
    }

    #[test]
    fn any_picture_has_exposures() {
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
