//! Estimators of transmittance T = exp(−∫μ(t) dt) along a ray, one file each.
//!
//! ```text
//!   Profile (extinction, majorant pieces)  ──►  TransmittanceKind::estimate  ──►  Estimate (T per component, look-ups)
//!     InMedium: a ray through a medium              one technique per file
//!     Analytic: closed forms for tests
//! ```
//!
//! A line in [`techniques!`](TransmittanceKind) adds one: tests, benchmark and table iterate over
//! [`TransmittanceKind::all`]. All code is monomorphic, on the stack, and a function of the sampler's
//! numbers.
//!
//! A ray has several components (wavelengths, channels), and every look-up serves all of them. Positions are
//! drawn from the *largest* component's majorant, so that every component's weight stays bounded; only
//! [`HeroRatioTracking`] draws from the hero's majorant, as the walk of a path does.

mod analytic;
mod comb;
mod delta;
mod flight;
mod hero_ratio;
mod in_medium;
mod marching;
mod power_series;
mod profile;
mod ratio;
mod residual_ratio;
mod technique;
mod unbiased_marching;

#[cfg(test)]
mod tests;

pub use analytic::{Analytic, AnalyticPieces, Shape};
pub use delta::DeltaTracking;
pub use hero_ratio::HeroRatioTracking;
pub use in_medium::{InMedium, Pieces};
pub use marching::{Marching, Offset};
pub use power_series::PowerSeries;
pub use profile::{Piece, Profile};
pub use ratio::RatioTracking;
pub use residual_ratio::ResidualRatioTracking;
pub use technique::{Entry, Estimate, Technique};
pub use unbiased_marching::UnbiasedMarching;

use crate::math::Sampler;

macro_rules! techniques {
    ($($name:ident),+ $(,)?) => {
        /// A technique with its settings, to be matched once before a monomorphic loop.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum TransmittanceKind {
            $(#[doc = concat!("The technique [`", stringify!($name), "`] with its settings.")] $name($name)),+
        }

        impl TransmittanceKind {
            /// All techniques with default settings, in the order shown by pickers.
            #[must_use]
            pub fn all() -> Vec<Self> {
                vec![$(Self::$name($name::default())),+]
            }

            /// Description of the technique.
            #[must_use]
            pub const fn entry(&self) -> Entry {
                match self {
                    $(Self::$name(_) => $name::ENTRY),+
                }
            }

            /// Draws one estimate of the transmittance along `profile`.
            #[inline]
            pub fn estimate<P: Profile<N>, const N: usize>(
                &self,
                profile: &P,
                sampler: &mut Sampler,
            ) -> Estimate<N> {
                match self {
                    $(Self::$name(technique) => technique.estimate(profile, sampler)),+
                }
            }
        }
    };
}

techniques! {
    DeltaTracking,
    RatioTracking,
    HeroRatioTracking,
    ResidualRatioTracking,
    PowerSeries,
    UnbiasedMarching,
    Marching,
}

impl TransmittanceKind {
    /// The estimator of a walk along the path itself, whose densities multiple importance sampling needs.
    pub const ALONG_THE_PATH: Self = Self::HeroRatioTracking(HeroRatioTracking);

    /// Finds the technique with this id, with default settings.
    #[must_use]
    pub fn find(id: &str) -> Option<Self> {
        Self::all().into_iter().find(|kind| kind.entry().id == id)
    }
}
