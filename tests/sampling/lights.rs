//! Lights of every kind, near, far and at grazing angles, from several points.

use glam::{Vec2, Vec3};
use majorant_core::io::Library;
use majorant_core::light::{Emitter, Light, LightPoint, LightSample, LobeParts};
use majorant_core::math::{Ray, Sampler};
use majorant_core::phase::{Phase, PhaseDoc};
use majorant_core::scene::{
    LightDoc, ObjectDoc, PlacementDoc, Scene, SceneDoc, ShapeDoc, SurfaceEmissionDoc, build,
};
use majorant_tests::chi2::Family;
use std::path::Path;

/// Points from which lights are sampled.
const FROM: [Vec3; 3] = [Vec3::ZERO, Vec3::new(0.3, -0.4, 0.2), Vec3::new(-0.9, 0.5, -0.7)];

/// Writes a coarse environment map with a sun and black texels, and a fine one that is bright only in a
/// narrow stripe.
fn write_skies(folder: &Path) {
    let coarse = |x: usize, y: usize| match (x, y) {
        (11, 2) => (90.0f32, 80.0f32, 60.0f32),
        (3..=6, 1..=5) => (0.0, 0.0, 0.0),
        _ => (0.2 * (1 + x % 5) as f32, 0.3 + 0.1 * y as f32, 0.5),
    };
    exr::prelude::write_rgb_file(folder.join("coarse.exr"), 16, 8, coarse).unwrap();
    let fine = |x: usize, y: usize| {
        let v = if (20..23).contains(&x) && (3..9).contains(&y) { 40.0f32 + y as f32 } else { 0.01 };
        (v, v, v)
    };
    exr::prelude::write_rgb_file(folder.join("fine.exr"), 64, 32, fine).unwrap();
}

/// A light, or an object that emits.
#[derive(Clone)]
enum Emitting {
    Light(LightDoc),
    Object(ObjectDoc),
}

/// Part of a sphere about the origin as a mesh whose outer side is the inner side of the sphere, so that all of
/// it is seen from every point inside; the rows of triangles differ in size.
fn dome() -> String {
    let mut text = String::new();
    let (rows, columns) = (5, 7);
    for row in 0..=rows {
        for column in 0..=columns {
            let theta = 0.9 * (row as f32 / rows as f32).powi(2);
            let phi = 4.0 * column as f32 / columns as f32;
            let (sin, cos) = theta.sin_cos();
            text += &format!("v {} {} {}\n", 2.0 * sin * phi.cos(), 2.0 * sin * phi.sin(), 2.0 * cos);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let a = row * (columns + 1) + column + 1;
            let b = a + columns + 1;
            text += &format!("f {a} {} {b}\nf {b} {} {}\n", a + 1, a + 1, b + 1);
        }
    }
    text
}

/// Objects of every kind that can emit.
fn emitting_objects() -> Vec<(String, Emitting)> {
    let mut objects = Vec::new();
    let mut add = |name: &str, shape: ShapeDoc| {
        let emission = Some(SurfaceEmissionDoc::default());
        objects.push((name.to_owned(), Emitting::Object(ObjectDoc { emission, ..ObjectDoc::new(shape) })));
    };
    let [center, up] = [[0.2, 1.6, 0.3], [0.0, 1.0, 0.0]];
    add("Disk", ShapeDoc::Disk { center, normal: [-0.2, -1.0, 0.1], radius: 0.8 });
    add("Emitting sphere", ShapeDoc::Sphere { center, radius: 0.4 });
    let target = [0.0; 3];
    add("Emitting rectangle", ShapeDoc::Rectangle { center, target, up, size: [0.7, 1.5] });
    let mesh = |placement| ShapeDoc::Mesh { file: "dome.obj".into(), placement };
    add("Mesh", mesh(PlacementDoc::default()));
    // Stretched and mirrored, it still encloses the points.
    let scale = [1.5, -1.1, 1.2];
    let rotate_deg = [0.0, 0.0, 25.0];
    add("Mesh, mirrored", mesh(PlacementDoc { scale, rotate_deg, ..PlacementDoc::default() }));
    objects
}

/// One light of each kind, and difficult cases.
fn lights() -> Vec<(String, Emitting)> {
    let map = |file: &str, rotate_deg| LightDoc::EnvironmentMap {
        file: file.into(),
        rotate_deg,
        scale: 1.5,
        visible: true,
        enabled: true,
    };
    let mut lights = Vec::new();
    for (name, mut doc) in LightDoc::templates() {
        if let LightDoc::EnvironmentMap { file, .. } = &mut doc {
            *file = "coarse.exr".into();
        }
        lights.push((name.to_owned(), Emitting::Light(doc.clone())));
        let mut vary = |what: &str, change: &dyn Fn(&mut LightDoc)| {
            let mut doc = doc.clone();
            change(&mut doc);
            lights.push((format!("{name}, {what}"), Emitting::Light(doc)));
        };
        match &doc {
            LightDoc::Rectangle { .. } => vary("wide and at a slant", &|doc| {
                if let LightDoc::Rectangle { target, size, .. } = doc {
                    (*target, *size) = ([1.2, 0.0, -1.5], [2.0, 0.4]);
                }
            }),
            LightDoc::Sphere { .. } => {
                let mut at = |what: &str, place: [f32; 3], r: f32| {
                    vary(what, &|doc| {
                        if let LightDoc::Sphere { center, radius, .. } = doc {
                            (*center, *radius) = (place, r);
                        }
                    });
                };
                at("near", [0.1, 1.3, 0.2], 1.2);
                at("far", [300.0, 400.0, -100.0], 0.5);
            }
            LightDoc::Sun { .. } => vary("wide", &|doc| {
                if let LightDoc::Sun { toward, angular_diameter_deg, .. } = doc {
                    (*toward, *angular_diameter_deg) = ([-0.2, -0.1, -0.9], 30.0);
                }
            }),
            LightDoc::Environment { .. } => {}
            LightDoc::EnvironmentMap { .. } => {
                vary("turned", &|doc| *doc = map("coarse.exr", 40.0));
                vary("with a narrow stripe", &|doc| *doc = map("fine.exr", -75.0));
            }
        }
    }
    lights.extend(emitting_objects());
    lights
}

/// A scene with one light and no occluders.
fn scene(light: &Emitting, folder: &Path) -> Scene {
    let mut doc = SceneDoc { lights: Vec::new(), ..SceneDoc::default() };
    match light.clone() {
        Emitting::Light(light) => doc.lights.push(light),
        Emitting::Object(object) => doc.objects.push(object),
    }
    let mut library = Library::default().with_base(folder).with_volume("dome.obj", dome().into_bytes());
    build(&doc, &mut library).unwrap_or_else(|e| panic!("{e}"))
}

/// Point of the emitting side of the light along a ray; `None` if the ray misses it.
fn reach(scene: &Scene, ray: &Ray) -> Option<LightPoint> {
    let end = scene.nearest_surface(ray, f32::INFINITY, false);
    let met = match end.light() {
        Some(_) => ray.direction.dot(end.normal()) < 0.0,
        None => end.is_none() && scene.lights[0].is_behind(ray.direction),
    };
    met.then(|| end.light_point(ray))
}

/// Checks the density and the distance of a sample.
fn check(name: &str, scene: &Scene, from: Vec3, s: &LightSample) {
    let (direction, distance) = (s.point.direction, s.point.distance);
    let density = scene.lights[0].density(from, &s.point);
    assert!((s.density / density - 1.0).abs() < 1e-3, "{name}: density {} is not {density}", s.density);
    // Grazing rays may miss by rounding; these are covered by the χ² test.
    if let Some(met) = reach(scene, &Ray { origin: from, direction }) {
        let agrees = met.distance == distance || (met.distance - distance).abs() < 2e-3 * distance;
        assert!(agrees, "{name}: a sample at {distance} where the light is at {}", met.distance);
    }
}

#[test]
fn directions_towards_every_light_follow_their_density() {
    let folder = tempfile::tempdir().unwrap();
    write_skies(folder.path());
    let mut family = Family::default();
    for (seed, (name, doc)) in (0..).zip(lights()) {
        let scene = scene(&doc, folder.path());
        let light: &Light = &scene.lights[0];
        for (pixel, from) in (0..).zip(FROM) {
            let name = format!("{name} from {from}");
            let mut sampler = Sampler::new(seed, pixel, 2);
            let draw = || {
                let s = light.sample(from, sampler.next_2d()).expect("the point is lit");
                check(&name, &scene, from, &s);
                s.point.direction
            };
            let density = |direction: Vec3| {
                let met = reach(&scene, &Ray { origin: from, direction });
                met.map_or(0.0, |met| light.density(from, &met))
            };
            family.directions(&name, draw, density);
        }
    }
    family.judge();
}

/// Incident directions: at a light, past it, away from it, and along coordinate axes.
fn incoming(scene: &Scene, from: Vec3) -> Vec<Vec3> {
    let mut sampler = Sampler::new(0, 0, 0);
    let at = scene.lights[0].sample(from, sampler.next_2d()).expect("the point is lit").point.direction;
    let beside = (at + 0.3 * at.any_orthonormal_vector()).normalize();
    let across = at.any_orthonormal_vector();
    vec![at, beside, across, -beside, -at, Vec3::X, Vec3::NEG_Z]
}

/// Product sampling is compared with light sampling by an integral over the light, and with phase function
/// sampling by an integral over the part of the lobe around it.
#[test]
fn products_of_light_and_lobe_are_drawn_by_their_densities() {
    let folder = tempfile::tempdir().unwrap();
    write_skies(folder.path());
    let mut family = Family::default();
    let mut compare = |name: &str, difference: &mut dyn FnMut() -> f64| {
        let differences: Vec<f64> = (0..20_000).map(|_| difference()).collect();
        // If neither estimate has noise, they differ only by rounding.
        if differences.iter().any(|d| d.abs() > 1e-4) {
            family.mean(name, &differences, 0.0);
        }
    };
    for (seed, (name, doc)) in (0..).zip(lights()) {
        let scene = scene(&doc, folder.path());
        let light = &scene.lights[0];
        for (pixel, from) in (0..).zip(FROM) {
            for (sample, omega_in) in (0..).zip(incoming(&scene, from)) {
                let g = [0.0, 0.3, 0.85, 0.99, -0.7][sample as usize % 5];
                let name = format!("{name} from {from} along {omega_in}, g = {g}");
                let phase = Phase::new(&PhaseDoc::HenyeyGreenstein { g });
                let parts = LobeParts::new(&scene.lights, from, omega_in, g);
                let mut sampler = Sampler::new(seed, pixel, sample);
                let lobe = |direction: Vec3| f64::from(phase.density(omega_in, direction));

                let mut by_light = || {
                    let s = parts.sample_light(0, light, from, sampler.next_2d());
                    let product = s.map_or(0.0, |s| {
                        let again = parts.light_density(0, light, from, &s.point);
                        assert!(
                            (s.density / again - 1.0).abs() < 1e-3,
                            "{name}: {} is not {again}",
                            s.density
                        );
                        lobe(s.point.direction).sqrt() / f64::from(s.density)
                    });
                    let s = light.sample(from, sampler.next_2d()).expect("the point is lit");
                    let inside = doc_is_around(&doc) || parts.density(s.point.direction) > 0.0;
                    assert!(
                        inside,
                        "{name}: the part of the lobe does not contain the light at {}",
                        s.point.direction
                    );
                    product - lobe(s.point.direction).sqrt() / f64::from(s.density)
                };
                compare(&format!("{name}: connections"), &mut by_light);

                if doc_is_around(&doc) {
                    continue;
                }
                let mut by_lobe = || {
                    let direction = parts.sample(sampler.next_2d());
                    let density = f64::from(parts.density(direction));
                    let product = if density > 0.0 { lobe(direction) / density } else { 0.0 };
                    let (direction, _) = phase.sample(omega_in, sampler.next_2d());
                    product - f64::from(parts.density(direction) > 0.0)
                };
                compare(&format!("{name}: directions"), &mut by_lobe);
            }
        }
    }
    family.judge();
}

fn doc_is_around(light: &Emitting) -> bool {
    use LightDoc::{Environment, EnvironmentMap};
    matches!(light, Emitting::Light(Environment { .. } | EnvironmentMap { .. }))
}

#[test]
fn a_rectangle_is_dark_behind_and_a_sphere_inside() {
    for (name, doc) in LightDoc::templates() {
        let (center, dark) = match doc {
            LightDoc::Rectangle { center, .. } => (Vec3::from(center), Vec3::from(center) * 1.5),
            LightDoc::Sphere { center, radius, .. } => {
                (Vec3::from(center), Vec3::from(center) + 0.3 * radius)
            }
            _ => continue,
        };
        let light = &scene(&Emitting::Light(doc), Path::new("")).lights[0];
        for u in [Vec2::ZERO, Vec2::new(0.3, 0.7)] {
            assert!(light.sample(dark, u).is_none(), "{name}");
        }
        let to_light = center - dark;
        let distance = to_light.length();
        let at = LightPoint { direction: to_light / distance, distance, triangle: 0 };
        assert_eq!(light.density(dark, &at), 0.0, "{name}");
    }
}
