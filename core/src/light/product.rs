//! Directions that follow the phase function and can meet a light: product sampling.
//!
//! Where scattering is sharp, a point drawn evenly on a large light is one that hardly anything is scattered to, and a
//! direction drawn by the phase function misses a light close by. Here the scattering angle is drawn from the part of a
//! Henyey–Greenstein lobe in which a light is seen: with s = 1 − cos θ and q(s) = √((1 − g)² + 2 g s), that lobe has
//!
//! ```text
//!   ∫ p dω over [s₀, s₁] = (1 − g²) (s₁ − s₀) / (q₀ q₁ (q₀ + q₁)),   1/q = (1 − ξ)/q₀ + ξ/q₁
//! ```
//!
//! and no azimuth is preferred. Any lobe is right, the nearer to the phase function the better. In connections a share
//! is drawn evenly over the light, so that no part of it is ever left out, and all of it where scattering is even.

use super::sector::Sector;
use super::{Emitter, Light, LightSample};
use crate::math::{Frame, INV_4PI, PolarAngle};
use glam::{Vec2, Vec3};

/// Lights whose parts are kept at a vertex; connections to further ones are drawn evenly, and nothing is guided there.
const KEPT: usize = 4;

/// Most of a connection's directions that are drawn by the lobe.
const MOST: f32 = 0.75;

/// A Henyey–Greenstein lobe at a vertex, and its parts in which the lights are seen.
#[derive(Clone, Copy, Debug)]
pub struct LobeParts {
    /// About the direction in which most is scattered.
    frame: Frame,
    /// Mean cosine, 0 ≤ g < 1.
    g: f32,
    parts: [Option<Part>; KEPT],
    /// How many of them stand for a light.
    lights: usize,
}

/// The part of a lobe in which a light is seen.
#[derive(Clone, Copy, Debug)]
struct Part {
    sector: Sector,
    /// q where the sector begins.
    q0: f32,
    /// And where it ends.
    q1: f32,
    /// ∫ of the lobe over the part.
    mass: f32,
}

impl LobeParts {
    /// At a point that scatters from `omega_in`, mostly as `mean_cosine` says.
    #[must_use]
    pub fn new(lights: &[Light], from: Vec3, omega_in: Vec3, mean_cosine: f32) -> Self {
        let frame = Frame::about(omega_in * 1.0f32.copysign(mean_cosine));
        let lights_kept = lights.len().min(KEPT);
        let mut lobe =
            Self { frame, g: mean_cosine.abs().min(0.9999), parts: [None; KEPT], lights: lights_kept };
        for (i, light) in lights.iter().take(KEPT).enumerate() {
            lobe.parts[i] = light.sector(from, &frame).and_then(|sector| lobe.part(sector));
        }
        lobe
    }

    /// Draws a direction in which `from` receives light; `None` where it receives none, or the direction misses it.
    #[must_use]
    pub fn sample_light(&self, index: usize, light: &Light, from: Vec3, mut u: Vec2) -> Option<LightSample> {
        let Some(part) = self.part_of(index) else { return light.sample(from, u) };
        let share = self.share();
        let sample = if u.x < share {
            u.x /= share;
            let direction = self.draw(part, u);
            LightSample { direction, distance: light.reach(from, direction)?, density: 0.0 }
        } else {
            u.x = (u.x - share) / (1.0 - share);
            light.sample(from, u)?
        };
        let density = self.light_density(index, light, from, sample.direction, sample.distance);
        Some(LightSample { density, ..sample })
    }

    /// The density with which [`Self::sample_light`] draws `direction`, which reaches the light after `distance`.
    #[must_use]
    pub fn light_density(
        &self,
        index: usize,
        light: &Light,
        from: Vec3,
        direction: Vec3,
        distance: f32,
    ) -> f32 {
        let by_light = light.density(from, direction, distance);
        self.part_of(index).map_or(by_light, |part| {
            let by_lobe = self.value(self.angle(direction)) / part.mass;
            by_light + self.share() * (by_lobe - by_light)
        })
    }

    /// Density of a direction towards any of the lights, per steradian: the mean over those that are kept.
    #[must_use]
    pub fn density(&self, direction: Vec3) -> f32 {
        let s = self.angle(direction);
        let local = self.frame.to_local(direction);
        let parts = self.parts.iter().take(self.lights);
        // A light without a part stands for the whole lobe.
        let inside = parts.map(|part| part.map_or(1.0, |part| part.sector.holds(s, local) / part.mass));
        self.value(s) * inside.sum::<f32>() / self.lights as f32
    }

    /// Draws a direction with [`Self::density`].
    #[must_use]
    pub fn sample(&self, mut u: Vec2) -> Vec3 {
        let scaled = u.y * self.lights as f32;
        let which = (scaled as usize).min(self.lights.saturating_sub(1));
        u.y = (scaled - which as f32).clamp(0.0, 1.0);
        let whole = Part { sector: Sector::ALL, q0: 1.0 - self.g, q1: 1.0 + self.g, mass: 1.0 };
        self.draw(self.parts[which].as_ref().unwrap_or(&whole), u)
    }

    fn part(&self, sector: Sector) -> Option<Part> {
        let (q0, q1) = (self.root(sector.near), self.root(sector.near + sector.depth));
        let mass = (1.0 - self.g) * (1.0 + self.g) * sector.depth / (q0 * q1 * (q0 + q1)) * sector.turns;
        (mass > f32::MIN_POSITIVE).then_some(Part { sector, q0, q1, mass })
    }

    /// The part that connections to a light are drawn from, if they are.
    fn part_of(&self, light: usize) -> Option<&Part> {
        if self.share() < 0.01 { None } else { self.parts.get(light)?.as_ref() }
    }

    /// Share of a connection's directions that are drawn by the lobe.
    fn share(&self) -> f32 {
        (self.g * self.g).min(MOST)
    }

    /// s of a direction.
    fn angle(&self, direction: Vec3) -> f32 {
        PolarAngle::between(self.frame.axis(), direction).one_minus_cos
    }

    /// q(s).
    fn root(&self, s: f32) -> f32 {
        ((1.0 - self.g) * (1.0 - self.g) + 2.0 * self.g * s).sqrt()
    }

    /// The lobe at s, per steradian.
    fn value(&self, s: f32) -> f32 {
        let q = self.root(s);
        INV_4PI * (1.0 - self.g) * (1.0 + self.g) / (q * q * q)
    }

    /// Draws a direction of a part, in proportion to the lobe.
    fn draw(&self, Part { sector, q0, q1, .. }: &Part, u: Vec2) -> Vec3 {
        let lerped = (1.0 - u.x) * q1 + u.x * q0;
        let q = q0 * q1 / lerped;
        // s − s₀ = (q² − q₀²) / 2g, without the differences, which a lobe that is not sharp could not afford.
        let beyond = u.x * sector.depth * q0 * (q + q0) / ((q0 + q1) * lerped);
        let theta = PolarAngle::from_one_minus_cos((sector.near + beyond).min(2.0));
        self.frame.polar(theta, sector.start + u.y * sector.turns)
    }
}
