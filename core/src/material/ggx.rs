//! Rough surfaces: GGX microfacets with Smith's masking and shadowing (Walter, Marschner, Li & Torrance 2007).
//!
//! Directions are in the frame of the surface, with the normal along +z, and point away from it. Normals are drawn
//! in proportion to how much of them is visible (Heitz 2018; by a spherical cap, Dupuy & Benyoub 2023), so that a
//! weight is a ratio of masking functions and never exceeds one.

use glam::{Vec2, Vec3};
use std::f32::consts::PI;

/// Below this roughness a surface is smooth: lobes would be narrower than single precision resolves.
pub const SMOOTH: f32 = 1e-3;

/// Isotropic GGX distribution of microfacet normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    /// Width α of the distribution: the root mean square slope, roughly.
    pub alpha: f32,
}

impl Ggx {
    /// Density of microfacet normals D(m), per steradian and area of the surface.
    #[must_use]
    #[inline]
    pub fn density(self, m: Vec3) -> f32 {
        let a2 = self.alpha * self.alpha;
        // cos² (α² − 1) + 1 as sin² + α² cos², which keeps its digits for narrow lobes.
        let d = m.x * m.x + m.y * m.y + a2 * m.z * m.z;
        a2 / (PI * d * d)
    }

    /// Smith's auxiliary function Λ(ω).
    #[inline]
    fn lambda(self, w: Vec3) -> f32 {
        let tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
        0.5 * ((1.0 + self.alpha * self.alpha * tan2).sqrt() - 1.0)
    }

    /// Masking function G₁(ω).
    #[must_use]
    #[inline]
    pub fn masking(self, w: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(w))
    }

    /// Masking and shadowing G(ωo, ωi), correlated by height, for directions on the same side.
    #[must_use]
    #[inline]
    pub fn masking_shadowing(self, wo: Vec3, wi: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(wo) + self.lambda(wi))
    }

    /// Density of the normals that are visible from ωo: G₁(ωo) max(0, ωo·m) D(m) / cos θo.
    #[must_use]
    #[inline]
    pub fn visible_density(self, wo: Vec3, m: Vec3) -> f32 {
        self.masking(wo) * wo.dot(m).max(0.0) * self.density(m) / wo.z.abs().max(f32::MIN_POSITIVE)
    }

    /// Draws a normal with density [`Self::visible_density`], for ωo above the surface.
    #[must_use]
    #[inline]
    pub fn draw(self, wo: Vec3, u: Vec2) -> Vec3 {
        let stretched = Vec3::new(self.alpha * wo.x, self.alpha * wo.y, wo.z).normalize();
        // Uniform on the cap of reflected directions.
        let z = (1.0 - u.x) * (1.0 + stretched.z) - stretched.z;
        let r = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (2.0 * PI * u.y).sin_cos();
        let h = Vec3::new(r * cos, r * sin, z) + stretched;
        Vec3::new(self.alpha * h.x, self.alpha * h.y, h.z.max(f32::MIN_POSITIVE)).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn directions(count: usize) -> impl Iterator<Item = (Vec3, f32)> {
        let step = 1.0 / count as f32;
        (0..count * count).map(move |i| {
            let (z, phi) = (((i / count) as f32 + 0.5) * step, 2.0 * PI * ((i % count) as f32 + 0.5) * step);
            let r = (1.0 - z * z).sqrt();
            (Vec3::new(r * phi.cos(), r * phi.sin(), z), 2.0 * PI * step * step)
        })
    }

    /// ∫ D cos = 1, and visible normals integrate to one from every direction.
    #[test]
    fn densities_are_normalised() {
        for alpha in [0.2, 0.5, 1.0] {
            let ggx = Ggx { alpha };
            let projected: f32 = directions(600).map(|(m, w)| ggx.density(m) * m.z * w).sum();
            assert!((projected - 1.0).abs() < 2e-3, "{alpha}: {projected}");
            for wo in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.98, 0.2).normalize()] {
                let visible: f32 = directions(600).map(|(m, w)| ggx.visible_density(wo, m) * w).sum();
                assert!((visible - 1.0).abs() < 3e-3, "{alpha} {wo}: {visible}");
            }
        }
    }

    /// Mean of a function of drawn normals equals its integral.
    #[test]
    fn normals_are_drawn_with_their_density() {
        let ggx = Ggx { alpha: 0.4 };
        let wo = Vec3::new(0.7, -0.2, 0.4).normalize();
        let f = |m: Vec3| (m.x + 2.0 * m.y * m.y + m.z).powi(2);
        let integral: f32 = directions(800).map(|(m, w)| f(m) * ggx.visible_density(wo, m) * w).sum();
        let n = 400;
        let drawn = (0..n * n).map(|i| {
            let u = Vec2::new(((i / n) as f32 + 0.5) / n as f32, ((i % n) as f32 + 0.5) / n as f32);
            f(ggx.draw(wo, u))
        });
        let mean = drawn.sum::<f32>() / (n * n) as f32;
        assert!((mean / integral - 1.0).abs() < 3e-3, "{mean} {integral}");
    }
}
