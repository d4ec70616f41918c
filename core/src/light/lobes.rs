//! Broad lobes towards the lights, for path guiding.
//!
//! Where scattering is sharply forward, a path that reaches a light from the side has to change direction in
//! several steps, each of them rare. With directions drawn from these lobes, mixed with the phase function,
//! such paths are frequent with small weights instead of rare with large ones. A fixed, analytic substitute
//! for learnt guiding (Herholz et al. 2019, "Volume path guiding based on zero-variance random walk theory").

use super::{Light, LightKind};
use crate::math::{Frame, INV_4PI, PolarAngle};
use glam::{Vec2, Vec3};

/// Mean cosine of a lobe: about the spread of a beam after a few forward scatterings.
const G: f32 = 0.75;

/// One Henyey–Greenstein lobe for every light with a position or direction; none for environments.
#[derive(Clone, Debug)]
pub struct LightLobes {
    targets: Vec<Target>,
}

#[derive(Clone, Copy, Debug)]
enum Target {
    Point(Vec3),
    Direction(Vec3),
}

impl Target {
    fn direction_from(self, point: Vec3) -> Vec3 {
        match self {
            Self::Point(center) => (center - point).normalize_or(Vec3::Y),
            Self::Direction(toward) => toward,
        }
    }
}

impl LightLobes {
    /// Creates lobes towards these lights; `None` if no light has a position or direction.
    #[must_use]
    pub fn towards(lights: &[Light]) -> Option<Self> {
        let target = |light: &Light| match &light.kind {
            LightKind::Sun(sun) => Some(Target::Direction(sun.toward())),
            _ => light.center().map(Target::Point),
        };
        let targets: Vec<Target> = lights.iter().filter_map(target).collect();
        (!targets.is_empty()).then_some(Self { targets })
    }

    /// Density of a direction seen from `point`, per steradian: the mean of the lobes.
    #[must_use]
    pub fn density(&self, point: Vec3, direction: Vec3) -> f32 {
        let lobe = |target: &Target| {
            let theta = PolarAngle::between(target.direction_from(point), direction);
            let d = (1.0 - G) * (1.0 - G) + 2.0 * G * theta.one_minus_cos;
            INV_4PI * (1.0 - G) * (1.0 + G) / (d * d.sqrt())
        };
        self.targets.iter().map(lobe).sum::<f32>() / self.targets.len() as f32
    }

    /// Draws a direction with density [`Self::density`].
    #[must_use]
    pub fn sample(&self, point: Vec3, u: Vec2) -> Vec3 {
        let scaled = u.x * self.targets.len() as f32;
        let which = (scaled as usize).min(self.targets.len() - 1);
        let xi = (scaled - which as f32).clamp(0.0, 1.0);
        let r = (1.0 - G) / (1.0 - G + 2.0 * G * xi);
        let theta = PolarAngle::from_one_minus_cos(2.0 * r * r * (1.0 - xi) * (1.0 + G * xi));
        Frame::about(self.targets[which].direction_from(point)).polar(theta, u.y)
    }
}
