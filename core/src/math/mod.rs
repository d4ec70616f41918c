//! Geometry and random numbers, the lowest layer of the crate.

mod bits;
mod fast;
mod frame;
mod polar;
mod ray;
mod sampler;
mod stratified;

pub use fast::{exp, ln, sin_cos_turns};
pub use frame::Frame;
pub use polar::PolarAngle;
pub use ray::{BoxRay, Ray};
pub use sampler::{Sampler, SamplerKind, SideStream, numbers_of_point};

use glam::{Vec2, Vec3};
use std::f32::consts::PI;

/// Density of the uniform distribution over directions, 1/(4π) per steradian.
pub const INV_4PI: f32 = 1.0 / (4.0 * PI);

/// Samples a direction uniformly over the sphere, from two uniform numbers.
#[must_use]
pub fn uniform_direction(u: Vec2) -> Vec3 {
    let z = 1.0 - 2.0 * u.x;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = sin_cos_turns(u.y);
    Vec3::new(r * cos, r * sin, z)
}

/// Samples a direction about +z with density cos θ/π, from two uniform numbers.
#[must_use]
pub fn cosine_direction(u: Vec2) -> Vec3 {
    let r = u.x.sqrt();
    let (sin, cos) = sin_cos_turns(u.y);
    Vec3::new(r * cos, r * sin, (1.0 - u.x).max(0.0).sqrt())
}
