//! Lights seen through the medium: e^(−τ) times their radiance, with a depth limit of 1.
//!
//! A depth of 1 admits no scattering, so that a ray that hits a light after an optical depth τ receives Le
//! e^(−τ), whatever the albedo. A sphere in the middle of the cube is hit at its surface, a rectangle behind
//! the cube after its whole depth, and a box in front of a light hides it.

use super::super::truth::{self, Points};
use super::super::{Answer, Case, CheckError, Family, Layout};
use super::AXIS;

pub(super) const FAMILY: Family = Family {
    id: "emission",
    about: "Lights seen through a medium, without scattering: e^(−τ) times their radiance.",
    deep_only: false,
    cases,
};

fn case(name: &str, rest: &str, mode: &str, colour: [f64; 3]) -> Result<Case, CheckError> {
    let toml = format!("{AXIS}{rest}\n[estimator]\nmode = \"{mode}\"\nmax_depth = 1");
    Case::new(format!("emission/{name}"), &toml, Answer::uniform(colour, Layout::WHOLE))
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let sigma = Points(&[(430.0, 1.0), (560.0, 4.0), (650.0, 0.5)]);
    let lamp = Points(&[(400.0, 0.3), (700.0, 2.0)]);
    // The surface of the sphere is 0.4 behind the face of the cube.
    let inside = truth::film(|l| 1.5 * lamp.at(l) * (-0.4 * sigma.at(l)).exp());
    let sphere = format!(
        "[medium]
        extinction = {}
        albedo = 0.9
        [[lights]]
        kind = \"sphere\"
        center = [0.0, 0.0, 0.0]
        radius = 0.1
        radiance = {}
        scale = 1.5",
        sigma.toml(),
        lamp.toml()
    );
    let behind = "[medium]
        extinction = { rgb = [0.0, 1.5, 4.0] }
        albedo = 0.9
        majorant = { factor = 1.7 }
        [[lights]]
        kind = \"rectangle\"
        center = [0.0, 0.0, -1.0]
        target = [0.0, 0.0, 0.0]
        size = [0.4, 0.4]
        radiance = 2.0
        [[lights]]
        kind = \"environment\"
        radiance = 50.0";
    let through = [0.0f64, 1.5, 4.0].map(|s| 2.0 * (-s).exp());
    let hidden = "[medium]
        extinction = 1.0
        albedo = 0.9
        [[lights]]
        kind = \"sphere\"
        center = [0.0, 0.0, -2.0]
        radius = 0.3
        radiance = 9.0
        visible = false
        [[lights]]
        kind = \"environment\"
        radiance = 0.5";
    Ok(vec![
        case("sphere-inside", &sphere, "spectral", inside)?,
        case("rectangle-behind", behind, "rgb", through)?,
        case("hidden-light", hidden, "rgb", [0.5 * (-1.0f64).exp(); 3])?,
    ])
}
