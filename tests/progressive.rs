//! Progressive majorants, which are raised where they are exceeded: the image is independent of timing, and
//! the bias vanishes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use glam::Vec3;
use majorant_core::film::Snapshot;
use majorant_core::inspect::Split;
use majorant_core::scene::{DensityDoc, Limits, SceneDoc, WhenExceeded};
use majorant_core::session::ViewId;
use majorant_core::spectrum::SpectrumDoc;
use majorant_core::transport::CancelToken;
use majorant_tests::session::{Watched, assert_same, finished, job, small_doc};

const VIEW: ViewId = ViewId(0);

/// A scene whose majorants start at a tenth of the tight bound.
fn doc(threads: usize, spp: u64, when_exceeded: WhenExceeded) -> SceneDoc {
    let mut doc = small_doc(threads, spp);
    doc.medium_mut().majorant.factor = 0.1;
    doc.medium_mut().majorant.resolution = Some(8);
    doc.medium_mut().majorant.when_exceeded = when_exceeded;
    doc
}

/// Mean over the middle of the image, which the medium fills.
fn brightness(snapshot: &Snapshot) -> f64 {
    let pixels = (12..25).flat_map(|y| (24..37).map(move |x| y * 61 + x));
    let sum: f64 = pixels.map(|i| snapshot.mean[i].iter().map(|v| f64::from(*v)).sum::<f64>()).sum();
    sum / (3 * 13 * 13) as f64
}

#[test]
fn neither_threads_nor_pieces_nor_previews_matter() {
    let whole = finished(&doc(1, 11, WhenExceeded::Progressive));
    for threads in [2, 3] {
        assert_same(&whole, &finished(&doc(threads, 11, WhenExceeded::Progressive)));
    }
    for pieces in [&[1, 11][..], &[3, 4, 11], &[2, 5, 8, 9, 11]] {
        let session = Watched::new();
        session.submit(VIEW, job(&doc(2, pieces[0], WhenExceeded::Progressive), true));
        for spp in pieces {
            session.set_limits(VIEW, Limits::samples(*spp));
            session.wait_picture(VIEW, |_, s| s.spp == *spp);
        }
        assert_same(&whole, &session.wait_finished(VIEW));
    }
}

#[test]
fn the_error_vanishes_where_that_of_clamping_stays() {
    // Clamping reduces absorption.
    let absorbing = |mut doc: SceneDoc| {
        doc.medium_mut().albedo = SpectrumDoc::Constant(0.2);
        brightness(&finished(&doc))
    };
    let truth = absorbing(small_doc(2, 256));
    let of = |spp, when_exceeded| absorbing(doc(2, spp, when_exceeded));
    let error = |spp, when_exceeded| of(spp, when_exceeded) / truth - 1.0;
    let clamped = error(256, WhenExceeded::Clamp);
    let raised = error(256, WhenExceeded::Progressive);
    assert!(clamped.abs() > 0.05 && raised.abs() < 0.2 * clamped.abs(), "{clamped} {raised}");
    // The remaining bias comes from the first samples: those after the sixteenth are unbiased.
    let [first, all] = [16, 256].map(|spp: u64| spp as f64 * of(spp, WhenExceeded::Progressive));
    let later = (all - first) / 240.0 / truth - 1.0;
    assert!(later.abs() < 0.01, "{later}");
}

#[test]
fn a_homogeneous_medium_is_found_out_by_the_first_sample() {
    let mut doc = doc(2, 64, WhenExceeded::Progressive);
    doc.medium_mut().density = DensityDoc::Uniform {};
    // A shared majorant is determined by one wavelength, which has to be sampled first.
    doc.medium_mut().majorant.shared = false;
    let mut bounded = doc.clone();
    bounded.medium_mut().majorant.factor = 1.0;
    let session = Watched::new();
    session.submit(VIEW, job(&doc, false));
    let raised = session.wait_finished(VIEW);
    let probe = session.state(VIEW).probe.unwrap();
    assert_eq!(probe.violations(0).unwrap().exceeded_cells(), 0);
    // Only the first of 64 samples is clamped.
    let error = brightness(&raised) / brightness(&finished(&bounded)) - 1.0;
    assert!(error.abs() < 0.02, "{error}");
}

#[test]
fn a_probe_traces_every_sample_with_the_majorants_of_its_time() {
    let session = Watched::new();
    session.submit(VIEW, job(&doc(2, 21, WhenExceeded::Progressive), true));
    let snapshot = session.wait_finished(VIEW);
    let probe = session.state(VIEW).probe.unwrap();
    for (x, y) in [(30, 18), (25, 12), (35, 20), (31, 9)] {
        let samples = probe.samples((x, y), 0..21, CancelToken::NEVER);
        for c in 0..3 {
            let mean = samples.iter().map(|s| f64::from(s.rgb[c])).sum::<f64>() / 21.0;
            let shown = f64::from(snapshot.mean[(y * 61 + x) as usize][c]);
            assert!((mean - shown).abs() <= 1e-5 * shown.abs().max(1e-3), "{x} {y}: {mean} {shown}");
        }
    }
}

/// Contributions and noise analysis trace the paths of the film, each with the majorants that it had: the
/// contributions sum to the film, which would not hold with fixed majorants.
#[test]
fn contributions_sum_to_the_film_that_was_rendered_while_majorants_rose() {
    const SPP: u64 = 21;
    let session = Watched::new();
    session.submit(VIEW, job(&doc(2, SPP, WhenExceeded::Progressive), false));
    let film = session.wait_finished(VIEW);
    let probe = session.state(VIEW).probe.unwrap();
    assert!(film.tally.exceeded > 0);
    for split in Split::ALL {
        let parts = probe.strategies(split, 0..SPP, CancelToken::NEVER).unwrap();
        for (i, mean) in film.mean.iter().enumerate() {
            for (c, shown) in mean.iter().map(|x| f64::from(*x)).enumerate() {
                let of = || parts.layers.iter().map(|layer| f64::from(layer.mean[i][c]));
                let (sum, size) = (of().sum::<f64>(), of().map(f64::abs).sum::<f64>());
                if (sum - shown).abs() <= 2e-6 * size {
                    continue;
                }
                // Saturated wavelengths have positive and negative channels, which cancel in the means; rounding
                // is relative to the samples.
                let at = (i as u32 % 61, i as u32 / 61);
                let samples = probe.samples(at, 0..SPP, CancelToken::NEVER);
                let size =
                    samples.iter().map(|s| f64::from(Vec3::from(s.rgb).abs().max_element())).sum::<f64>();
                let off = (sum - shown).abs() * SPP as f64 / size;
                assert!(off <= 2e-6, "{} {i}: {sum} {shown}, {off:e}", split.name());
            }
        }
    }
    // The samples with the largest contributions are those of the film, too.
    let evidence = probe.evidence(None, None, CancelToken::NEVER).unwrap();
    for heavy in &evidence.heaviest.named {
        let recorded = probe.record(heavy.at, CancelToken::NEVER).estimate.rgb;
        let traced = probe.path(heavy.at.x, heavy.at.y, heavy.at.sample, CancelToken::NEVER).rgb;
        assert_eq!(recorded, traced);
        let pixel = film.mean[(heavy.at.y * 61 + heavy.at.x) as usize];
        assert!(heavy.at.sample >= SPP || recorded.element_sum() > pixel.iter().sum(), "{heavy:?}");
    }
}

/// Retraced paths do not affect the majorants of the film, even for later samples or with other estimators.
#[test]
fn looking_at_paths_does_not_raise_the_majorants_of_the_film() {
    let undisturbed = finished(&doc(2, 21, WhenExceeded::Progressive));
    let session = Watched::new();
    session.submit(VIEW, job(&doc(2, 1, WhenExceeded::Progressive), false));
    for spp in [1, 2, 3, 21] {
        session.set_limits(VIEW, Limits::samples(spp));
        session.wait_picture(VIEW, |_, s| s.spp == spp);
        let probe = session.state(VIEW).probe.unwrap();
        let found = probe.violations(0).unwrap().exceeded_cells();
        assert_eq!(probe.samples((30, 18), 1000..1200, CancelToken::NEVER).len(), 200);
        let other = probe.under(majorant_core::estimator::find("spectral-mis").unwrap());
        other.strategies(Split::Technique, 500..502, CancelToken::NEVER).unwrap();
        assert_eq!(probe.violations(0).unwrap().exceeded_cells(), found, "after {spp} samples");
    }
    assert_same(&undisturbed, &session.wait_finished(VIEW));
}
