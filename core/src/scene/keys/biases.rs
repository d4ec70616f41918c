//! Rules by which keys bias the estimate, and the corresponding unbiased values.

use crate::scene::{Bookkeeping, Fault, MediumDoc, SceneDoc, WhenExceeded};
use crate::transmittance::TransmittanceKind;

/// Rule by which a key biases the estimate.
#[derive(Debug)]
pub struct Bias {
    /// The rule in words.
    pub when: &'static str,
    /// Whether the rule applies to a document, for an estimator that uses the key.
    pub holds: fn(&SceneDoc) -> bool,
    /// Sets the key to its unbiased value.
    pub undo: fn(&mut SceneDoc),
}

pub(super) static FACTOR: Bias = Bias {
    when: "below 1 where `when_exceeded` is not `weighted`, and under mitsuba2-volpath wherever the medium is not a single uniform one",
    holds: |doc| {
        let uniform = doc.enabled_media().count() == 1 && doc.enabled_media().all(MediumDoc::is_uniform);
        let tracked = doc.estimator.id == "mitsuba2-volpath" && !uniform;
        doc.enabled_media().any(|medium| {
            let majorant = &medium.majorant;
            majorant.factor < 1.0 && (majorant.when_exceeded != WhenExceeded::Weighted || tracked)
        })
    },
    undo: |doc| {
        for medium in &mut doc.media {
            medium.majorant.factor = medium.majorant.factor.max(1.0);
        }
    },
};

pub(super) static CLAMPED: Bias = Bias {
    when: "`clamp`, and `progressive` until bounds have been raised, where `factor` is below 1",
    holds: |doc| {
        doc.enabled_media()
            .map(|medium| &medium.majorant)
            .any(|majorant| majorant.factor < 1.0 && majorant.when_exceeded != WhenExceeded::Weighted)
    },
    undo: |doc| {
        for medium in &mut doc.media {
            medium.majorant.when_exceeded = WhenExceeded::Weighted;
        }
    },
};

pub(super) static ESTIMATOR: Bias = Bias {
    when: "mitsuba2-volpath where a medium emits",
    holds: |doc| {
        doc.estimator.id == "mitsuba2-volpath" && doc.enabled_media().any(|medium| medium.emission.is_some())
    },
    // The estimator of a reference is a choice: one that is biased nevertheless is rejected.
    undo: |_| (),
};

pub(super) static FAULT: Bias = Bias {
    when: "every value except `none`, under Uni+NEE MIS",
    holds: |doc| doc.estimator.fault != Fault::None,
    undo: |doc| doc.estimator.fault = Fault::None,
};

pub(super) static OVERFLOW: Bias = Bias {
    when: "`apart-f32`, under Uni+NEE MIS: samples that overflow are dropped",
    holds: |doc| doc.estimator.bookkeeping == Bookkeeping::ApartF32,
    undo: |doc| {
        if doc.estimator.bookkeeping == Bookkeeping::ApartF32 {
            doc.estimator.bookkeeping = Bookkeeping::Rescaled;
        }
    },
};

pub(super) static MARCHED: Bias = Bias {
    when: "`marching`, under estimators that use this transmittance estimator",
    holds: marches,
    undo: |doc| {
        if marches(doc) {
            TransmittanceKind::ALONG_THE_PATH.entry().id.clone_into(&mut doc.estimator.transmittance);
        }
    },
};

fn marches(doc: &SceneDoc) -> bool {
    TransmittanceKind::find(&doc.estimator.transmittance).is_some_and(|kind| !kind.entry().unbiased)
}

impl SceneDoc {
    /// Returns the document with every key that can bias the estimate at its unbiased value. Keys that the
    /// expected image depends on stay, and so does the estimator. References are rendered from this document.
    #[must_use]
    pub fn unbiased(&self) -> Self {
        let mut doc = self.clone();
        for bias in super::all().iter().filter(|key| !key.path.contains('*')).filter_map(|key| key.biases) {
            (bias.undo)(&mut doc);
        }
        doc
    }
}
