//! Light selection, occlusion and a tiny sun: single scattering by quadrature.
//!
//! The integral is that of `single_scattering.rs`. Two suns of powers 1000 and 1 emit in different channels,
//! so that a missed contribution of the faint one shows in its own channel. A black box blocks a sun from one
//! part of the axis. An environment map has one texel, 1/1300 of the sphere, that is far brighter than its
//! sky. Its texels are integrated one by one, in the directions defined by the format: top row +y, middle
//! column −z, columns increasing towards +x from there.

use super::super::truth;
use super::super::{Answer, Case, CheckError, Family, Layout};
use super::single_scattering::{Cube, Disc, QUADRATURE, sun, to_face};
use super::{AXIS, CONNECTING, CONNECTING_AND_ONE};
use crate::io::Library;
use crate::light::Panorama;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

pub(super) const FAMILY: Family = Family {
    id: "lights",
    about: "Lights of different power, an occluder, an environment map with a tiny sun.",
    deep_only: false,
    cases,
};

fn isotropic(_: f64) -> f64 {
    0.25 / PI
}

fn case(name: &str, rest: &str, answer: Answer) -> Result<Case, CheckError> {
    let toml = format!("{AXIS}{rest}\n[estimator]\nmode = \"rgb\"\nmax_depth = 2");
    Case::new(format!("lights/{name}"), &toml, answer.within(QUADRATURE))
}

fn two_powers() -> Result<Case, CheckError> {
    let (strong, faint) = (DVec3::new(0.7, 0.2, 0.6), DVec3::new(-0.5, 0.8, 0.3));
    let cube = Cube { extinction: 2.0, albedo: 0.9 };
    let from = |toward: DVec3, irradiance: f64| cube.single(isotropic, |_| sun(toward, 100.0, irradiance));
    let colour = [from(strong, 1000.0), from(strong, 500.0), from(faint, 1.0)];
    let rest = "[medium]
        extinction = 2.0
        albedo = 0.9
        [[lights]]
        kind = \"sun\"
        toward = [0.7, 0.2, 0.6]
        angular_diameter_deg = 100.0
        irradiance = { rgb = [1000.0, 500.0, 0.0] }
        visible = false
        [[lights]]
        kind = \"sun\"
        toward = [-0.5, 0.8, 0.3]
        angular_diameter_deg = 100.0
        irradiance = { rgb = [0.0, 0.0, 1.0] }
        visible = false";
    case("two-powers", rest, Answer::uniform(colour, Layout::WHOLE))
}

fn occluder() -> Result<Case, CheckError> {
    let (center, half) = (DVec3::new(0.9, 0.0, 0.15), DVec3::new(0.1, 0.6, 0.25));
    let toward = DVec3::new(1.0, 0.1, 0.2);
    let single = [0.5, 1.5, 3.0].map(|extinction| {
        Cube { extinction, albedo: 0.9 }.single_fine(
            (250, 40),
            isotropic,
            |_| sun(toward, 120.0, 2.0),
            |point, omega| truth::box_interval(point, omega, center, half).is_none_or(|(_, far)| far < 0.0),
        )
    });
    let rest = "[medium]
        extinction = { rgb = [0.5, 1.5, 3.0] }
        albedo = 0.9
        [[lights]]
        kind = \"sun\"
        toward = [1.0, 0.1, 0.2]
        angular_diameter_deg = 120.0
        irradiance = 2.0
        visible = false
        [[objects]]
        kind = \"box\"
        center = [0.9, 0.0, 0.15]
        size = [0.2, 1.2, 0.5]
        albedo = 0.0";
    case("occluder", rest, Answer::uniform(single, Layout::WHOLE))
}

const SKY: (usize, usize) = (64, 32);
/// Column and row of the sun's texel, 4 degrees off the axis.
const SUN: (usize, usize) = (32, 15);
const SKY_RADIANCE: f64 = 0.02;
const SUN_RADIANCE: f64 = 800.0;

/// Direction of continuous texel coordinates of the map.
fn direction(x: f64, y: f64) -> DVec3 {
    let (phi, theta) = (TAU * (x / SKY.0 as f64 - 0.5), PI * y / SKY.1 as f64);
    DVec3::new(theta.sin() * phi.sin(), theta.cos(), -theta.sin() * phi.cos())
}

fn tiny_sun() -> Result<Case, CheckError> {
    let (extinction, albedo) = (2.0, 0.9);
    let single = truth::integrate(40, |s| {
        let point = DVec3::new(0.0, 0.0, 0.5 - s);
        let mut received = 0.0;
        for row in 0..SKY.1 {
            for column in 0..SKY.0 {
                // The phase function is steep around the forward direction.
                let ahead = -direction(column as f64 + 0.5, row as f64 + 0.5).z;
                let raster = if ahead > 0.9 { 8 } else { 2 };
                let radiance = if (column, row) == SUN { SUN_RADIANCE } else { SKY_RADIANCE };
                received += radiance
                    * truth::integrate(raster, |v| {
                        truth::integrate(raster, |u| {
                            let omega = direction(column as f64 + u, row as f64 + v);
                            // The solid angle per texel area decreases towards the poles.
                            let jacobian =
                                (TAU / SKY.0 as f64) * (PI / SKY.1 as f64) * (1.0 - omega.y * omega.y).sqrt();
                            let through = (-extinction * to_face(point, omega)).exp();
                            truth::henyey_greenstein(0.9, -omega.z) * through * jacobian
                        })
                    });
            }
        }
        (-extinction * s).exp() * extinction * albedo * received
    });
    let rest = format!(
        "[medium]
        extinction = {extinction:?}
        albedo = {albedo}
        phase = {{ kind = \"henyey-greenstein\", g = 0.9 }}
        [[lights]]
        kind = \"environment-map\"
        file = \"sky\"
        visible = false"
    );
    let mut texels = vec![[SKY_RADIANCE as f32; 3]; SKY.0 * SKY.1];
    texels[SUN.1 * SKY.0 + SUN.0] = [SUN_RADIANCE as f32; 3];
    let case = case("tiny-sun", &rest, Answer::uniform([single; 3], Layout::WHOLE))?;
    let panorama = Panorama::new(SKY.0, SKY.1, texels);
    Ok(match panorama {
        Some(panorama) => case.with_files(Library::default().with_panorama("sky", panorama)),
        None => case,
    })
}

/// Diffuse ground under a lamp, behind an absorbing cube: e^(−σ) · albedo/π · ∫ L cos θ dω, where the rays to
/// the lamp miss the cube.
fn diffuse_ground() -> Result<Case, CheckError> {
    let (ground, center, radius) = (DVec3::new(0.0, 0.0, -2.0), DVec3::new(2.2, 0.3, -0.9), 0.8);
    let to = center - ground;
    let irradiance =
        truth::over_cap(to.normalize(), (radius / to.length()).asin(), 30, |omega| 4.0 * omega.z);
    let albedo = [0.3, 0.6, 0.9];
    let colour = albedo.map(|a| (-1.0f64).exp() * a / PI * irradiance);
    let rest = "[medium]
        extinction = 1.0
        albedo = 0.0
        [[lights]]
        kind = \"sphere\"
        center = [2.2, 0.3, -0.9]
        radius = 0.8
        radiance = 4.0
        [[objects]]
        kind = \"ground\"
        point = [0.0, 0.0, -2.0]
        normal = [0.0, 0.0, -1.0]
        albedo = { rgb = [0.3, 0.6, 0.9] }";
    case("diffuse-ground", rest, Answer::uniform(colour, Layout::WHOLE))
}

/// A lamp inside the medium that it lights: attenuation between the lamp and the scattering vertex matters.
fn lamp_inside() -> Result<Case, CheckError> {
    let center = DVec3::new(0.28, 0.0, -0.1);
    let radius = 0.24;
    let sigma = [0.5, 2.0, 5.0];
    let colour = sigma.map(|extinction| {
        truth::integrate(100, |s| {
            let point = DVec3::new(0.0, 0.0, 0.5 - s);
            let to = center - point;
            let half_angle = (radius / to.length()).asin();
            let light = Disc { axis: to.normalize(), half_angle, radiance: 4.0 };
            let received = truth::over_cap(light.axis, light.half_angle, 14, |omega| {
                let along = to.dot(omega);
                let off = (to.length_squared() - along * along).max(0.0);
                let distance = along - (radius * radius - off).max(0.0).sqrt();
                isotropic(0.0) * light.radiance * (-extinction * distance).exp()
            });
            (-extinction * s).exp() * extinction * 0.9 * received
        })
    });
    let rest = "[medium]
        extinction = { rgb = [0.5, 2.0, 5.0] }
        albedo = 0.9
        majorant = { factor = 1.3 }
        [[lights]]
        kind = \"sphere\"
        center = [0.28, 0.0, -0.1]
        radius = 0.24
        radiance = 4.0
        visible = false";
    case("lamp-inside", rest, Answer::uniform(colour, Layout::WHOLE))
}

fn cases() -> Result<Vec<Case>, CheckError> {
    // Estimators without next-event estimation need thirty million paths for the tiny sun and for the lamp
    // beside the ground.
    Ok(vec![
        two_powers()?.among(&CONNECTING_AND_ONE),
        occluder()?.among(&CONNECTING_AND_ONE),
        tiny_sun()?.among(&CONNECTING),
        lamp_inside()?.among(&CONNECTING_AND_ONE),
        diffuse_ground()?.among(&CONNECTING),
    ])
}
