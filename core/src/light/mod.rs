//! Lights: their emission, and sampling of directions towards them.
//!
//! Densities are per steradian as seen from the shaded point. Directions point from the scene towards
//! the light. Every light has a positive extent, so that a randomly scattered path can reach it.

mod choice;
mod disk;
mod environment;
mod environment_map;
mod lobes;
mod mesh;
mod mesh_tree;
mod product;
mod rectangle;
mod sector;
mod sphere;
mod sun;

pub use choice::{LightChoice, LightSelection};
pub use disk::DiskLight;
pub use environment::Environment;
pub use environment_map::{EnvironmentMap, Panorama};
pub use lobes::LightLobes;
pub use mesh::MeshLight;
pub use product::LobeParts;
pub use rectangle::RectangleLight;
pub use sphere::SphereLight;
pub use sun::Sun;

use crate::math::Ray;
use crate::spectrum::Components;
use glam::{Vec2, Vec3};

/// Point of a light, as seen from another point.
#[derive(Clone, Copy, Debug)]
pub struct LightPoint {
    /// Unit vector towards the point.
    pub direction: Vec3,
    /// Distance to the point; infinite for distant lights.
    pub distance: f32,
    /// Triangle of a mesh; 0 on other lights.
    pub triangle: u32,
}

/// A point drawn on a light.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    /// The point.
    pub point: LightPoint,
    /// Density of its direction, per steradian.
    pub density: f32,
}

impl LightSample {
    /// Creates a sample of a light that is not a mesh.
    #[must_use]
    #[inline]
    pub fn new(direction: Vec3, distance: f32, density: f32) -> Self {
        Self { point: LightPoint { direction, distance, triangle: 0 }, density }
    }
}

/// Interface of a light.
pub trait Emitter {
    /// Draws a point from which `from` receives light; `None` where it receives none.
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample>;

    /// Density with which [`Self::sample`] draws the direction of a point of the light, as that point; per
    /// steradian.
    fn density(&self, from: Vec3, at: &LightPoint) -> f32;

    /// Radiance arriving along `direction`, which must reach the light's emitting side.
    fn radiance<const N: usize, C: Components<N>>(&self, direction: Vec3, components: &C) -> C::Radiance;
}

/// Kind of a light, with its parameters.
#[derive(Clone, Debug)]
pub enum LightKind {
    /// A one-sided rectangle.
    Rectangle(RectangleLight),
    /// A one-sided disk.
    Disk(DiskLight),
    /// A sphere.
    Sphere(SphereLight),
    /// A triangle mesh that emits outwards.
    Mesh(MeshLight),
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
            LightKind::Disk($light) => $body,
            LightKind::Sphere($light) => $body,
            LightKind::Mesh($light) => $body,
            LightKind::Sun($light) => $body,
            LightKind::Environment($light) => $body,
            LightKind::EnvironmentMap($light) => $body,
        }
    };
}

impl Light {
    /// Centre; `None` for distant lights.
    #[must_use]
    #[inline]
    pub fn center(&self) -> Option<Vec3> {
        match &self.kind {
            LightKind::Rectangle(light) => Some(light.shape.center),
            LightKind::Disk(light) => Some(light.shape.center),
            LightKind::Sphere(light) => Some(light.shape.center),
            LightKind::Mesh(light) => Some(light.center()),
            LightKind::Sun(_) | LightKind::Environment(_) | LightKind::EnvironmentMap(_) => None,
        }
    }

    /// Point of the emitting side in a direction; `None` where the direction misses it.
    #[must_use]
    pub fn reach(&self, from: Vec3, direction: Vec3) -> Option<LightPoint> {
        let ray = Ray { origin: from, direction };
        let hit = match &self.kind {
            LightKind::Rectangle(light) => light.shape.intersect(&ray, f32::INFINITY)?,
            LightKind::Disk(light) => light.shape.intersect(&ray, f32::INFINITY)?,
            LightKind::Sphere(light) => light.shape.intersect(&ray, f32::INFINITY)?,
            LightKind::Mesh(light) => light.shape().intersect(&ray, f32::INFINITY)?,
            LightKind::Sun(_) | LightKind::Environment(_) | LightKind::EnvironmentMap(_) => {
                let point = LightPoint { direction, distance: f32::INFINITY, triangle: 0 };
                return self.is_behind(direction).then_some(point);
            }
        };
        (direction.dot(hit.normal) < 0.0).then_some(LightPoint {
            direction,
            distance: hit.t,
            triangle: hit.triangle,
        })
    }

    /// Whether a ray that leaves the scene in `direction` reaches this light. False for lights with a
    /// surface, which are found by intersection.
    #[must_use]
    #[inline]
    pub fn is_behind(&self, direction: Vec3) -> bool {
        match &self.kind {
            LightKind::Rectangle(_) | LightKind::Disk(_) | LightKind::Sphere(_) | LightKind::Mesh(_) => false,
            LightKind::Sun(sun) => sun.covers(direction),
            LightKind::Environment(_) | LightKind::EnvironmentMap(_) => true,
        }
    }
}

impl Emitter for Light {
    #[inline]
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample> {
        each!(self, light => light.sample(from, u))
    }

    #[inline]
    fn density(&self, from: Vec3, at: &LightPoint) -> f32 {
        each!(self, light => light.density(from, at))
    }

    fn radiance<const N: usize, C: Components<N>>(&self, direction: Vec3, components: &C) -> C::Radiance {
        each!(self, light => light.radiance(direction, components))
    }
}
