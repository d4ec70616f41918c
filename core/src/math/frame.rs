//! Orthonormal frames.

use super::{PolarAngle, sin_cos_turns};
use glam::Vec3;

/// Right-handed orthonormal frame whose z axis is a given unit vector.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    x: Vec3,
    y: Vec3,
    z: Vec3,
}

impl Frame {
    /// Creates a frame about the unit vector `z` (Duff et al. 2017, "Building an orthonormal basis,
    /// revisited").
    #[must_use]
    #[inline]
    pub fn about(z: Vec3) -> Self {
        let sign = 1.0f32.copysign(z.z);
        let a = -1.0 / (sign + z.z);
        let b = z.x * z.y * a;
        Self {
            x: Vec3::new(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
            y: Vec3::new(b, sign + z.y * z.y * a, -z.y),
            z,
        }
    }

    /// The z axis.
    #[must_use]
    #[inline]
    pub fn axis(&self) -> Vec3 {
        self.z
    }

    /// Transforms a vector from frame coordinates to the space of `z`.
    #[must_use]
    #[inline]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    /// Transforms a vector from the space of `z` to frame coordinates.
    #[must_use]
    #[inline]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }

    /// Unit vector at a polar angle from `z` and an azimuth in turns.
    #[must_use]
    #[inline]
    pub fn polar(&self, theta: PolarAngle, turns: f32) -> Vec3 {
        let (sin_phi, cos_phi) = sin_cos_turns(turns);
        let sin = theta.sin();
        self.to_world(Vec3::new(sin * cos_phi, sin * sin_phi, theta.cos())).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_orthonormal_even_at_the_poles() {
        for z in [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::new(0.3, -0.8, -0.52).normalize()] {
            let f = Frame::about(z);
            for (a, b, dot) in
                [(f.x, f.y, 0.0), (f.y, f.z, 0.0), (f.z, f.x, 0.0), (f.x, f.x, 1.0), (f.y, f.y, 1.0)]
            {
                assert!((a.dot(b) - dot).abs() < 1e-6);
            }
            assert!((f.x.cross(f.y) - z).length() < 1e-6);
            let v = Vec3::new(1.0, -2.0, 0.5);
            assert!((f.to_world(f.to_local(v)) - v).length() < 1e-6);
        }
    }
}
