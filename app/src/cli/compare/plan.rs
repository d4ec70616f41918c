//! Document of a comparison: the scene, modified by the command line.

use super::Arguments;
use crate::cli::{Failure, options};
use majorant_core::compare::{self, Experiment, label, report::words};
use majorant_core::estimator::{self, REGISTRY};
use majorant_core::io::scene_file;
use majorant_core::scene::{Fairness, Limits, MAX_VIEWS, MeasureId, ReferenceDoc, SceneDoc};

/// Parses a positive number of seconds.
pub(super) fn parse_seconds(text: &str) -> Result<f32, String> {
    let seconds = text.parse().ok().filter(|s: &f32| *s > 0.0 && s.is_finite());
    seconds.ok_or_else(|| format!("`{text}` is not a duration: write a positive number of seconds, e.g. 20"))
}

/// Creates the document whose views are rendered, with the limits of each view.
pub(super) fn plan(scene: &SceneDoc, arguments: &Arguments) -> Result<SceneDoc, Failure> {
    let assignments = options::assignments(
        &arguments.set,
        &[
            ("film.width", arguments.size.map(|s| s[0].to_string())),
            ("film.height", arguments.size.map(|s| s[1].to_string())),
            ("render.seed", arguments.seed.map(|n| n.to_string())),
            ("render.threads", arguments.threads.map(|n| n.to_string())),
        ],
    );
    let mut doc = scene_file::override_keys(scene, &assignments)?;
    let limits = Limits { spp: arguments.spp, cpu_seconds: arguments.seconds, ..Limits::default() };
    options::replace_limits(&mut doc.render, limits);
    if arguments.seed.is_none() {
        avoid_seed(&mut doc, arguments.reference.as_deref().and_then(compare::seed_of));
    }
    if !arguments.estimators.is_empty() {
        set_views(&mut doc, arguments.estimators.iter().map(String::as_str));
    } else if doc.compare.views.is_empty() {
        set_views(&mut doc, REGISTRY.iter().map(|e| e.id));
    } else if arguments.seed.is_some() {
        let first = doc.render.seed;
        for (place, view) in (1u64..).zip(&mut doc.compare.views) {
            view.seed = first.saturating_add(place);
        }
    }
    if let Some(file) = &arguments.reference {
        // Relative to the working directory, not to the scene.
        let file = std::path::absolute(file)?.to_string_lossy().into_owned();
        doc.compare.reference = ReferenceDoc::File { file };
    }
    if let Some(estimator) = arguments.reference_estimator.clone() {
        let spp = arguments.reference_spp;
        doc.compare.reference = ReferenceDoc::Render { estimator, spp, relative_error: None };
    }
    if doc.compare.reference == ReferenceDoc::None {
        // As documented in the help: errors are also measured against the mean of the other views.
        doc.compare.reference = ReferenceDoc::Pooled;
    }
    if let Some(id) = &arguments.measure {
        doc.compare.measure = MeasureId(id.clone());
    }
    match arguments.fair.as_deref() {
        Some("time") => doc.compare.fairness = Fairness::Time,
        Some("samples") => doc.compare.fairness = Fairness::Samples,
        Some("lookups") => doc.compare.fairness = Fairness::Lookups,
        _ => {}
    }
    // Before the baseline, whose error may be caused by an unknown estimator.
    if let Some(problem) = estimator::validate(&doc).first() {
        return Err(Failure::Message(problem.to_string()));
    }
    if let Some(wanted) = &arguments.baseline {
        doc.compare.baseline = baseline(&doc, wanted)?;
    }
    Ok(doc)
}

/// Moves the first seed so that no view has the seed of the reference.
fn avoid_seed(doc: &mut SceneDoc, reference: Option<u64>) {
    let Some(taken) = reference else { return };
    if (doc.render.seed..=doc.render.seed.saturating_add(MAX_VIEWS as u64)).contains(&taken) {
        doc.render.seed = taken.checked_add(1).filter(|seed| i64::try_from(*seed).is_ok()).unwrap_or(0);
    }
}

/// Makes these estimators the views, with the other settings of the scene and different seeds.
fn set_views<'a>(doc: &mut SceneDoc, mut estimators: impl Iterator<Item = &'a str>) {
    doc.compare.views.clear();
    doc.compare.baseline = 0;
    if matches!(doc.compare.reference, ReferenceDoc::View { .. }) {
        doc.compare.reference = ReferenceDoc::None;
    }
    if let Some(first) = estimators.next() {
        doc.estimator.id = first.to_owned();
    }
    let first = doc.render.seed;
    for (place, id) in (1u64..).zip(estimators) {
        let Some(mut view) = doc.view_overrides(0) else { return };
        view.estimator.id = id.to_owned();
        let next = first.checked_add(place).filter(|seed| i64::try_from(*seed).is_ok());
        view.seed = next.unwrap_or_else(|| doc.free_seed());
        doc.compare.views.push(view);
    }
}

/// Finds the view with this label, or the first one with this estimator.
fn baseline(doc: &SceneDoc, wanted: &str) -> Result<usize, Failure> {
    let ids: Vec<String> =
        (0..doc.view_count()).filter_map(|v| doc.view_overrides(v)).map(|c| c.estimator.id).collect();
    let by_label = (0..ids.len()).find(|view| label(*view) == wanted);
    by_label.or_else(|| ids.iter().position(|id| id == wanted)).ok_or_else(|| {
        Failure::Message(format!(
            "--baseline {wanted}: not part of the comparison; choose {} or a view from A to {}",
            ids.join(", "),
            label(ids.len() - 1)
        ))
    })
}

/// Returns the command line for the report. If all views have the same number of samples, `--spp` replaces
/// `--seconds`, whose result depends on the machine.
pub(super) fn command(arguments: impl Iterator<Item = String>, experiment: &Experiment) -> String {
    let mut spp = experiment.views.iter().map(|(_, v)| v.snapshot.spp);
    let first = spp.next().unwrap_or_default();
    let equal = spp.all(|spp| spp == first);
    let mut words = vec!["majorant".to_owned()];
    let mut arguments = arguments.peekable();
    while let Some(word) = arguments.next() {
        match word.as_str() {
            "--seconds" if equal => {
                arguments.next();
                words.push(format!("--spp {first}"));
            }
            _ if equal && word.starts_with("--seconds=") => words.push(format!("--spp {first}")),
            _ => words.push(words::quoted(&word)),
        }
    }
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(doc: &SceneDoc) -> Vec<(String, u64)> {
        (0..doc.view_count())
            .filter_map(|v| doc.view_overrides(v))
            .map(|c| (c.estimator.id, c.seed))
            .collect()
    }

    #[test]
    fn every_estimator_gets_a_view_with_its_own_seed() {
        let mut doc = SceneDoc::default();
        doc.render.seed = 7;
        set_views(&mut doc, ["nee", "nee", "independent"].into_iter());
        assert_eq!(ids(&doc), [("nee".into(), 7), ("nee".into(), 8), ("independent".into(), 9)]);
        doc.render.seed = i64::MAX as u64;
        set_views(&mut doc, ["nee", "nee"].into_iter());
        assert_eq!(ids(&doc)[1].1, 0);
    }

    #[test]
    fn views_do_not_share_the_references_random_numbers() {
        let mut doc = SceneDoc::default();
        avoid_seed(&mut doc, Some(2));
        assert_eq!(doc.render.seed, 3);
        avoid_seed(&mut doc, Some(2));
        assert_eq!(doc.render.seed, 3, "already a different seed");
        avoid_seed(&mut doc, None);
        assert_eq!(doc.render.seed, 3);
    }

    #[test]
    fn a_baseline_is_named_by_estimator_or_label() {
        let mut doc = SceneDoc::default();
        set_views(&mut doc, ["nee", "independent"].into_iter());
        assert_eq!([baseline(&doc, "independent").ok(), baseline(&doc, "A").ok()], [Some(1), Some(0)]);
        let Err(Failure::Message(message)) = baseline(&doc, "magic") else {
            panic!("the baseline should have been rejected")
        };
        assert!(message.contains("magic") && message.contains("nee, independent"), "{message}");
    }
}
