//! The scenes of a benchmark, with their references.

use super::Arguments;
use crate::cli::{Failure, options, source};
use majorant_core::bench::{Candidate, ReferencePlan, Subject};
use majorant_core::compare;
use majorant_core::estimator::{self, Entry};
use majorant_core::io::{embedded, scene_file};
use std::path::Path;

/// Duration of the reference run, relative to that of a trial.
const REFERENCE_TIMES: f64 = 8.0;
/// Minimum duration of the reference run, in seconds.
const REFERENCE_LEAST: f64 = 4.0;

pub(super) fn load(arguments: &Arguments, estimators: &[&'static Entry]) -> Result<Vec<Subject>, Failure> {
    let mut names = arguments.scenes.clone();
    if names.is_empty() {
        names = embedded::SCENES.iter().map(|scene| scene.name.to_owned()).collect();
    }
    if arguments.reference.is_some() && names.len() != 1 {
        let message = "--reference applies to one scene: name that scene, or omit --reference";
        return Err(Failure::Message(message.into()));
    }
    names.iter().map(|name| subject(name, arguments, estimators)).collect()
}

fn subject(name: &str, arguments: &Arguments, estimators: &[&'static Entry]) -> Result<Subject, Failure> {
    let source = source::load(name)?;
    let doc = scene_file::override_keys(&source.doc, &arguments.set)?;
    let beside = Path::new(name).parent().map(|folder| folder.join("reference.exr"));
    let beside = beside.filter(|file| arguments.reference_seconds.is_none() && file.exists());
    let reference = match arguments.reference.as_ref().or(beside.as_ref()) {
        Some(file) => {
            // Relative to the working directory, not to the scene.
            let file = std::path::absolute(file)?.to_string_lossy().into_owned();
            let (mut library, mut notes) = (source.resources.clone(), Vec::new());
            let reference = compare::open(&file, &doc, &mut library, &mut notes)?;
            options::print_notes(&reference.notices);
            options::print_notes(&notes);
            ReferencePlan::Given(Box::new(reference))
        }
        None => ReferencePlan::Own {
            estimator: estimator::find("uni-nee-mis")
                .ok_or_else(|| Failure::Message("Uni+NEE MIS is missing".into()))?,
            seconds: arguments
                .reference_seconds
                .unwrap_or((REFERENCE_TIMES * arguments.seconds).max(REFERENCE_LEAST)),
        },
    };
    let candidates = estimators.iter().map(|entry| Candidate::of(entry, &doc)).collect();
    Ok(Subject { name: title(name), doc, library: source.resources, candidates, reference })
}

/// Title of a scene: the stem of its file name, or the folder's name for a file called scene.toml.
fn title(name: &str) -> String {
    let path = Path::new(name);
    let stem = path.file_stem().map_or_else(|| name.into(), |s| s.to_string_lossy());
    let folder = path.parent().and_then(Path::file_name).map(|f| f.to_string_lossy());
    match folder {
        Some(folder) if stem == "scene" => folder.into_owned(),
        _ => stem.into_owned(),
    }
}
