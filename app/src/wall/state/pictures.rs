//! The pictures that hang, and which numbers describe them.

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

/// Whole pixels when enlarged: the numbers are per pixel, and so is the noise.
const TEXTURE: TextureOptions = TextureOptions {
    magnification: TextureFilter::Nearest,
    minification: TextureFilter::Linear,
    ..TextureOptions::LINEAR
};

/// A print on the graphics card.
pub struct UploadedImage {
    /// The pixels.
    pub texture: TextureHandle,
    /// The numbers behind them; absent for the reference.
    pub snapshot: Option<Arc<Snapshot>>,
    /// What it shows, if it is a map.
    pub map: Option<Arc<MapImage>>,
    /// The session's view, if it is one's.
    id: Option<ViewId>,
    /// The reference, if it is that.
    pub reference: Option<Arc<Reference>>,
}

impl Wall {
    pub(super) fn upload(&mut self, ctx: &Context, picture: PictureId, print: ViewImage) {
        let ViewImage { image, snapshot, id, reference, map } = print;
        // It may have been ordered before the views changed their places.
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

    /// Pictures move with their views.
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

    /// A picture on the wall; none if what hangs is a map that is not wanted now.
    #[must_use]
    pub fn uploaded(&self, picture: PictureId) -> Option<&UploadedImage> {
        let wanted = self.map().map(|map| map.id);
        self.uploaded.get(&picture).filter(|uploaded| {
            // What was the reference is none any more once there is another, or none yet.
            if picture == PictureId::Reference && !self.reference.is_source_of(uploaded.reference.as_ref()) {
                return false;
            }
            let map = uploaded.map.as_ref().map(|print| print.map.id);
            map.is_none() || map == wanted || wanted.is_none()
        })
    }

    /// What numbers would describe now.
    pub(super) fn provenance(&self) -> Provenance {
        let shown = |(view, slot): (usize, &Slot)| {
            let current = slot.state.generation;
            // A picture of an older submission may hang for a moment: then nothing describes it and its document.
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

    /// Brings what is shown in line with what it depends on.
    pub(super) fn refresh(&mut self, session: &Session) {
        let target = self.target();
        self.reference.update(&self.doc, &self.slots, target.as_deref(), session);
        self.analysis = Arc::new(self.newest.matching(&self.provenance()));
    }
}
