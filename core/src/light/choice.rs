//! Choice of the light of a connection.

use super::{Light, LightKind};
use crate::spectrum::Spectrum;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::f32::consts::{PI, TAU};

/// Rule by which a connection chooses its light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightSelection {
    /// All lights with equal probability.
    #[default]
    Uniform,
    /// In proportion to emitted power: wins where some lights are faint. On the side-lit cloud relMSE ×0.66
    /// of the uniform choice, on the plume ×0.97; costs one table look-up per connection.
    Power,
    /// In proportion to the unoccluded illuminance at the point: wins where lights are at different
    /// distances. Evaluates every light per connection. relMSE ×0.71 and ×0.98 on the same scenes.
    Contribution,
}

/// Probability of a uniform choice, so that no estimate can rule out a light.
const UNIFORM: f32 = 0.1;

/// Precomputed data for choosing a light.
#[derive(Clone, Debug, Default)]
pub struct LightChoice {
    sources: Vec<Source>,
    /// Probability of each light under [`LightSelection::Power`].
    by_power: Vec<f32>,
}

/// A light, reduced to what its illuminance depends on.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// A rectangle or disk that emits on the side of its normal.
    Rectangle {
        center: Vec3,
        normal: Vec3,
        area: f32,
        luminance: f32,
    },
    Sphere {
        center: Vec3,
        radius: f32,
        luminance: f32,
    },
    /// A surface within a ball about the centre, which emits outwards.
    Spread {
        center: Vec3,
        radius: f32,
        area: f32,
        luminance: f32,
    },
    /// Luminance integrated over directions, the same at every point.
    Distant {
        illuminance: f32,
    },
}

impl Source {
    fn new(light: &Light) -> Self {
        let luminance = |spectrum: &Spectrum| spectrum.film_colour().dot(Vec3::new(0.2126, 0.7152, 0.0722));
        match &light.kind {
            LightKind::Rectangle(l) => Self::Rectangle {
                center: l.shape.center,
                normal: l.shape.normal,
                area: l.shape.area,
                luminance: luminance(&l.radiance),
            },
            LightKind::Sphere(l) => Self::Sphere {
                center: l.shape.center,
                radius: l.shape.radius,
                luminance: luminance(&l.radiance),
            },
            LightKind::Disk(l) => Self::Rectangle {
                center: l.shape.center,
                normal: l.shape.normal,
                area: l.shape.area(),
                luminance: luminance(&l.radiance),
            },
            LightKind::Mesh(l) => Self::Spread {
                center: l.center(),
                radius: l.radius(),
                area: l.area(),
                luminance: luminance(&l.radiance),
            },
            LightKind::Sun(l) => Self::Distant { illuminance: l.irradiance(luminance) },
            LightKind::Environment(l) => Self::Distant { illuminance: luminance(&l.radiance) * 2.0 * TAU },
            LightKind::EnvironmentMap(l) => Self::Distant { illuminance: l.illuminance() },
        }
    }

    /// Emitted luminous flux; for distant lights the flux into a ball of this radius.
    fn power(self, radius: f32) -> f32 {
        match self {
            Self::Rectangle { area, luminance, .. } | Self::Spread { area, luminance, .. } => {
                PI * area * luminance
            }
            Self::Sphere { radius, luminance, .. } => 4.0 * PI * PI * radius * radius * luminance,
            // Extinguished by media without a boundary.
            Self::Distant { illuminance: 0.0 } => 0.0,
            Self::Distant { illuminance } => PI * radius * radius * illuminance,
        }
    }

    /// Approximate illuminance at a point facing the light; bounded at small distances.
    fn illuminance(self, at: Vec3) -> f32 {
        match self {
            Self::Rectangle { center, normal, area, luminance } => {
                let away = at - center;
                let squared = away.length_squared();
                let cosine = normal.dot(away) / squared.sqrt().max(f32::MIN_POSITIVE);
                // Where the centre is seen edge-on, parts of the rectangle may still be seen from the front.
                luminance * (area * cosine.max(0.05) / squared.max(f32::MIN_POSITIVE)).min(TAU)
            }
            Self::Sphere { center, radius, luminance } => {
                let sine_squared = radius * radius / at.distance_squared(center).max(f32::MIN_POSITIVE);
                luminance * PI * sine_squared.min(4.0)
            }
            Self::Spread { center, radius, area, luminance } => {
                // A quarter of the surface of a convex body is its mean projected area.
                let squared = at.distance_squared(center).max(0.25 * radius * radius);
                luminance * (0.25 * area / squared.max(f32::MIN_POSITIVE)).min(TAU)
            }
            Self::Distant { illuminance } => illuminance,
        }
    }
}

impl LightChoice {
    /// Prepares the choice among these lights, around media that fit into a ball of this radius; infinite for a
    /// medium without a boundary, which extinguishes distant lights.
    #[must_use]
    pub fn new(lights: &[Light], medium_radius: f32) -> Self {
        let mut sources: Vec<_> = lights.iter().map(Source::new).collect();
        if medium_radius == f32::INFINITY {
            for source in &mut sources {
                if let Source::Distant { illuminance } = source {
                    *illuminance = 0.0;
                }
            }
        }
        let powers: Vec<f32> = sources.iter().map(|s| s.power(medium_radius).max(0.0)).collect();
        let total: f32 = powers.iter().sum();
        let by_power = powers.iter().map(|power| mixed(*power, total, powers.len())).collect();
        Self { sources, by_power }
    }

    /// Chooses a light from a number uniform in [0, 1), and returns its index and the probability of the
    /// choice. `None` if there are no lights.
    #[must_use]
    #[inline]
    pub fn choose(&self, at: Vec3, u: f32, by: LightSelection) -> Option<(usize, f32)> {
        let count = self.sources.len();
        match by {
            LightSelection::Uniform => {
                let index = (u * count as f32) as usize;
                (index < count).then(|| (index, 1.0 / count as f32))
            }
            LightSelection::Power => pick(u, self.by_power.iter().copied()),
            LightSelection::Contribution => {
                let total = self.total_illuminance(at);
                pick(u, self.sources.iter().map(|s| mixed(s.illuminance(at), total, count)))
            }
        }
    }

    /// Probability with which [`Self::choose`] chooses a light.
    #[must_use]
    #[inline]
    pub fn probability(&self, index: usize, at: Vec3, by: LightSelection) -> f32 {
        let count = self.sources.len();
        match by {
            LightSelection::Uniform => 1.0 / count as f32,
            LightSelection::Power => self.by_power.get(index).copied().unwrap_or(0.0),
            LightSelection::Contribution => {
                let total = self.total_illuminance(at);
                self.sources.get(index).map_or(0.0, |s| mixed(s.illuminance(at), total, count))
            }
        }
    }

    fn total_illuminance(&self, at: Vec3) -> f32 {
        self.sources.iter().map(|s| s.illuminance(at)).sum()
    }
}

/// Probability of one of `count` lights, for its value and the total of all values.
fn mixed(value: f32, total: f32, count: usize) -> f32 {
    let uniform = 1.0 / count as f32;
    if total > 0.0 && total.is_finite() {
        UNIFORM * uniform + (1.0 - UNIFORM) * value / total
    } else {
        uniform
    }
}

/// Selects an index by its probability; the last one also takes the remainder left by rounding.
fn pick(u: f32, probabilities: impl Iterator<Item = f32>) -> Option<(usize, f32)> {
    let mut left = u;
    let mut chosen = None;
    for (index, probability) in probabilities.enumerate() {
        chosen = Some((index, probability));
        if left < probability {
            break;
        }
        left -= probability;
    }
    chosen
}
