//! Equiangular sampling: distances along a ray, uniform in the angle at a pivot.
//!
//! With D the distance of the pivot from the ray, and t measured from the foot of the perpendicular,
//!
//! ```text
//!   p(t) = D / ((θ_b − θ_a) (D² + t²))      t = D tan θ, θ uniform from θ_a to θ_b
//! ```
//!
//! This is the inverse square of the distance to the pivot, normalised (Kulla and Fajardo 2012, section 4.1).

use super::{LightDensities, ScatteringPoint, World};
use crate::math::Ray;
use crate::medium::{LocalMedia, Traversal};
use crate::spectrum::Components;
use glam::Vec3;

/// Part of a ray from its first entry into a medium to its last exit.
#[derive(Clone, Copy, Debug)]
pub struct Passage {
    /// The ray.
    pub ray: Ray,
    near: f32,
    far: f32,
}

/// Passage relative to a pivot.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Distance of the pivot from the ray.
    height: f32,
    /// Signed distance from the foot of the perpendicular to the start of the passage.
    start: f32,
    /// Angle that the passage subtends at the pivot.
    angle: f32,
}

/// Smallest distance of a pivot from the ray, relative to the length of the passage. With a pivot on the ray
/// all samples would be at one distance.
const LEAST_HEIGHT: f32 = 1e-3;

impl Passage {
    /// The part of a ray from its first entry into a medium to its last exit, up to `t_max`; `None` if it
    /// misses all media.
    #[must_use]
    pub fn through<const N: usize>(media: &impl LocalMedia<N>, ray: &Ray, t_max: f32) -> Option<Self> {
        let (near, traversal) = media.traverse(ray, t_max)?;
        Some(Self { ray: *ray, near, far: near + traversal.t_end() })
    }

    fn seen_from(&self, pivot: Vec3) -> Seen {
        let to_pivot = pivot - self.ray.origin;
        let foot = to_pivot.dot(self.ray.direction);
        let height = (to_pivot - self.ray.direction * foot).length();
        let (start, length) = (self.near - foot, self.far - self.near);
        let height = height.max(LEAST_HEIGHT * length);
        // Tangent of a difference of angles, which for a distant pivot are nearly equal.
        let angle = (height * length).atan2(height * height + start * (start + length));
        Seen { height, start, angle }
    }

    /// Samples a distance along the ray from a number uniform in [0, 1); returns it with its density per
    /// scene unit.
    #[must_use]
    pub fn sample(&self, pivot: Vec3, u: f32) -> (f32, f32) {
        let Seen { height, start, angle } = self.seen_from(pivot);
        let (sin, cos) = (u * angle).sin_cos();
        let beyond = sin * (height * height + start * start) / (height * cos - start * sin);
        let t = (self.near + beyond.max(0.0)).min(self.far);
        (t, self.density(pivot, t))
    }

    /// Density with which [`Self::sample`] draws a distance.
    #[must_use]
    pub fn density(&self, pivot: Vec3, t: f32) -> f32 {
        let Seen { height, start, angle } = self.seen_from(pivot);
        if angle <= 0.0 {
            return 0.0;
        }
        // A vertex of the walk may lie outside by an ulp.
        let from_foot = start + (t.clamp(self.near, self.far) - self.near);
        height / (angle * (height * height + from_foot * from_foot))
    }
}

/// Approach of a path to its last vertex.
#[derive(Clone, Copy, Debug)]
pub enum Reached {
    /// Along a passage, to this distance, in a medium with this share of the majorant: equiangular sampling
    /// could have drawn the vertex.
    Through(Passage, f32, f32),
    /// Without a passage: the vertex lies on a surface, or there is none yet. Equiangular sampling could not
    /// have drawn it.
    Otherwise,
}

impl Reached {
    /// Approach to a vertex in the medium.
    #[must_use]
    pub fn through(passage: Option<Passage>, vertex: ScatteringPoint) -> Self {
        passage.map_or(Self::Otherwise, |p| {
            Self::Through(p, (vertex.point - p.ray.origin).dot(p.ray.direction), vertex.share)
        })
    }

    /// Light-dependent factors of the techniques' densities, for a direction from the vertex that light
    /// sampling draws with density `nee`.
    #[must_use]
    pub fn light_densities<M: LocalMedia<N>, C: Components<N>, const N: usize>(
        &self,
        world: &World<'_, M, C, N>,
        light: usize,
        vertex: Vec3,
        nee: f32,
    ) -> LightDensities {
        let (scene, by) = (world.scene, world.settings.lights);
        let eq = match (self, scene.lights.get(light).and_then(|l| l.center())) {
            (Self::Through(passage, t, share), Some(pivot)) => {
                let choice = |at| scene.light_choice.probability(light, at, by);
                nee * share * passage.density(pivot, *t) * choice(passage.ray.origin) / choice(vertex)
            }
            _ => 0.0,
        };
        LightDensities { nee, eq }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passage(near: f32, far: f32) -> Passage {
        Passage { ray: Ray { origin: Vec3::new(1.0, 2.0, 3.0), direction: Vec3::Y }, near, far }
    }

    /// The integral of p from the start of the passage to t equals the random number of t.
    #[test]
    fn distances_are_drawn_by_their_density() {
        for (name, pivot, near, far) in [
            ("beside", Vec3::new(1.5, 3.0, 3.2), 0.0, 4.0),
            ("behind", Vec3::new(1.5, -3.0, 3.2), 0.5, 2.0),
            ("ahead", Vec3::new(0.5, 9.0, 3.0), 0.5, 2.0),
            ("far away", Vec3::new(3e3, -2e3, 3.0), 1.0, 2.0),
            ("on the ray", Vec3::new(1.0, 3.0, 3.0), 0.0, 3.0),
        ] {
            let passage = passage(near, far);
            for i in 0..20u8 {
                let u = (f32::from(i) + 0.5) / 20.0;
                let (t, density) = passage.sample(pivot, u);
                assert!((near..=far).contains(&t) && density > 0.0, "{name}: {t}, {density}");
                // Near a pivot on the ray the density has a peak, which these steps resolve.
                let steps = 200_000u32;
                let width = f64::from(t - near) / f64::from(steps);
                let middle = |k: u32| f64::from(near) + (f64::from(k) + 0.5) * width;
                let before: f64 =
                    (0..steps).map(|k| f64::from(passage.density(pivot, middle(k) as f32))).sum::<f64>()
                        * width;
                assert!((before - f64::from(u)).abs() < 2e-3, "{name}: {before} at {u}");
            }
        }
    }
}
