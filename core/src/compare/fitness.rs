//! Reasons why an image cannot serve as a reference: bias or unknown noise.

use crate::estimator;
use crate::film::Snapshot;
use crate::scene::SceneDoc;

/// Reason why an estimate of a document cannot serve as a reference: bias or infinite variance.
#[must_use]
pub fn unfit_document(doc: &SceneDoc) -> Option<&'static str> {
    let entry = estimator::find(&doc.estimator.id)?;
    entry.bias(doc).or_else(|| (entry.infinite_variance)(doc))
}

/// Reason why an image cannot serve as a reference: its document, or excluded non-finite samples.
#[must_use]
pub fn unfit_picture(doc: &SceneDoc, snapshot: &Snapshot) -> Option<&'static str> {
    let lost = (snapshot.tally.non_finite > 0).then_some(LOST);
    unfit_document(doc).or(lost)
}

/// Reason for an image from which samples were excluded.
pub(super) const LOST: &str = "samples that are not finite were left out of it";
