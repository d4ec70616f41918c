//! Every light: samples reach it, densities agree, and the density integrates to one.

use super::*;
use crate::math::{Ray, Sampler, uniform_direction};
use crate::spectrum::{RgbChannels, Spectrum};
use crate::surface::{Rectangle, Shape, Sphere};
use std::f32::consts::TAU;
use std::sync::Arc;

fn panorama() -> EnvironmentMap {
    let (width, height) = (8, 5);
    let mut texels = vec![[0.2, 0.1, 0.3]; width * height];
    texels[2 * width + 5] = [90.0, 60.0, 20.0];
    texels[4] = [0.0; 3];
    let panorama = Panorama::new(width, height, texels).expect("not black");
    EnvironmentMap { panorama: Arc::new(panorama), scale: 1.5, rotate: 0.7 }
}

fn lights() -> Vec<(LightKind, Option<Shape>)> {
    // Seen at a slant, so that a forgotten cosine shows.
    let rectangle =
        Rectangle::facing(Vec3::new(0.4, 1.2, 0.1), Vec3::new(1.4, 0.5, 0.1), Vec3::Y, [1.0, 0.6]);
    let sphere = Sphere { center: Vec3::new(-0.5, 0.6, 1.0), radius: 0.4 };
    let one = Spectrum::constant(1.0);
    vec![
        (
            LightKind::Rectangle(RectangleLight { shape: rectangle, radiance: one.clone() }),
            Some(Shape::Rectangle(rectangle)),
        ),
        (
            LightKind::Sphere(SphereLight { shape: sphere, radiance: one.clone() }),
            Some(Shape::Sphere(sphere)),
        ),
        (LightKind::Sun(Sun::new(Vec3::new(0.3, 0.9, -0.2), 20.0, one.clone())), None),
        (LightKind::Environment(Environment { radiance: one }), None),
        (LightKind::EnvironmentMap(panorama()), None),
    ]
}

#[test]
fn samples_reach_the_light_with_the_density_that_they_claim() {
    let from = Vec3::new(0.05, -0.1, 0.02);
    for (kind, shape) in lights() {
        let light = Light { kind, visible: true };
        let mut sampler = Sampler::new(3, 1, 4);
        for _ in 0..2000 {
            let s = light.sample(from, sampler.next_2d()).expect("the point is lit");
            assert!((s.direction.length() - 1.0).abs() < 1e-5);
            let density = light.density(from, s.direction, s.distance);
            assert!((s.density / density - 1.0).abs() < 1e-3, "{} {density}", s.density);
            match &shape {
                Some(shape) => {
                    let ray = Ray { origin: from, direction: s.direction };
                    // Grazing rays may miss by rounding; all others meet the shape where they said.
                    if let Some(hit) = shape.intersect(&ray, f32::INFINITY) {
                        assert!((hit.t - s.distance).abs() < 2e-3 * s.distance, "{light:?}");
                    }
                }
                None => assert!(light.is_behind(s.direction) || matches!(light.kind, LightKind::Sun(_))),
            }
        }
    }
}

/// E[1/density] over drawn directions is the solid angle of the light's support, and ∫ density is 1.
#[test]
fn densities_integrate_to_one_over_the_sphere() {
    let from = Vec3::new(0.05, -0.1, 0.02);
    for (kind, shape) in lights() {
        let light = Light { kind, visible: true };
        let mut sampler = Sampler::new(5, 9, 2);
        let n = 400_000;
        let (mut sum, mut sum2) = (0.0f64, 0.0f64);
        for _ in 0..n {
            let direction = uniform_direction(sampler.next_2d());
            let distance = match &shape {
                Some(shape) => {
                    shape.intersect(&Ray { origin: from, direction }, f32::INFINITY).map(|hit| hit.t)
                }
                None => light.is_behind(direction).then_some(f32::INFINITY),
            };
            let x = distance.map_or(0.0, |d| f64::from(light.density(from, direction, d) * 2.0 * TAU));
            sum += x;
            sum2 += x * x;
        }
        let mean = sum / f64::from(n);
        let error = ((sum2 / f64::from(n) - mean * mean) / f64::from(n)).sqrt();
        // Fixed seed; five lights at 4.5 standard errors.
        assert!((mean - 1.0).abs() < 4.5 * error + 1e-6, "{light:?}: {mean} ± {error}");
    }
}

#[test]
fn a_sun_gives_the_irradiance_that_was_asked_for_at_any_diameter() {
    for diameter in [0.1, 0.53, 5.0] {
        let sun = Sun::new(Vec3::Y, diameter, Spectrum::constant(2.0));
        let components = RgbChannels::<1> { channel: [0] };
        let s = sun.sample(Vec3::ZERO, Vec2::new(0.5, 0.5)).expect("always lit");
        let radiance = sun.radiance(s.direction, &components).hero();
        let half = 0.5 * f64::from(diameter).to_radians();
        let irradiance = f64::from(radiance) * std::f64::consts::PI * half.sin().powi(2);
        assert!((irradiance - 2.0).abs() < 1e-3, "{irradiance}");
        assert!(sun.covers(s.direction) && !sun.covers(Vec3::X));
    }
}
