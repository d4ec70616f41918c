//! Polar angles that stay accurate near 0 and π.

use glam::Vec3;

/// An angle θ from 0 to π, stored as 1 − cos θ and 1 + cos θ. Near 0 and near π the smaller of the two keeps
/// the digits that a cosine would lose to rounding, which narrow scattering lobes depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarAngle {
    /// 1 − cos θ.
    pub one_minus_cos: f32,
    /// 1 + cos θ.
    pub one_plus_cos: f32,
}

impl PolarAngle {
    /// Creates an angle from 1 − cos θ, exact near 0.
    #[must_use]
    #[inline]
    pub fn from_one_minus_cos(one_minus_cos: f32) -> Self {
        Self { one_minus_cos, one_plus_cos: 2.0 - one_minus_cos }
    }

    /// Creates an angle from 1 + cos θ, exact near π.
    #[must_use]
    #[inline]
    pub fn from_one_plus_cos(one_plus_cos: f32) -> Self {
        Self { one_minus_cos: 2.0 - one_plus_cos, one_plus_cos }
    }

    /// Angle between two unit vectors: |a ∓ b|²/2 = 1 ∓ a·b, without cancellation.
    #[must_use]
    #[inline]
    pub fn between(a: Vec3, b: Vec3) -> Self {
        Self { one_minus_cos: 0.5 * (a - b).length_squared(), one_plus_cos: 0.5 * (a + b).length_squared() }
    }

    /// Cosine of θ.
    #[must_use]
    #[inline]
    pub fn cos(&self) -> f32 {
        0.5 * (self.one_plus_cos - self.one_minus_cos)
    }

    /// Sine of θ.
    #[must_use]
    #[inline]
    pub fn sin(&self) -> f32 {
        (self.one_minus_cos * self.one_plus_cos).max(0.0).sqrt()
    }

    /// The angle π − θ.
    #[must_use]
    #[inline]
    pub fn mirrored(&self) -> Self {
        Self { one_minus_cos: self.one_plus_cos, one_plus_cos: self.one_minus_cos }
    }
}
