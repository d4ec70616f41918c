//! Lobes of a surface at the components of a path.
//!
//! Directions are in the frame of the surface: the normal is +z, on the side on which the path arrives, and
//! `wo` points back along the path. Values include the cosine at the surface, f(wo, wi) |cos θi|; where light
//! passes into another index, the value is that of radiance, with the factor (η_o/η_i)² = 1/η². Densities of
//! smooth lobes are probabilities, and their values fractions, which divide to the same weight.
//!
//! Rough surfaces: f |cos θi| = F D(m) G₁(wo) G₁(wi) / (4 cos θo) in reflection, and
//!
//! ```text
//!   f |cos θi| = (1 − F) D(m) G₁(wo) G₁(wi) |wo·m| |wi·m| / (cos θo (wo·m + η wi·m)²)
//! ```
//!
//! in transmission, with half vector m ∝ wo + wi or wo + η wi (Walter et al. 2007, for radiance from wi).

use super::{Ggx, fresnel};
use crate::spectrum::Sampled;
use glam::{Vec2, Vec3};

/// Probability with which a path survives a total reflection.
const HELD: f32 = 0.99;

/// Material at the components of a path, as seen from the side on which the path arrives.
#[derive(Clone, Copy, Debug)]
pub enum Scatterer<const N: usize> {
    /// Reflects a constant fraction.
    Mirror(Sampled<N>),
    /// A metal with n and k.
    Conductor(Sampled<N>, Sampled<N>, Option<Ggx>),
    /// A boundary; η is the index behind it over the index in front of it.
    Dielectric(Sampled<N>, Option<Ggx>),
    /// A thin pane with this index.
    Thin(Sampled<N>),
}

/// A direction drawn at a surface, with values and densities at all components.
#[derive(Clone, Copy, Debug)]
pub struct Scattered<const N: usize> {
    /// Direction in which the path continues.
    pub wi: Vec3,
    /// Value at every component.
    pub value: Sampled<N>,
    /// Density with which every component would have drawn it.
    pub density: Sampled<N>,
    /// Whether the lobe is smooth, so that no connection can have this direction.
    pub is_specular: bool,
}

impl<const N: usize> Scatterer<N> {
    /// Returns whether the surface has no lobe that connections can use.
    #[must_use]
    pub fn is_specular(&self) -> bool {
        match self {
            Self::Conductor(_, _, ggx) | Self::Dielectric(_, ggx) => ggx.is_none(),
            Self::Mirror(_) | Self::Thin(_) => true,
        }
    }

    /// Draws a direction with the density of component `lane`; `None` where the surface absorbs the light.
    #[must_use]
    pub fn draw(&self, wo: Vec3, lane: usize, u: Vec2, which: f32) -> Option<Scattered<N>> {
        let mirrored = Vec3::new(-wo.x, -wo.y, wo.z);
        let smooth = |wi: Vec3, value: Sampled<N>, density: Sampled<N>| {
            (density.0[lane] > 0.0).then_some(Scattered { wi, value, density, is_specular: true })
        };
        match self {
            Self::Mirror(reflectance) => smooth(mirrored, *reflectance, Sampled::ONE),
            Self::Conductor(n, k, None) => {
                smooth(mirrored, n.zip(*k, |n, k| fresnel::conductor(wo.z, n, k)), Sampled::ONE)
            }
            Self::Thin(ior) => {
                let reflected = ior.map(|ior| {
                    let r = fresnel::dielectric(wo.z, ior).reflectance;
                    2.0 * r / (1.0 + r)
                });
                if which < reflected.0[lane] {
                    smooth(mirrored, reflected, reflected)
                } else {
                    let passed = reflected.map(|r| 1.0 - r);
                    smooth(-wo, passed, passed)
                }
            }
            Self::Dielectric(eta, None) => {
                let reflected = eta.map(|eta| fresnel::dielectric(wo.z, eta).reflectance);
                if reflected.0[lane] >= 1.0 {
                    // Total reflection can hold a path within a body for ever: it survives by roulette.
                    let held = reflected * (1.0 / HELD);
                    return if which < HELD { smooth(mirrored, held, reflected) } else { None };
                }
                if which < reflected.0[lane] {
                    return smooth(mirrored, reflected, reflected);
                }
                let own = eta.0[lane];
                let wi = refracted(wo, Vec3::Z, own)?;
                // Components of another index are refracted in another direction, and end here.
                let alike = |eta: f32| if eta == own { 1.0 } else { 0.0 };
                let density = reflected.zip(*eta, |r, eta| alike(eta) * (1.0 - r));
                smooth(wi, density * (1.0 / (own * own)), density)
            }
            Self::Conductor(_, _, Some(ggx)) => {
                let m = ggx.draw(wo, u);
                self.rough(wo, m * (2.0 * wo.dot(m)) - wo, lane)
            }
            Self::Dielectric(eta, Some(ggx)) => {
                let m = ggx.draw(wo, u);
                let own = eta.0[lane];
                if which < fresnel::dielectric(wo.dot(m), own).reflectance {
                    let wi = m * (2.0 * wo.dot(m)) - wo;
                    // A reflection below the surface is not a transmission.
                    if wi.z > 0.0 { self.rough(wo, wi, lane) } else { None }
                } else {
                    let wi = refracted(wo, m, own)?;
                    if wi.z < 0.0 { self.rough(wo, wi, lane) } else { None }
                }
            }
        }
    }

    fn rough(&self, wo: Vec3, wi: Vec3, lane: usize) -> Option<Scattered<N>> {
        let (value, density) = self.towards(wo, wi)?;
        (density.0[lane] > 0.0).then_some(Scattered { wi, value, density, is_specular: false })
    }

    /// Values and densities of a direction at all components; `None` where there is no rough lobe, or it
    /// vanishes at every component.
    #[must_use]
    pub fn towards(&self, wo: Vec3, wi: Vec3) -> Option<(Sampled<N>, Sampled<N>)> {
        let (ggx, reflects) = match self {
            Self::Conductor(_, _, Some(ggx)) => (*ggx, wi.z > 0.0),
            Self::Dielectric(_, Some(ggx)) => (*ggx, wi.z > 0.0),
            Self::Mirror(_) | Self::Thin(_) | Self::Conductor(..) | Self::Dielectric(..) => return None,
        };
        if wo.z <= 0.0 || wi.z == 0.0 {
            return None;
        }
        let (mut value, mut density) = (Sampled::ZERO, Sampled::ZERO);
        if reflects {
            let m = (wo + wi).normalize();
            let cosine = wo.dot(m);
            let drawn = ggx.visible_density(wo, m) / (4.0 * cosine);
            let lobe = drawn * ggx.masking(wi);
            match self {
                Self::Conductor(n, k, _) => {
                    value = n.zip(*k, |n, k| fresnel::conductor(cosine, n, k)) * lobe;
                    density = Sampled::splat(drawn);
                }
                Self::Dielectric(eta, _) => {
                    let reflected = eta.map(|eta| fresnel::dielectric(cosine, eta).reflectance);
                    (value, density) = (reflected * lobe, reflected * drawn);
                }
                Self::Mirror(_) | Self::Thin(_) => {}
            }
        } else if let Self::Dielectric(eta, _) = self {
            for i in 0..N {
                (value.0[i], density.0[i]) = transmitted(ggx, wo, wi, eta.0[i]);
            }
        }
        (value.max_component() > 0.0).then_some((value, density))
    }
}

/// Value and density of a rough transmission with relative index η.
fn transmitted(ggx: Ggx, wo: Vec3, wi: Vec3, eta: f32) -> (f32, f32) {
    let half = wo + wi * eta;
    // The half vector lies on the side of the lower index.
    let Some(m) = (half * half.z.signum()).try_normalize() else { return (0.0, 0.0) };
    let (o, i) = (wo.dot(m), wi.dot(m));
    if o <= 0.0 || i >= 0.0 {
        return (0.0, 0.0);
    }
    let passed = 1.0 - fresnel::dielectric(o, eta).reflectance;
    let root = o + eta * i;
    let jacobian = -i / (root * root);
    // G₁(wo) |wo·m| D / cos θo is the density of visible normals.
    let visible = ggx.visible_density(wo, m) * jacobian;
    (passed * visible * ggx.masking(wi), passed * visible * eta * eta)
}

/// Direction refracted at a facet with normal m into a medium of relative index η; `None` under total
/// reflection.
fn refracted(wo: Vec3, m: Vec3, eta: f32) -> Option<Vec3> {
    let cosine = wo.dot(m);
    let fresnel::Dielectric { reflectance, cos_refracted } = fresnel::dielectric(cosine, eta);
    (reflectance < 1.0).then(|| (m * (cosine / eta - cos_refracted) - wo / eta).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    fn sphere(count: usize) -> impl Iterator<Item = (Vec3, f32)> {
        let step = 1.0 / count as f32;
        (0..count * count).map(move |i| {
            let z = 2.0 * ((i / count) as f32 + 0.5) * step - 1.0;
            let phi = 2.0 * PI * ((i % count) as f32 + 0.5) * step;
            let r = (1.0 - z * z).sqrt();
            (Vec3::new(r * phi.cos(), r * phi.sin(), z), 4.0 * PI * step * step)
        })
    }

    fn rough() -> Vec<Scatterer<2>> {
        let ggx = Some(Ggx { alpha: 0.4 });
        vec![
            Scatterer::Conductor(Sampled([0.2, 1.5]), Sampled([3.0, 2.0]), ggx),
            Scatterer::Dielectric(Sampled([1.5, 1.3]), ggx),
            Scatterer::Dielectric(Sampled([0.7, 0.8]), ggx),
        ]
    }

    /// For every lane, the mean of f/p over drawn directions equals the integral of f over all directions, and
    /// drawn values are those that `towards` gives.
    #[test]
    fn rough_directions_are_drawn_with_their_density() {
        for scatterer in rough() {
            for wo in [Vec3::new(0.0, 0.1, 1.0).normalize(), Vec3::new(0.8, 0.1, 0.45).normalize()] {
                let weight = |wi: Vec3| 1.0 + wi.x + wi.z * wi.z;
                let mut integral = Sampled::<2>::ZERO;
                for (wi, solid_angle) in sphere(900) {
                    if let Some((value, _)) = scatterer.towards(wo, wi) {
                        integral += value * (weight(wi) * solid_angle);
                    }
                }
                for lane in 0..2 {
                    let n = 120;
                    let mut mean = Sampled::<2>::ZERO;
                    for i in 0..n * n * n {
                        let at = |k: usize| (k as f32 + 0.5) / n as f32;
                        let u = Vec2::new(at(i / n / n), at(i / n % n));
                        if let Some(s) = scatterer.draw(wo, lane, u, at(i % n)) {
                            assert!(!s.is_specular);
                            let drawn = s.density.0[lane] * (n * n * n) as f32;
                            // Only the lane's own value; others may lie where it cannot be drawn.
                            mean.0[lane] += s.value.0[lane] * weight(s.wi) / drawn;
                        }
                    }
                    let error = mean.0[lane] / integral.0[lane] - 1.0;
                    assert!(error.abs() < 1e-2, "{scatterer:?} {wo} {lane}: {mean:?} {integral:?}");
                }
            }
        }
    }

    /// Densities integrate to at most one: to what is not absorbed or lost between facets.
    #[test]
    fn densities_are_normalised() {
        for scatterer in rough() {
            let wo = Vec3::new(0.5, 0.2, 0.8).normalize();
            let mut total = Sampled::<2>::ZERO;
            for (wi, solid_angle) in sphere(900) {
                if let Some((_, density)) = scatterer.towards(wo, wi) {
                    total += density * solid_angle;
                }
            }
            assert!(total.0.iter().all(|p| *p < 1.005 && *p > 0.8), "{scatterer:?}: {total:?}");
        }
    }

    /// f(wo, wi) cos θi / (η_i²...) is symmetric under exchange of the two directions and sides.
    #[test]
    fn lobes_are_reciprocal() {
        let ggx = Some(Ggx { alpha: 0.3 });
        let (wo, wi) = (Vec3::new(0.3, 0.1, 0.9).normalize(), Vec3::new(-0.2, 0.1, -0.8).normalize());
        let into = Scatterer::Dielectric(Sampled([1.5]), ggx).towards(wo, wi).unwrap().0.hero();
        let flipped = |w: Vec3| Vec3::new(w.x, w.y, -w.z);
        let out = Scatterer::Dielectric(Sampled([1.0 / 1.5]), ggx);
        let out = out.towards(flipped(wi), flipped(wo)).unwrap().0.hero();
        // η_o² f(o → i) / cos θ is the same in both directions.
        let (a, b) = (into * 1.5 * 1.5 / -wi.z, out / wo.z);
        assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
        let metal = Scatterer::Conductor(Sampled([0.2]), Sampled([3.0]), ggx);
        let other = Vec3::new(-0.6, 0.2, 0.5).normalize();
        let [a, b] = [(wo, other), (other, wo)].map(|(o, i)| metal.towards(o, i).unwrap().0.hero() / i.z);
        assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
    }

    /// Smooth boundaries: all light is reflected or refracted, and radiance changes by 1/η².
    #[test]
    fn smooth_boundaries_keep_the_energy() {
        let wo = Vec3::new(0.6, 0.0, 0.8);
        for eta in [1.5, 0.9] {
            let s = Scatterer::Dielectric(Sampled([eta, 1.2]), None);
            let reflected = s.draw(wo, 0, Vec2::ZERO, 0.0).unwrap();
            let passed = s.draw(wo, 0, Vec2::ZERO, 0.999_999).unwrap();
            assert!((reflected.density.hero() + passed.density.hero() - 1.0).abs() < 1e-6);
            assert!((passed.value.hero() * eta * eta - passed.density.hero()).abs() < 1e-6);
            // The other component is reflected in the same direction, and refracted in another.
            assert!(reflected.value.0[1] > 0.0 && passed.value.0[1] == 0.0 && passed.density.0[1] == 0.0);
            let sin = (1.0 - passed.wi.z * passed.wi.z).sqrt();
            assert!((sin * eta - 0.6).abs() < 1e-6 && passed.wi.z < 0.0);
        }
        let glass = Scatterer::Dielectric(Sampled([0.5]), None);
        let total = glass.draw(wo, 0, Vec2::ZERO, 0.9).unwrap();
        assert!(total.wi.z > 0.0 && (HELD * total.value.hero() - 1.0).abs() < 1e-6);
        assert!(glass.draw(wo, 0, Vec2::ZERO, 0.995).is_none());
        let pane = Scatterer::Thin(Sampled([1.5]));
        let [a, b] = [0.0, 0.999_999].map(|u| pane.draw(wo, 0, Vec2::ZERO, u).unwrap());
        assert!((a.value.hero() + b.value.hero() - 1.0).abs() < 1e-6 && b.wi == -wo);
    }
}
