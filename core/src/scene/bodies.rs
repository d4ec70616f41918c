//! Transparent bodies: which of them is at a point.
//!
//! Of all dielectrics around a point only that of highest priority is there, with its refractive index and its
//! media. Boundaries, index and media are functions of the point alone, never of how a path has reached it. A
//! crossing that leaves the body unchanged is no event. Faces of two bodies that coincide are crossed together.

use crate::spectrum::Spectrum;
use crate::surface::Solid;
use glam::Vec3;
use std::sync::Arc;

/// A transparent body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Shape.
    pub solid: Arc<Solid>,
    /// Rank: where bodies overlap, the highest is there.
    pub priority: i32,
    /// Refractive index.
    pub ior: Spectrum,
}

/// All transparent bodies of a scene.
#[derive(Clone, Debug, Default)]
pub struct Bodies(pub Vec<Body>);

/// Bodies in front of a boundary and behind it; `None` outside all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crossing {
    /// Body on the side on which the path arrives.
    pub before: Option<u32>,
    /// Body on the other side.
    pub after: Option<u32>,
}

impl Crossing {
    /// No body on either side.
    pub const NONE: Self = Self { before: None, after: None };
}

impl Bodies {
    /// The crossing at a point on the surface of `body`. `side` is the unit normal on the side on which the
    /// path arrives, `enters` whether that is outside, and `error` the error of the position.
    #[must_use]
    pub fn crossing(&self, body: u32, point: Vec3, side: Vec3, error: f32, enters: bool) -> Crossing {
        let [near, far] = [point + side * (2.0 * error), point - side * (2.0 * error)];
        Crossing { before: self.at(near, (body, !enters)), after: self.at(far, (body, enters)) }
    }

    /// The body at a point, given whether one of them is around it.
    fn at(&self, point: Vec3, (known, is_inside): (u32, bool)) -> Option<u32> {
        let around = (0..)
            .zip(&self.0)
            .filter(|(index, body)| if *index == known { is_inside } else { body.solid.contains(point) });
        around.max_by_key(|(_, body)| body.priority).map(|(index, _)| index)
    }
}
