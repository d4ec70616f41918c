//! Cost, noise and bias as functions of the majorant factor.
//!
//! The same small image is rendered at every factor of [`FACTORS`], in independent batches. Above 1, null
//! collisions are added: look-ups increase and the noise hardly changes. Below 1, the extinction exceeds the
//! majorant: with weighting the mean is preserved and the variance grows; with clamping the noise stays the
//! same and the mean is biased.

use crate::check::{BATCHES, Batches, CheckError, Layout, Plan, own_scene};
use crate::estimator::{self, Kernel, Settings};
use crate::io::Library;
use crate::scene::{Scene, SceneDoc, build};
use crate::transport::CancelToken;

/// Majorant factors of a curve.
pub const FACTORS: [f32; 10] = [0.4, 0.5, 0.63, 0.8, 1.0, 1.26, 1.6, 2.5, 4.0, 8.0];

/// Minimum number of paths per point. The reference uses [`REFERENCE`] times as many.
const PATHS: u64 = 100_000;
const REFERENCE: u64 = 12;

/// Measurements at one majorant factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorPoint {
    /// Majorant divided by the largest extinction.
    pub factor: f32,
    /// Look-ups of the medium per path, a measure of cost.
    pub lookups_per_path: f64,
    /// Fraction of look-ups at which the extinction exceeds the majorant.
    pub exceeded: f64,
    /// Variance of the contribution of one path to the image mean, divided by the squared mean.
    pub variance: f64,
    /// Relative bias: image mean divided by the reference mean, minus one.
    pub bias: f64,
    /// Standard error of `bias`.
    pub bias_error: f64,
}

/// Measures the curve of a scene with its own estimator, point by point. Returns `Ok(None)` if cancelled.
///
/// Bias is measured relative to a longer run at factor 1, where the majorant bounds the extinction, with
/// every biased setting removed. The points keep the settings of the document.
///
/// # Errors
/// When the scene cannot be built.
pub fn factor_curve(
    name: &str,
    doc: &SceneDoc,
    library: Library,
    cancel: CancelToken<'_>,
    mut on_point: impl FnMut(FactorPoint),
) -> Result<Option<()>, CheckError> {
    let case = own_scene(name, doc, library);
    let mut library = case.library;
    let Some(entry) = estimator::find(&case.doc.estimator.id) else { return Ok(Some(())) };
    let mut picture = |factor: f32, seed: u64, paths: u64, reference: bool| {
        let mut doc = if reference { case.doc.unbiased() } else { case.doc.clone() };
        for medium in &mut doc.media {
            medium.majorant.factor = factor;
        }
        let scene = build(&doc, &mut library)
            .map_err(|source| CheckError::Build { name: name.to_owned(), source })?;
        let settings = Settings::new(&doc.estimator, doc.render.seed.wrapping_add(seed));
        Ok::<_, CheckError>(render(&scene, entry.kernel, &settings, paths, cancel))
    };
    let Some(reference) = picture(1.0, u64::MAX / 2, REFERENCE * PATHS, true)? else { return Ok(None) };
    let (truth, uncertainty) = reference.whole();
    for (seed, factor) in (1..).zip(FACTORS) {
        let Some(batches) = picture(factor, seed, PATHS, false)? else { return Ok(None) };
        let (mean, error) = batches.whole();
        let (paths, lookups) = (batches.paths as f64, batches.lookups as f64);
        on_point(FactorPoint {
            factor,
            lookups_per_path: lookups / paths,
            exceeded: batches.exceeded as f64 / lookups.max(1.0),
            variance: (error / truth).powi(2) * paths,
            bias: mean / truth - 1.0,
            bias_error: error.hypot(uncertainty) / truth.abs(),
        });
    }
    Ok(Some(()))
}

fn render(
    scene: &Scene,
    kernel: Kernel,
    settings: &Settings,
    paths: u64,
    cancel: CancelToken<'_>,
) -> Option<Batches> {
    let per_sample = u64::from(scene.width) * u64::from(scene.height) * BATCHES as u64;
    let spp = paths.div_ceil(per_sample);
    Batches::render(&Plan { scene, kernel, settings, layout: Layout::WHOLE, first_sample: 0, spp }, cancel)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::scene_file;

    fn curve(when_exceeded: &str) -> Vec<FactorPoint> {
        let doc = scene_file::parse(
            &format!(
                "majorant = 1
                [film]
                width = 12
                height = 12
                [medium]
                extinction = {{ rgb = [3.0, 2.0, 1.0] }}
                albedo = 0.8
                majorant = {{ when_exceeded = \"{when_exceeded}\" }}
                [[lights]]
                kind = \"environment\"
                visible = false
                [estimator]
                mode = \"rgb\""
            ),
            "curve",
        );
        let mut points = Vec::new();
        let done =
            factor_curve("curve", &doc.unwrap(), Library::default(), CancelToken::NEVER, |p| points.push(p));
        assert_eq!(done.unwrap(), Some(()));
        points
    }

    #[test]
    fn cost_rises_above_one_and_below_it_noise_or_bias() {
        let [weighted, clamped] = ["weighted", "clamp"].map(curve);
        assert_eq!(weighted.len(), FACTORS.len());
        for (w, c) in weighted.iter().zip(&clamped) {
            assert!(w.bias.abs() < 5.0 * w.bias_error, "{w:?}");
            assert_eq!(w.exceeded > 0.0, w.factor < 1.0, "{w:?}");
            assert_eq!(c.bias.abs() > 5.0 * c.bias_error, c.factor < 1.0, "{c:?}");
        }
        let at = |factor: f32| weighted.iter().find(|p| p.factor == factor).unwrap();
        assert!(at(8.0).lookups_per_path > 4.0 * at(1.0).lookups_per_path);
        assert!(at(0.4).variance > 1.5 * at(1.0).variance, "{:?} {:?}", at(0.4), at(1.0));
        assert!(at(8.0).variance < 1.5 * at(1.0).variance, "{:?} {:?}", at(8.0), at(1.0));
    }
}
