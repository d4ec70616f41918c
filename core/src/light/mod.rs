//! Lights: their emission, and sampling of directions towards them.
//!
//! Densities are per steradian as seen from the shaded point. Directions point from the scene towards
//! the light. Every light has a positive extent, so that a randomly scattered path can reach it.

mod choice;
mod environment;
mod environment_map;
mod lobes;
mod product;
mod rectangle;
mod sector;
mod sphere;
mod sun;

pub use choice::{LightChoice, LightSelection};
pub use environment::Environment;
pub use environment_map::{EnvironmentMap, Panorama};
pub use lobes::LightLobes;
pub use product::LobeParts;
pub use rectangle::RectangleLight;
pub use sphere::SphereLight;
pub use sun::Sun;

use crate::math::Ray;
use crate::spectrum::Components;
use glam::{Vec2, Vec3};

/// A direction drawn towards a light.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    /// Unit vector towards the light.
    pub direction: Vec3,
    /// Distance to the light; infinite for distant lights.
    pub distance: f32,
    /// Density of the direction, per steradian.
    pub density: f32,
}

/// Interface of a light.
pub trait Emitter {
    /// Draws a direction from which `from` receives light; `None` where it receives none.
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample>;

    /// Density with which [`Self::sample`] draws `direction`, which reaches the light after
    /// `distance`.
    fn density(&self, from: Vec3, direction: Vec3, distance: f32) -> f32;

    /// Radiance arriving along `direction`, which must reach the light's emitting side.
    fn radiance<const N: usize, C: Components<N>>(&self, direction: Vec3, components: &C) -> C::Radiance;
}

/// Kind of a light, with its parameters.
#[derive(Clone, Debug)]
pub enum LightKind {
    /// A one-sided rectangle.
    Rectangle(RectangleLight),
    /// A sphere.
    Sphere(SphereLight),
    /// A distant disc.
    Sun(Sun),
    /// A constant environment.
    Environment(Environment),
    /// An environment map from an image.
    EnvironmentMap(EnvironmentMap),
}

/// A light of the scene.
#[derive(Clone, Debug)]
pub struct Light {
    /// Kind.
    pub kind: LightKind,
    /// Whether the camera sees the light directly.
    pub visible: bool,
}

macro_rules! each {
    ($self:ident, $light:ident => $body:expr) => {
        match &$self.kind {
            LightKind::Rectangle($light) => $body,
            LightKind::Sphere($light) => $body,
            LightKind::Sun($light) => $body,
            LightKind::Environment($light) => $body,
            LightKind::EnvironmentMap($light) => $body,
        }
    };
}

impl Light {
    /// Centre; `None` for distant lights.
    #[must_use]
    pub fn center(&self) -> Option<Vec3> {
        match &self.kind {
            LightKind::Rectangle(light) => Some(light.shape.center),
            LightKind::Sphere(light) => Some(light.shape.center),
            LightKind::Sun(_) | LightKind::Environment(_) | LightKind::EnvironmentMap(_) => None,
        }
    }

    /// Distance from a point to the emitting side; `None` where the direction misses it.
    #[must_use]
    pub fn reach(&self, from: Vec3, direction: Vec3) -> Option<f32> {
        let ray = Ray { origin: from, direction };
        match &self.kind {
            LightKind::Rectangle(light) => {
                let hit = light.shape.intersect(&ray, f32::INFINITY)?;
                (direction.dot(hit.normal) < 0.0).then_some(hit.t)
            }
            LightKind::Sphere(light) => {
                let hit = light.shape.intersect(&ray, f32::INFINITY)?;
                (direction.dot(hit.normal) < 0.0).then_some(hit.t)
            }
            LightKind::Sun(_) | LightKind::Environment(_) | LightKind::EnvironmentMap(_) => {
                self.is_behind(direction).then_some(f32::INFINITY)
            }
        }
    }

    /// Whether a ray that leaves the scene in `direction` reaches this light. False for lights with a
    /// surface, which are found by intersection.
    #[must_use]
    pub fn is_behind(&self, direction: Vec3) -> bool {
        match &self.kind {
            LightKind::Rectangle(_) | LightKind::Sphere(_) => false,
            LightKind::Sun(sun) => sun.covers(direction),
            LightKind::Environment(_) | LightKind::EnvironmentMap(_) => true,
        }
    }
}

impl Emitter for Light {
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample> {
        each!(self, light => light.sample(from, u))
    }

    fn density(&self, from: Vec3, direction: Vec3, distance: f32) -> f32 {
        each!(self, light => light.density(from, direction, distance))
    }

    fn radiance<const N: usize, C: Components<N>>(&self, direction: Vec3, components: &C) -> C::Radiance {
        each!(self, light => light.radiance(direction, components))
    }
}
