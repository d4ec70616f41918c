//! Majorants, from which free flights are sampled.

use crate::spectrum::{Components, Sampled, Spectrum};
use serde::{Deserialize, Serialize};

/// Majorant μ̄: resolution of the local bounds of the extinction, and the factor applied to them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MajorantDoc {
    /// Factor on the bounds: 1 is tight, larger values add null collisions, below 1 μ̄ no longer bounds the
    /// extinction.
    pub factor: f32,
    /// Whether all wavelengths share the largest majorant.
    pub shared: bool,
    /// Treatment of points where the extinction exceeds the majorant.
    pub when_exceeded: WhenExceeded,
    /// Cells per axis of the grid of local bounds, 1 to 128; 1 is a global majorant. Absent: the cheapest
    /// resolution for free flights.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<u32>,
}

impl Default for MajorantDoc {
    fn default() -> Self {
        Self { factor: 1.0, shared: false, when_exceeded: WhenExceeded::Weighted, resolution: None }
    }
}

/// Treatment of points where the extinction exceeds the majorant (factor below 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WhenExceeded {
    /// The null coefficient becomes negative; unbiased, but the variance grows exponentially with the optical
    /// depth by which the majorant is exceeded.
    #[default]
    Weighted,
    /// The null coefficient is clamped at zero, which limits the extinction to the majorant: **biased**, the
    /// common mistake.
    Clamp,
    /// Clamped, but the bounds of cells in which flights found a violation are raised to the observed maximum
    /// once every pixel has 1, 2, 4, 8, … samples (Misso et al. 2023, "Progressive null-tracking for
    /// volumetric rendering"): **consistent**, since the fraction of samples before the last raise vanishes.
    /// Wins where no bound is known, or a known one is far too loose.
    Progressive,
}

/// Segment of a ray with one majorant μ̄ per component.
#[derive(Clone, Copy, Debug)]
pub struct MajorantSegment<const N: usize> {
    /// Ray parameter at its start.
    pub t0: f32,
    /// Ray parameter at its end.
    pub t1: f32,
    /// μ̄ per component and scene unit.
    pub majorant: Sampled<N>,
    /// Whether null coefficients are clamped at zero where μt > μ̄: **biased**.
    pub clamp_null: bool,
    /// Whether the extinction may exceed the majorant, so that violations have to be detected.
    pub watched: bool,
}

/// Safety factor for rounding: (a / b) · b may be less than a.
pub(super) const ROUNDED_UP: f32 = 1.0 + 4.0 * f32::EPSILON;

/// Relation of the majorant to the least upper bound of the extinction.
#[derive(Clone, Copy, Debug)]
pub struct MajorantPolicy {
    factor: f32,
    shared: bool,
    clamp_null: bool,
    progressive: bool,
}

impl MajorantPolicy {
    /// Freezes the editable settings.
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

    /// Returns whether the extinction may exceed the majorant.
    #[must_use]
    pub fn is_watched(&self) -> bool {
        self.factor < 1.0
    }

    /// Returns whether bounds are raised where they are found to be exceeded.
    #[must_use]
    pub fn is_progressive(&self) -> bool {
        self.progressive
    }

    /// Returns the policy with all majorants multiplied by `quotient`.
    #[must_use]
    pub(super) fn raised(self, quotient: f32) -> Self {
        Self { factor: self.factor * quotient * ROUNDED_UP, ..self }
    }

    /// Majorant of a medium whose extinction is bounded by `bound(λ)`.
    #[must_use]
    pub fn of<const N: usize, C: Components<N>>(&self, components: &C, bound: &Spectrum) -> Sampled<N> {
        if self.shared {
            // In RGB mode the wavelengths are the three channels.
            Sampled::splat(bound.largest() * self.factor)
        } else {
            components.evaluate(bound) * self.factor
        }
    }

    /// Majorant for a `bound` at the components of a path, whose maximum over all wavelengths is `largest`.
    #[must_use]
    #[inline]
    pub fn of_bound<const N: usize>(&self, bound: Sampled<N>, largest: f32) -> Sampled<N> {
        if self.shared { Sampled::splat(largest * self.factor) } else { bound * self.factor }
    }

    /// Creates a majorant segment.
    #[must_use]
    #[inline]
    pub fn segment<const N: usize>(&self, majorant: Sampled<N>, t0: f32, t1: f32) -> MajorantSegment<N> {
        MajorantSegment { t0, t1, majorant, clamp_null: self.clamp_null, watched: self.is_watched() }
    }
}
