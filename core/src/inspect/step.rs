//! The events of a path, by name.

use std::fmt;

/// Which part of a path an event belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// The walk from the camera.
    Path,
    /// A connection to a light.
    Connection,
    /// A walk of its own that only meets light.
    LightWalk,
    /// A vertex drawn by angle, and its connection.
    Angle,
}

/// What has happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// The path leaves the camera.
    Camera,
    /// A tentative collision whose outcome is not drawn yet.
    Collision,
    /// A null collision.
    Null,
    /// Scattering.
    Scatter,
    /// Absorption: the path ends.
    Absorb,
    /// A reflection by a surface.
    Reflect,
    /// The medium is left.
    Exit,
    /// Roulette is survived with this probability.
    Survive(f32),
    /// Roulette ends the path, which would have survived with this probability.
    Die(f32),
    /// The path leaves its vertex: phase function and density of the direction.
    Leave(f32, f32),
    /// A connection sets out: phase function, density of the walk's direction, density of the light's.
    Connect(f32, f32, f32),
    /// A connection's transmittance is estimated without a density.
    Transmittance,
    /// Nothing has arrived.
    Dark,
    /// Light is added.
    Credit,
}

impl Branch {
    /// Name for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Path => "path",
            Self::Connection => "connection",
            Self::LightWalk => "light walk",
            Self::Angle => "by angle",
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
            Self::Die(q) => write!(f, "ends by roulette, {q:.2}"),
            Self::Leave(..) => f.write_str("turns"),
            Self::Connect(..) => f.write_str("connects to a light"),
            Self::Transmittance => f.write_str("transmittance"),
            Self::Dark => f.write_str("nothing arrives"),
            Self::Credit => f.write_str("light is added"),
        }
    }
}
