//! Product sampling: directions that follow the phase function and can reach a light.
//!
//! Where scattering is sharp, a point drawn uniformly on a large light mostly receives hardly any scattered
//! light, and a direction drawn from the phase function misses a light close by. Here the scattering angle is
//! drawn from the part of a Henyey–Greenstein lobe that covers a light: with s = 1 − cos θ and
//! q(s) = √((1 − g)² + 2 g s), that lobe has
//!
//! ```text
//!   ∫ p dω over [s₀, s₁] = (1 − g²) (s₁ − s₀) / (q₀ q₁ (q₀ + q₁)),   1/q = (1 − ξ)/q₀ + ξ/q₁
//! ```
//!
//! and the azimuth is uniform. Any lobe gives an unbiased estimate; the closer to the phase function, the
//! lower the variance. In connections a share of directions is drawn uniformly over the light, so that no
//! part of it is ever left out, and all of them where scattering is isotropic.

use super::sector::Sector;
use super::{Emitter, Light, LightPoint, LightSample};
use crate::math::{Frame, INV_4PI, PolarAngle};
use glam::{Vec2, Vec3};

/// Number of lights whose parts are stored at a vertex; connections to further lights are drawn uniformly,
/// without guiding.
const KEPT: usize = 4;

/// Largest share of a connection's directions drawn from the lobe.
const MOST: f32 = 0.75;

/// Henyey–Greenstein lobe at a vertex, with the parts that cover the lights.
#[derive(Clone, Copy, Debug)]
pub struct LobeParts {
    /// Frame about the direction of strongest scattering.
    frame: Frame,
    /// Mean cosine, 0 ≤ g < 1.
    g: f32,
    parts: [Option<Part>; KEPT],
    /// Number of parts in use, one per stored light.
    lights: usize,
}

/// Part of a lobe that covers a light.
#[derive(Clone, Copy, Debug)]
struct Part {
    sector: Sector,
    /// q at the start of the sector.
    q0: f32,
    /// q at the end of the sector.
    q1: f32,
    /// Integral of the lobe over the part.
    mass: f32,
}

impl LobeParts {
    /// Creates the lobe at a point that scatters light from `omega_in`, with this mean cosine.
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

    /// Draws a direction from which `from` receives light; `None` where it receives none, or the direction
    /// misses the light.
    #[must_use]
    pub fn sample_light(&self, index: usize, light: &Light, from: Vec3, mut u: Vec2) -> Option<LightSample> {
        let Some(part) = self.part_of(index) else { return light.sample(from, u) };
        let share = self.share();
        let point = if u.x < share {
            u.x /= share;
            light.reach(from, self.draw(part, u))?
        } else {
            u.x = (u.x - share) / (1.0 - share);
            light.sample(from, u)?.point
        };
        Some(LightSample { point, density: self.light_density(index, light, from, &point) })
    }

    /// Density with which [`Self::sample_light`] draws a point of the light.
    #[must_use]
    pub fn light_density(&self, index: usize, light: &Light, from: Vec3, at: &LightPoint) -> f32 {
        let by_light = light.density(from, at);
        self.part_of(index).map_or(by_light, |part| {
            let by_lobe = self.value(self.angle(at.direction)) / part.mass;
            by_light + self.share() * (by_lobe - by_light)
        })
    }

    /// Density of a direction drawn by [`Self::sample`], per steradian: the mean over the stored lights.
    #[must_use]
    pub fn density(&self, direction: Vec3) -> f32 {
        let s = self.angle(direction);
        let local = self.frame.to_local(direction);
        let parts = self.parts.iter().take(self.lights);
        // A light without a part uses the whole lobe.
        let inside = parts.map(|part| part.map_or(1.0, |part| part.sector.holds(s, local) / part.mass));
        self.value(s) * inside.sum::<f32>() / self.lights as f32
    }

    /// Draws a direction with density [`Self::density`].
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

    /// The part from which connections to a light are drawn, if any.
    fn part_of(&self, light: usize) -> Option<&Part> {
        if self.share() < 0.01 { None } else { self.parts.get(light)?.as_ref() }
    }

    /// Share of a connection's directions drawn from the lobe.
    fn share(&self) -> f32 {
        (self.g * self.g).min(MOST)
    }

    /// s = 1 − cos θ of a direction.
    fn angle(&self, direction: Vec3) -> f32 {
        PolarAngle::between(self.frame.axis(), direction).one_minus_cos
    }

    /// q(s).
    fn root(&self, s: f32) -> f32 {
        ((1.0 - self.g) * (1.0 - self.g) + 2.0 * self.g * s).sqrt()
    }

    /// Value of the lobe at s, per steradian.
    fn value(&self, s: f32) -> f32 {
        let q = self.root(s);
        INV_4PI * (1.0 - self.g) * (1.0 + self.g) / (q * q * q)
    }

    /// Draws a direction within a part, in proportion to the lobe.
    fn draw(&self, Part { sector, q0, q1, .. }: &Part, u: Vec2) -> Vec3 {
        let lerped = (1.0 - u.x) * q1 + u.x * q0;
        let q = q0 * q1 / lerped;
        // s − s₀ = (q² − q₀²) / 2g without the difference, which would cancel for lobes that are not sharp.
        let beyond = u.x * sector.depth * q0 * (q + q0) / ((q0 + q1) * lerped);
        let theta = PolarAngle::from_one_minus_cos((sector.near + beyond).min(2.0));
        self.frame.polar(theta, sector.start + u.y * sector.turns)
    }
}
