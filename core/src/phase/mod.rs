//! Phase functions: which way light scatters.
//!
//! **Direction convention, for the whole program:** both directions are directions of *propagation*,
//! `omega_in` before and `omega_out` after the event, so that `cos θ = omega_in · omega_out` and
//! g > 0 scatters forward. Values are per steradian and integrate to 1 over the sphere; every phase
//! function here is sampled exactly, so that its value is also its density.

mod doc;
mod henyey_greenstein;
mod isotropic;
mod rayleigh;
mod two_lobe;

use crate::math::{Frame, PolarAngle};
pub use doc::PhaseDoc;

use glam::{Vec2, Vec3};
use henyey_greenstein::HenyeyGreenstein;
use isotropic::Isotropic;
use rayleigh::Rayleigh;
use two_lobe::TwoLobe;

/// The contract of one phase function.
trait Lobe {
    /// Value and density, per steradian.
    fn value(&self, theta: PolarAngle) -> f32;
    /// Draws the scattering angle from a number uniform in [0, 1).
    fn sample(&self, u: f32) -> PolarAngle;
}

/// A phase function, ready to be evaluated and sampled.
#[derive(Clone, Copy, Debug)]
pub struct Phase(Kind);

#[derive(Clone, Copy, Debug)]
enum Kind {
    Isotropic(Isotropic),
    HenyeyGreenstein(HenyeyGreenstein),
    TwoLobe(TwoLobe),
    Rayleigh(Rayleigh),
}

macro_rules! each {
    ($self:ident, $lobe:ident => $body:expr) => {
        match &$self.0 {
            Kind::Isotropic($lobe) => $body,
            Kind::HenyeyGreenstein($lobe) => $body,
            Kind::TwoLobe($lobe) => $body,
            Kind::Rayleigh($lobe) => $body,
        }
    };
}

impl Phase {
    /// Freezes an edited phase function, whose parameters validation has checked.
    #[must_use]
    pub fn new(doc: &PhaseDoc) -> Self {
        Self(match *doc {
            PhaseDoc::Isotropic {} => Kind::Isotropic(Isotropic),
            PhaseDoc::HenyeyGreenstein { g } => Kind::HenyeyGreenstein(HenyeyGreenstein { g }),
            PhaseDoc::TwoLobe { g_forward, g_backward, forward } => Kind::TwoLobe(TwoLobe {
                first: HenyeyGreenstein { g: g_forward },
                second: HenyeyGreenstein { g: g_backward },
                share: forward,
            }),
            PhaseDoc::Rayleigh {} => Kind::Rayleigh(Rayleigh),
        })
    }

    /// Value by the cosine of the scattering angle, per steradian: to draw the lobe with.
    #[must_use]
    pub fn value(&self, cosine: f32) -> f32 {
        let theta = PolarAngle { one_minus_cos: 1.0 - cosine, one_plus_cos: 1.0 + cosine };
        self.at(theta)
    }

    fn at(&self, theta: PolarAngle) -> f32 {
        each!(self, lobe => lobe.value(theta))
    }

    /// Value and density of scattering from `omega_in` to `omega_out`, per steradian.
    #[must_use]
    pub fn density(&self, omega_in: Vec3, omega_out: Vec3) -> f32 {
        self.at(PolarAngle::between(omega_in, omega_out))
    }

    /// Draws the direction after scattering; its density is [`Self::density`].
    #[must_use]
    pub fn sample(&self, omega_in: Vec3, u: Vec2) -> (Vec3, f32) {
        let theta = each!(self, lobe => lobe.sample(u.x));
        let direction = Frame::about(omega_in).polar(theta, u.y);
        (direction, self.at(theta))
    }
}
