//! A person's own scene as a case: nobody knows the answer, so the estimators are held against each other.

use super::{Answer, Case, Layout};
use crate::estimator::REGISTRY;
use crate::io::Library;
use crate::scene::SceneDoc;

/// The longer side of the image that is compared, in pixels: a bias of the estimator shows in small
/// pictures as well as in large ones, and sooner.
const LONGER_SIDE: u32 = 24;

/// A scene of whose answer nothing is known, in blocks of an image that is small enough to be quick.
#[must_use]
pub fn own_scene(name: impl Into<String>, doc: &SceneDoc, library: Library) -> Case {
    let mut doc = doc.clone();
    let (width, height) = (doc.film.width.max(1), doc.film.height.max(1));
    let longer = width.max(height);
    let shrunk = |side: u32| (u64::from(side) * u64::from(LONGER_SIDE) / u64::from(longer)).max(1) as u32;
    if longer > LONGER_SIDE {
        (doc.film.width, doc.film.height) = (shrunk(width), shrunk(height));
    }
    let blocks = |side: u32| (side / 8).clamp(1, 2);
    let layout = Layout { columns: blocks(doc.film.width), rows: blocks(doc.film.height) };
    Case {
        name: name.into(),
        doc,
        layout,
        answer: Answer::Agreement,
        library,
        registry: REGISTRY,
        budget: None,
    }
}
