//! Uploaded textures, and the provenance of the statistics that describe them.

use super::super::provenance::Provenance;
use super::super::slot::Slot;
use super::Wall;
use crate::view::tone_mapper::{MapImage, PictureId, ViewImage};
use egui::{Context, TextureFilter, TextureHandle, TextureOptions};
use majorant_core::compare::Reference;
use majorant_core::film::Snapshot;
use majorant_core::session::{Session, ViewId};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Nearest-neighbour magnification, so that single pixels and their noise are visible.
const TEXTURE: TextureOptions = TextureOptions {
    magnification: TextureFilter::Nearest,
    minification: TextureFilter::Linear,
    ..TextureOptions::LINEAR
};

/// An image that is uploaded as a texture.
pub struct UploadedImage {
    /// The texture.
    pub texture: TextureHandle,
    /// Snapshot of the view from which it was made; `None` for the reference.
    pub snapshot: Option<Arc<Snapshot>>,
    /// Values of the map that it shows.
    pub map: Option<Arc<MapImage>>,
    /// Session id of the view that it shows.
    id: Option<ViewId>,
    /// The reference that it shows.
    pub reference: Option<Arc<Reference>>,
}

impl Wall {
    pub(super) fn upload(&mut self, ctx: &Context, picture: PictureId, image: ViewImage) {
        let ViewImage { image, snapshot, id, reference, map } = image;
        // The image may have been requested before the views were reordered.
        if let PictureId::View(view) = picture
            && self.slots.get(view).map(|slot| slot.id) != id
        {
            return;
        }
        let texture = match self.uploaded.remove(&picture) {
            Some(UploadedImage { mut texture, .. }) => {
                texture.set(image, TEXTURE);
                texture
            }
            None => ctx.load_texture(format!("{picture:?}"), image, TEXTURE),
        };
        self.uploaded.insert(picture, UploadedImage { texture, snapshot, map, id, reference });
    }

    /// Reorders the textures after their views were reordered.
    pub(super) fn rehang(&mut self) {
        let views = |picture: &PictureId| matches!(picture, PictureId::View(_));
        let (uploaded, rest): (BTreeMap<_, UploadedImage>, _) =
            std::mem::take(&mut self.uploaded).into_iter().partition(|(picture, _)| views(picture));
        self.uploaded = rest;
        for (_, uploaded) in uploaded {
            if let Some(view) = self.slots.iter().position(|slot| Some(slot.id) == uploaded.id) {
                self.uploaded.insert(PictureId::View(view), uploaded);
            }
        }
    }

    /// Uploaded image; `None` if it is a map other than the current one, or of an earlier reference.
    #[must_use]
    pub fn uploaded(&self, picture: PictureId) -> Option<&UploadedImage> {
        let wanted = self.map().map(|map| map.id);
        self.uploaded.get(&picture).filter(|uploaded| {
            // The texture may show an earlier reference.
            if picture == PictureId::Reference && !self.reference.is_source_of(uploaded.reference.as_ref()) {
                return false;
            }
            let map = uploaded.map.as_ref().map(|image| image.map.id);
            map.is_none() || map == wanted || wanted.is_none()
        })
    }

    /// Provenance of the images shown.
    pub(super) fn provenance(&self) -> Provenance {
        let shown = |(view, slot): (usize, &Slot)| {
            let current = slot.state.generation;
            // While the texture of an older submission is shown, no statistics are valid for the view.
            let uploaded = self.uploaded.get(&PictureId::View(view)).and_then(|h| h.snapshot.as_ref());
            uploaded.is_none_or(|uploaded| uploaded.generation == current).then_some(current)
        };
        Provenance {
            views: self.slots.iter().enumerate().map(shown).collect(),
            reference: self.reference.identity(&self.doc),
            region: self.doc.compare.region,
            baseline: self.doc.compare.baseline,
        }
    }

    /// Updates the reference and the valid statistics.
    pub(super) fn refresh(&mut self, session: &Session) {
        let target = self.target();
        self.reference.update(&self.doc, &self.slots, target.as_deref(), session);
        self.analysis = Arc::new(self.newest.matching(&self.provenance()));
    }
}
