//! Names of the events of a path.

use std::fmt;

/// Part of a path that an event belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// Walk from the camera.
    Path,
    /// Connection to a light.
    Connection,
    /// Separate walk that samples the unidirectional contribution.
    LightWalk,
    /// Equiangularly sampled vertex and its connection.
    Equiangular,
}

/// Event of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// The path leaves the camera.
    Camera,
    /// A tentative collision whose type has not been sampled yet.
    Collision,
    /// A null collision.
    Null,
    /// Scattering.
    Scatter,
    /// Absorption, which ends the path.
    Absorb,
    /// Reflection by a surface.
    Reflect,
    /// The path leaves the medium.
    Exit,
    /// Survival of Russian roulette, with the survival probability.
    Survive(f32),
    /// Termination by Russian roulette, with the survival probability.
    Terminate(f32),
    /// A new direction at a vertex: value and density of the phase function.
    Direction(f32, f32),
    /// Start of a connection: phase function, density of the direction under the walk, and under the light.
    Connect(f32, f32, f32),
    /// A transmittance estimate of a connection, without a density.
    Transmittance,
    /// A connection without a contribution.
    NoContribution,
    /// A contribution is added to the estimate.
    Contribution,
}

impl Branch {
    /// Display name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Path => "path",
            Self::Connection => "connection",
            Self::LightWalk => "light walk",
            Self::Equiangular => "equiangular",
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Camera => f.write_str("leaves the camera"),
            Self::Collision => f.write_str("collides"),
            Self::Null => f.write_str("null collision"),
            Self::Scatter => f.write_str("scatters"),
            Self::Absorb => f.write_str("is absorbed"),
            Self::Reflect => f.write_str("is reflected"),
            Self::Exit => f.write_str("leaves the medium"),
            Self::Survive(q) => write!(f, "survives roulette, {q:.2}"),
            Self::Terminate(q) => write!(f, "ends by roulette, {q:.2}"),
            Self::Direction(..) => f.write_str("turns"),
            Self::Connect(..) => f.write_str("connects to a light"),
            Self::Transmittance => f.write_str("transmittance"),
            Self::NoContribution => f.write_str("nothing arrives"),
            Self::Contribution => f.write_str("light is added"),
        }
    }
}
