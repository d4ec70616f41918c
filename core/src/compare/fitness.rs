//! Reasons why a picture cannot be a reference: its mean is wrong, or its noise cannot be told.

use crate::estimator;
use crate::film::Snapshot;
use crate::scene::SceneDoc;

/// Why the estimate of a document cannot be a reference, by the document alone: a bias, or a variance without bound.
#[must_use]
pub fn unfit_document(doc: &SceneDoc) -> Option<&'static str> {
    let entry = estimator::find(&doc.estimator.id)?;
    entry.bias(doc).or_else(|| (entry.infinite_variance)(doc))
}

/// Why a picture cannot be a reference: by its document, or because samples that are not finite were left out of it.
#[must_use]
pub fn unfit_picture(doc: &SceneDoc, snapshot: &Snapshot) -> Option<&'static str> {
    let lost = (snapshot.tally.non_finite > 0).then_some(LOST);
    unfit_document(doc).or(lost)
}

/// What leaving samples out does.
pub(super) const LOST: &str = "samples that are not finite were left out of it";
