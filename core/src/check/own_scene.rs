//! A user's own scene as a case. No answer is known, so that the estimators are compared with each other.

use super::{Answer, Case, Layout};
use crate::estimator::REGISTRY;
use crate::io::Library;
use crate::scene::SceneDoc;

/// Longer side of the compared image in pixels: a bias shows in small images as well as in large ones, and in
/// less time.
const LONGER_SIDE: u32 = 24;

/// Creates a case without a known answer from a scene, with a small image so that it is quick.
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
