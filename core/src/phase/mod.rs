//! Phase functions: angular distributions of scattered light.
//!
//! **Direction convention, for the whole program:** both directions are directions of *propagation*,
//! `omega_in` before and `omega_out` after the event, so that `cos θ = omega_in · omega_out` and
//! g > 0 scatters forward. Values are per steradian and integrate to 1 over the sphere; every phase
//! function here is sampled exactly, so that its value is also its density.

mod doc;
mod draine;
mod henyey_greenstein;
mod isotropic;
mod mie;
mod rayleigh;
mod table;
mod two_lobe;

use crate::math::{Frame, PolarAngle};
pub use doc::{Kind as PhaseKind, Parameter, PhaseDoc};
pub use table::{Angle, MAX_POINTS, TableError, check as check_table};

use draine::Draine;
use glam::{Vec2, Vec3};
use henyey_greenstein::HenyeyGreenstein;
use isotropic::Isotropic;
use mie::Mie;
use rayleigh::Rayleigh;
use table::Table;
use two_lobe::TwoLobe;

/// Interface of a phase function.
trait Lobe {
    /// Value and density, per steradian.
    fn value(&self, theta: PolarAngle) -> f32;
    /// Draws the scattering angle from a number uniform in [0, 1).
    fn sample(&self, u: f32) -> PolarAngle;
    /// Mean cosine ∫ p cos θ dω.
    fn mean_cosine(&self) -> f32;
}

/// Phase function, ready to be evaluated and sampled.
#[derive(Clone, Debug)]
pub struct Phase {
    kind: Kind,
    mean_cosine: f32,
}

#[derive(Clone, Debug)]
enum Kind {
    Isotropic(Isotropic),
    HenyeyGreenstein(HenyeyGreenstein),
    TwoLobe(TwoLobe),
    Rayleigh(Rayleigh),
    Draine(Draine),
    Mie(Mie),
    Table(Table),
}

macro_rules! each {
    ($self:ident, $lobe:ident => $body:expr) => {
        match &$self.kind {
            Kind::Isotropic($lobe) => $body,
            Kind::HenyeyGreenstein($lobe) => $body,
            Kind::TwoLobe($lobe) => $body,
            Kind::Rayleigh($lobe) => $body,
            Kind::Draine($lobe) => $body,
            Kind::Mie($lobe) => $body,
            Kind::Table($lobe) => $body,
        }
    };
}

impl Phase {
    /// Builds the phase function of a document. Validation has checked its parameters, and a table in a file
    /// has been read into it. An invalid table is replaced by the isotropic phase function.
    #[must_use]
    pub fn new(doc: &PhaseDoc) -> Self {
        let kind = match doc {
            PhaseDoc::Isotropic {} => Kind::Isotropic(Isotropic),
            PhaseDoc::HenyeyGreenstein { g } => Kind::HenyeyGreenstein(HenyeyGreenstein { g: *g }),
            PhaseDoc::TwoLobe { g_forward, g_backward, forward } => Kind::TwoLobe(TwoLobe {
                first: HenyeyGreenstein { g: *g_forward },
                second: HenyeyGreenstein { g: *g_backward },
                share: *forward,
            }),
            PhaseDoc::Rayleigh {} => Kind::Rayleigh(Rayleigh),
            PhaseDoc::Draine { g, alpha } => Kind::Draine(Draine::new(*g, *alpha)),
            PhaseDoc::Mie { diameter_um } => Kind::Mie(Mie::new(*diameter_um)),
            PhaseDoc::Tabulated { angle, points, .. } => {
                Table::new(*angle, points).map_or(Kind::Isotropic(Isotropic), Kind::Table)
            }
        };
        let mut phase = Self { kind, mean_cosine: 0.0 };
        phase.mean_cosine = each!(phase, lobe => lobe.mean_cosine());
        phase
    }

    /// Mean cosine ∫ p cos θ dω.
    #[must_use]
    #[inline]
    pub fn mean_cosine(&self) -> f32 {
        self.mean_cosine
    }

    /// Value at a cosine of the scattering angle, per steradian; for plots of the lobe.
    #[must_use]
    #[inline]
    pub fn value(&self, cosine: f32) -> f32 {
        let theta = PolarAngle { one_minus_cos: 1.0 - cosine, one_plus_cos: 1.0 + cosine };
        self.at(theta)
    }

    fn at(&self, theta: PolarAngle) -> f32 {
        each!(self, lobe => lobe.value(theta))
    }

    /// Value and density of scattering from `omega_in` to `omega_out`, per steradian.
    #[must_use]
    #[inline]
    pub fn density(&self, omega_in: Vec3, omega_out: Vec3) -> f32 {
        self.at(PolarAngle::between(omega_in, omega_out))
    }

    /// Draws the direction after scattering and returns it with its density, which is [`Self::density`].
    #[must_use]
    #[inline]
    pub fn sample(&self, omega_in: Vec3, u: Vec2) -> (Vec3, f32) {
        let theta = each!(self, lobe => lobe.sample(u.x));
        let direction = Frame::about(omega_in).polar(theta, u.y);
        (direction, self.at(theta))
    }
}
