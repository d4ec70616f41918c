//! Majorants: what free flights are sampled from.

use crate::spectrum::{Components, Sampled, Spectrum};
use serde::{Deserialize, Serialize};

/// The majorant μ̄: how finely the extinction is bounded from above, and how it relates to those bounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MajorantDoc {
    /// 1 is tight; above it null collisions are added; below it μ̄ no longer bounds the extinction.
    pub factor: f32,
    /// Every wavelength gets the largest wavelength's majorant.
    pub shared: bool,
    /// What happens where the extinction exceeds the majorant.
    pub when_exceeded: WhenExceeded,
    /// Cells per axis of the grid of local bounds, 1 to 128; 1 is one global majorant. Absent: what is cheapest
    /// to fly through.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<u32>,
}

impl Default for MajorantDoc {
    fn default() -> Self {
        Self { factor: 1.0, shared: false, when_exceeded: WhenExceeded::Weighted, resolution: None }
    }
}

/// What happens where the extinction exceeds the majorant (factor below 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WhenExceeded {
    /// The null coefficient turns negative; unbiased, but the variance grows exponentially with the
    /// optical depth by which the majorant is exceeded.
    #[default]
    Weighted,
    /// The null coefficient is clamped at zero, which cuts the medium off at the majorant: **biased**,
    /// the textbook mistake.
    Clamp,
    /// Clamped, but wherever a flight finds the majorant exceeded the cell's bound is raised to what was found, once
    /// every pixel has 1, 2, 4, 8, … samples (Misso et al. 2023, "Progressive null-tracking for volumetric rendering"):
    /// **consistent**, since the share of samples that came before the last raise vanishes. Wins where no bound is
    /// known, or a known one is far too loose.
    Progressive,
}

/// A stretch of a ray with one majorant μ̄ per component.
#[derive(Clone, Copy, Debug)]
pub struct MajorantSegment<const N: usize> {
    /// Ray parameter at which it begins.
    pub t0: f32,
    /// Ray parameter at which it ends.
    pub t1: f32,
    /// μ̄ per component and scene unit.
    pub majorant: Sampled<N>,
    /// Whether null coefficients are clamped at zero where μt > μ̄: **biased**.
    pub clamp_null: bool,
    /// Whether the extinction may exceed the majorant, so that it has to be looked for.
    pub watched: bool,
}

/// A quotient of two rounded numbers, times one of them, may fall short of the other.
pub(super) const ROUNDED_UP: f32 = 1.0 + 4.0 * f32::EPSILON;

/// How the majorant relates to the least upper bound of the extinction.
#[derive(Clone, Copy, Debug)]
pub struct MajorantPolicy {
    factor: f32,
    shared: bool,
    clamp_null: bool,
    progressive: bool,
}

impl MajorantPolicy {
    /// Freezes the edited choice.
    #[must_use]
    pub fn new(doc: &MajorantDoc) -> Self {
        let progressive = doc.when_exceeded == WhenExceeded::Progressive;
        let clamp_null = progressive || doc.when_exceeded == WhenExceeded::Clamp;
        Self {
            factor: doc.factor,
            shared: doc.shared,
            clamp_null,
            progressive: progressive && doc.factor < 1.0,
        }
    }

    /// Whether the extinction may exceed the majorant.
    #[must_use]
    pub fn is_watched(&self) -> bool {
        self.factor < 1.0
    }

    /// Whether bounds are to be raised where they are found to be exceeded.
    #[must_use]
    pub fn is_progressive(&self) -> bool {
        self.progressive
    }

    /// The same with all majorants `quotient` times as large.
    #[must_use]
    pub(super) fn raised(self, quotient: f32) -> Self {
        Self { factor: self.factor * quotient * ROUNDED_UP, ..self }
    }

    /// The majorant of a medium whose extinction is bounded by `bound(λ)`.
    #[must_use]
    pub fn of<const N: usize, C: Components<N>>(&self, components: &C, bound: &Spectrum) -> Sampled<N> {
        if self.shared {
            // In RGB mode the wavelengths are the three channels.
            Sampled::splat(bound.largest() * self.factor)
        } else {
            components.evaluate(bound) * self.factor
        }
    }

    /// The majorant where the extinction is bounded by `bound` at a path's components, and by `largest` at all.
    #[must_use]
    #[inline]
    pub fn of_bound<const N: usize>(&self, bound: Sampled<N>, largest: f32) -> Sampled<N> {
        if self.shared { Sampled::splat(largest * self.factor) } else { bound * self.factor }
    }

    /// A segment of the walk.
    #[must_use]
    #[inline]
    pub fn segment<const N: usize>(&self, majorant: Sampled<N>, t0: f32, t1: f32) -> MajorantSegment<N> {
        MajorantSegment { t0, t1, majorant, clamp_null: self.clamp_null, watched: self.is_watched() }
    }
}
