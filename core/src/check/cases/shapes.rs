//! Closed shapes filled by media, and surfaces that shine.
//!
//! Absorbers within a sphere, a turned box and a mesh that a ray enters twice: e^(−τ) with the sum of the chords,
//! overlapping, from inside, and of a grid that a sphere cuts. One uniform cube as a box of its own, as a box
//! object, as a mesh and as two halves has the same single scattering, by the quadrature of
//! `single_scattering.rs`; a sphere has that of
//!
//! ```text
//!   L = ∫ e^(−σ s) σ α ∫ p Li(ω) e^(−σ d(s, ω)) dω ds
//! ```
//!
//! with d the distance to the sphere. A white furnace stays one. Light of a disk, a sphere, a box and a mesh is
//! integrated over their areas,
//!
//! ```text
//!   Li dω = Le cos θ / r² dA
//! ```
//!
//! A surface that emits e and reflects ρ of a sky of radiance 1 has the radiance e + ρ.

use super::super::truth;
use super::super::{Answer, Case, CheckError, Family, Layout, fixture};
use super::single_scattering::{Cube, QUADRATURE, sun, to_face};
use super::{
    ASIDE, AXIS, CONNECTING, CONNECTING_AND_ONE, FAMILIES_WITH_DISTANCE_SAMPLING, SEVERAL_COMPONENTS,
    UNIDIRECTIONAL_AND_FULL,
};
use crate::io::Library;
use crate::scene::{
    DirectionSampling, DistanceSampling, LightSampling, LightSelection, MaterialDoc, Mode, ObjectDoc,
    ShapeDoc, Within,
};
use crate::spectrum::SpectrumDoc;
use glam::DVec3;
use std::f64::consts::PI;

pub(super) const FAMILY: Family = Family {
    id: "shapes",
    about: "Media within spheres, boxes and meshes; surfaces that emit: chords, furnaces, single scattering.",
    deep_only: false,
    cases,
};

/// Paths per estimator and case: a deep check of all shapes would take as long as that of all other families.
const BUDGET: u64 = 400_000;

fn meshes() -> Library {
    let obj = |text: String| text.into_bytes();
    Library::default()
        .with_volume("cube.obj", obj(fixture::obj_box(DVec3::splat(-0.5), DVec3::splat(0.5))))
        .with_volume("two.obj", obj(fixture::two_boxes()))
        .with_volume("ring.obj", obj(fixture::torus(1.0, 0.45, [24, 12])))
        .with_volume("smooth.obj", obj(fixture::smooth_octahedron()))
}

const BALL: [f64; 3] = [0.2, 1.0, 0.5];
const BOX: [f64; 3] = [0.8, 0.1, 0.4];
const TWO: [f64; 3] = [0.3, 0.2, 0.6];

/// A ball off the axis, a turned box and two boxes of one mesh, along the axis.
fn absorbers() -> Result<Vec<Case>, CheckError> {
    let medium = |name: &str, sigma: [f64; 3], rest: &str| {
        format!(
            "[[media]]
            name = \"{name}\"
            within = \"{name}\"
            extinction = {{ rgb = {sigma:?} }}
            albedo = 0.0
            {rest}\n"
        )
    };
    let toml = format!(
        "{AXIS}
        {}{}{}
        [[objects]]
        name = \"ball\"
        kind = \"sphere\"
        center = [0.3, 0.0, 0.2]
        radius = 0.5
        material = {{ kind = \"interface\" }}
        [[objects]]
        name = \"box\"
        kind = \"box\"
        center = [0.0, 0.0, -0.1]
        size = [2.0, 1.0, 0.6]
        rotate_deg = [60.0, 0.0, 0.0]
        material = {{ kind = \"interface\" }}
        [[objects]]
        name = \"two\"
        kind = \"mesh\"
        file = \"two.obj\"
        placement = {{ rotate_deg = [0.0, 90.0, 0.0] }}
        material = {{ kind = \"interface\" }}
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\"",
        medium("ball", BALL, ""),
        medium("box", BOX, "majorant = { factor = 1.7 }"),
        medium("two", TWO, ""),
    );
    // Chords along the z axis: of the ball, of the box (half of its size over cos 60°), of the two boxes.
    let chord = 2.0 * (0.5f64.powi(2) - 0.3f64.powi(2)).sqrt();
    let through = |lengths: [f64; 3]| {
        let depth = |c: usize| BALL[c] * lengths[0] + BOX[c] * lengths[1] + TWO[c] * lengths[2];
        Answer::uniform([0, 1, 2].map(|c| (-depth(c)).exp()), Layout::WHOLE)
    };
    // Along z, a box turned by 60° about x is bounded by its faces of ±y at 0.5/sin 60°.
    let tilted = 2.0 * 0.5 / 60f64.to_radians().sin();
    let tilted = tilted.min(2.0 * 0.3 / 60f64.to_radians().cos());
    let lengths = [chord, tilted, fixture::TWO_BOXES_LENGTH];
    let whole = Case::new("shapes/absorbers", &toml, through(lengths))?.with_files(meshes());
    // From the centre of the ball, which lies in the gap between the two boxes.
    let inside = whole.varied("shapes/absorbers-inside", |doc| {
        (doc.camera.origin, doc.camera.target) = ([0.0, 0.0, 0.2], [0.0, 0.0, -1.0]);
    });
    let behind = [0.5 * chord, 0.5 * tilted + 0.3, fixture::TWO_BOXES_BELOW];
    let alone = whole.varied("shapes/absorbers-mesh", |doc| {
        doc.media.retain(|medium| medium.name == "two");
    });
    let exceeded = whole.varied("shapes/absorbers-exceeded", |doc| {
        doc.media.iter_mut().for_each(|medium| medium.majorant.factor = 0.7);
    });
    Ok(vec![
        inside.answered(through(behind)),
        alone.answered(through([0.0, 0.0, lengths[2]])),
        exceeded.among(&SEVERAL_COMPONENTS),
        whole,
    ])
}

/// A rough grid that a sphere cuts, and one in a mesh.
fn cut_grid() -> Result<Vec<Case>, CheckError> {
    let rough = fixture::rough_lattice([3, 4, 5], 6);
    let toml = format!(
        "{AXIS}
        [[media]]
        extinction = {{ rgb = [1.0, 2.0, 4.0] }}
        albedo = 0.0
        within = \"ball\"
        density = {{ kind = \"grid\", file = \"rough.npy\" }}
        placement = {{ fit = 1.0 }}
        [[objects]]
        name = \"ball\"
        kind = \"sphere\"
        center = [0.0, 0.1, 0.15]
        radius = 0.3
        material = {{ kind = \"interface\" }}
        [[objects]]
        name = \"cube\"
        kind = \"mesh\"
        file = \"cube.obj\"
        placement = {{ scale = [1.0, 1.0, 0.4], translate = [0.0, 0.0, 0.1] }}
        material = {{ kind = \"interface\" }}
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\""
    );
    // The longest side has 5 samples, so that a sample is a fifth of the unit apart.
    let n = DVec3::new(3.0, 4.0, 5.0);
    let held = |i: i64, n: i64| Some(i.clamp(0, n - 1));
    let column = |from: f64, to: f64| {
        let density = |z: f64| rough.at(DVec3::new(0.0, 0.0, z) * 5.0 + 0.5 * n - 0.5, held);
        (to - from) * truth::integrate(400, |t| density(from + (to - from) * t))
    };
    let answer = |from: f64, to: f64| {
        let depth = column(from, to);
        Answer::uniform([1.0, 2.0, 4.0].map(|sigma: f64| (-sigma * depth).exp()), Layout::WHOLE).within(1e-4)
    };
    let half = (0.3f64.powi(2) - 0.1f64.powi(2)).sqrt();
    let library = meshes().with_volume("rough.npy", rough.npy());
    let ball =
        Case::new("shapes/grid-in-sphere", &toml, answer(0.15 - half, 0.15 + half))?.with_files(library);
    let mesh = ball.varied("shapes/grid-in-mesh", |doc| doc.media[0].within = Within::Object("cube".into()));
    let outside = ball.varied("shapes/grid-outside", |doc| {
        if let ShapeDoc::Sphere { center, .. } = &mut doc.objects[0].shape {
            *center = [0.0, 0.0, 1.5];
        }
    });
    let outside = outside.answered(Answer::uniform([1.0; 3], Layout::WHOLE));
    Ok(vec![mesh.answered(answer(-0.1, 0.3)), outside.among(&UNIDIRECTIONAL_AND_FULL), ball])
}

fn interface(name: &str, shape: ShapeDoc) -> ObjectDoc {
    ObjectDoc { name: name.into(), material: MaterialDoc::Interface {}, ..ObjectDoc::new(shape) }
}

/// The unit cube in four forms, and a ball.
fn single() -> Result<Vec<Case>, CheckError> {
    let sigma = [1.0, 2.0, 4.0];
    let toml = format!(
        "{AXIS}
        [[media]]
        extinction = {{ rgb = {sigma:?} }}
        albedo = 0.8
        phase = {{ kind = \"henyey-greenstein\", g = 0.4 }}
        [[lights]]
        kind = \"sun\"
        toward = [0.6, 0.1, 0.8]
        angular_diameter_deg = 110.0
        irradiance = 2.0
        visible = false
        [estimator]
        mode = \"rgb\"
        max_depth = 2"
    );
    let toward = DVec3::new(0.6, 0.1, 0.8);
    let phase = |cosine: f64| truth::henyey_greenstein(0.4, cosine);
    let cube =
        sigma.map(|extinction| Cube { extinction, albedo: 0.8 }.single(phase, |_| sun(toward, 110.0, 2.0)));
    let answer = Answer::uniform(cube, Layout::WHOLE).within(QUADRATURE);
    let own = Case::new("shapes/single-own-box", &toml, answer)?.with_files(meshes());
    let whole = || ShapeDoc::Box { center: [0.0; 3], size: [1.0; 3], rotate_deg: [0.0; 3] };
    let as_box = own.varied("shapes/single-box", |doc| {
        doc.media[0].within = Within::Object("b".into());
        doc.objects.push(interface("b", whole()));
    });
    let as_mesh = as_box.varied("shapes/single-mesh", |doc| {
        doc.objects[0].shape = ShapeDoc::Mesh { file: "cube.obj".into(), placement: Default::default() };
    });
    let halves = as_box.varied("shapes/single-halves", |doc| {
        let half =
            |x: f32| ShapeDoc::Box { center: [x, 0.0, 0.0], size: [0.5, 1.0, 1.0], rotate_deg: [0.0; 3] };
        doc.objects[0].shape = half(-0.25);
        doc.objects.push(interface("c", half(0.25)));
        let mut other = doc.media[0].clone();
        (other.name, other.within) = ("other".into(), Within::Object("c".into()));
        doc.media.push(other);
    });

    let radius = 0.5;
    let ball = |extinction: f64| {
        let light = sun(toward, 110.0, 2.0);
        2.0 * radius
            * truth::integrate(60, |u| {
                let s = 2.0 * radius * u;
                let point = DVec3::new(0.0, 0.0, radius - s);
                let received = truth::over_cap(light.axis, light.half_angle, 16, |omega| {
                    let along = point.dot(omega);
                    let exit = -along + (along * along + radius * radius - point.length_squared()).sqrt();
                    phase(-omega.z) * light.radiance * (-extinction * exit).exp()
                });
                (-extinction * s).exp() * extinction * 0.8 * received
            })
    };
    let answer = Answer::uniform(sigma.map(ball), Layout::WHOLE).within(QUADRATURE);
    let in_ball = as_box.varied("shapes/single-sphere", |doc| {
        doc.objects[0].shape = ShapeDoc::Sphere { center: [0.0; 3], radius: 0.5 };
    });
    Ok(vec![
        as_mesh.among(&CONNECTING_AND_ONE),
        halves.among(&CONNECTING_AND_ONE),
        in_ball.answered(answer).among(&CONNECTING_AND_ONE),
        as_box.among(&CONNECTING_AND_ONE),
    ])
}

/// Media within a sphere, a mesh and a box that overlap, among white surfaces of every kind.
fn furnace() -> Result<Vec<Case>, CheckError> {
    let toml = format!(
        "{ASIDE}
        [[media]]
        name = \"ring\"
        within = \"ring\"
        extinction = {{ rgb = [3.0, 6.0, 1.0] }}
        albedo = 1.0
        phase = {{ kind = \"henyey-greenstein\", g = 0.6 }}
        [[media]]
        name = \"ball\"
        within = \"ball\"
        extinction = {{ rgb = [1.0, 0.5, 4.0] }}
        albedo = 1.0
        [[objects]]
        name = \"ring\"
        kind = \"mesh\"
        file = \"ring.obj\"
        placement = {{ fit = 1.2, rotate_deg = [30.0, 0.0, 20.0] }}
        material = {{ kind = \"interface\" }}
        [[objects]]
        name = \"ball\"
        kind = \"sphere\"
        center = [0.25, 0.1, 0.0]
        radius = 0.3
        material = {{ kind = \"interface\" }}
        [[objects]]
        kind = \"mesh\"
        file = \"cube.obj\"
        placement = {{ scale = [0.2, 0.3, -0.1], rotate_deg = [10.0, 40.0, 0.0], translate = [-0.1, 0.2, 0.1] }}
        material = {{ kind = \"diffuse\", albedo = 1.0 }}
        [[objects]]
        kind = \"sphere\"
        center = [0.3, -0.1, 0.2]
        radius = 0.12
        material = {{ kind = \"diffuse\", albedo = 1.0 }}
        [[objects]]
        kind = \"disk\"
        center = [0.0, -0.45, 0.0]
        radius = 0.5
        material = {{ kind = \"diffuse\", albedo = 1.0 }}
        [[objects]]
        kind = \"rectangle\"
        center = [-0.5, 0.1, -0.3]
        target = [0.0, 0.0, 0.0]
        size = [0.5, 0.4]
        material = {{ kind = \"diffuse\", albedo = 1.0 }}
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\""
    );
    let case = Case::new("shapes/furnace", &toml, Answer::Agreement)?.in_blocks(2, 2).with_files(meshes());
    let case = case.clone().answered(Answer::uniform([1.0; 3], case.layout));
    let spectral = case.varied("shapes/furnace-spectral", |doc| doc.estimator.mode = Mode::Spectral);
    let spectral = spectral.answered(Answer::uniform(truth::white(), case.layout));
    let decomposed = case.varied("shapes/furnace-decomposition", |doc| {
        doc.estimator.distances = DistanceSampling::Decomposition;
        doc.media[0].majorant.factor = 2.0;
    });
    Ok(vec![
        spectral.among(&UNIDIRECTIONAL_AND_FULL),
        decomposed.among(&FAMILIES_WITH_DISTANCE_SAMPLING),
        case.among(&SEVERAL_COMPONENTS),
    ])
}

/// A part of a plane that emits on the side of its normal: a corner, two edges and the radiance.
struct Patch {
    corner: DVec3,
    edges: [DVec3; 2],
}

impl Patch {
    /// ∫ f(point) cos θ / r² dA as seen from `from`; nothing from behind.
    fn over(&self, from: DVec3, raster: u32, f: impl Fn(DVec3) -> f64) -> f64 {
        let [u, v] = self.edges;
        let area = u.cross(v);
        truth::integrate(raster, |a| {
            truth::integrate(raster, |b| {
                let to = self.corner + u * a + v * b - from;
                let squared = to.length_squared();
                let cosine = -to.dot(area) / squared.sqrt();
                if cosine <= 0.0 { 0.0 } else { f(to / squared.sqrt()) * cosine / squared }
            })
        })
    }
}

/// The outer faces of a box.
fn faces(center: DVec3, half: DVec3) -> Vec<Patch> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let (n, u, v) = (DVec3::AXES[axis], DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
            let (u, v) = (u * half.dot(u), v * half.dot(v));
            let corner = center + n * half.dot(n) * side - u - v;
            let edges = if side > 0.0 { [u * 2.0, v * 2.0] } else { [v * 2.0, u * 2.0] };
            faces.push(Patch { corner, edges });
        }
    }
    faces
}

/// Single scattering of light from surfaces beside the unit cube.
fn emitters() -> Result<Vec<Case>, CheckError> {
    let (sigma, g) = ([0.5, 1.5, 3.0], 0.3);
    let toml = format!(
        "{AXIS}
        [[media]]
        extinction = {{ rgb = {sigma:?} }}
        albedo = 0.8
        phase = {{ kind = \"henyey-greenstein\", g = {g:?} }}
        [estimator]
        mode = \"rgb\"
        max_depth = 2"
    );
    let from_patches = |patches: &[Patch], extinction: f64| {
        truth::integrate(40, |s| {
            let point = DVec3::new(0.0, 0.0, 0.5 - s);
            let received: f64 = patches
                .iter()
                .map(|patch| {
                    patch.over(point, 16, |omega| {
                        let through = (-extinction * to_face(point, omega)).exp();
                        truth::henyey_greenstein(g, -omega.z) * 2.0 * through
                    })
                })
                .sum();
            (-extinction * s).exp() * extinction * 0.8 * received
        })
    };
    let lamp = |shape: &str| {
        format!(
            "[[objects]]
            {shape}
            material = {{ kind = \"diffuse\", albedo = 0.0 }}
            emission = {{ radiance = 1.0, scale = 2.0, visible = false }}"
        )
    };
    let case = |name: &str, shape: &str, colour: [f64; 3]| {
        let answer = Answer::uniform(colour, Layout::WHOLE).within(QUADRATURE);
        Ok::<_, CheckError>(
            Case::new(format!("shapes/emitting-{name}"), &format!("{toml}\n{}", lamp(shape)), answer)?
                .with_files(meshes()),
        )
    };
    let mut cases = Vec::new();

    let (center, half) = (DVec3::new(1.6, 0.3, 0.4), DVec3::new(0.4, 0.8, 0.7));
    let patches = faces(center, half);
    let colour = sigma.map(|extinction| from_patches(&patches, extinction));
    let by_box = case("box", "kind = \"box\"\ncenter = [1.6, 0.3, 0.4]\nsize = [0.8, 1.6, 1.4]", colour)?;
    let placement = "placement = { scale = [0.8, 1.6, 1.4], translate = [1.6, 0.3, 0.4] }";
    let by_mesh = case("mesh", &format!("kind = \"mesh\"\nfile = \"cube.obj\"\n{placement}"), colour)?;
    let product = by_mesh.varied("shapes/emitting-mesh-product", |doc| {
        doc.estimator.light_sampling = LightSampling::Product;
        doc.estimator.directions = DirectionSampling::Product;
        doc.estimator.lights = LightSelection::Contribution;
        // A second, faint light in the same scene.
        let mut faint = doc.objects[0].clone();
        if let Some(emission) = &mut faint.emission {
            emission.scale = 0.0;
        }
        if let ShapeDoc::Mesh { placement, .. } = &mut faint.shape {
            placement.translate = [-4.0, 0.0, 0.0];
        }
        doc.objects.push(faint);
    });
    let mirrored = by_mesh.varied("shapes/emitting-mesh-mirrored", |doc| {
        if let ShapeDoc::Mesh { placement, .. } = &mut doc.objects[0].shape {
            placement.scale[1] *= -1.0;
        }
    });
    cases.extend([product.among(&CONNECTING), mirrored.among(&CONNECTING)]);
    cases.extend([by_box.among(&CONNECTING), by_mesh.among(&CONNECTING)]);

    // A disk that faces the cube, by polar coordinates on it.
    let (center, radius) = (DVec3::new(1.2, 0.2, 0.1), 0.9);
    let normal = DVec3::new(-1.0, -0.2, 0.3).normalize();
    let colour = sigma.map(|extinction| {
        let (u, v) = normal.any_orthonormal_pair();
        truth::integrate(40, |s| {
            let point = DVec3::new(0.0, 0.0, 0.5 - s);
            let received = truth::integrate(16, |a| {
                let r = radius * a;
                truth::integrate(32, |b| {
                    let (sin, cos) = (2.0 * PI * b).sin_cos();
                    let to = center + (u * cos + v * sin) * r - point;
                    let (distance, omega) = (to.length(), to.normalize());
                    let through = (-extinction * to_face(point, omega)).exp();
                    let cosine = -omega.dot(normal);
                    truth::henyey_greenstein(g, -omega.z) * 2.0 * through * cosine / distance.powi(2)
                        * (2.0 * PI * r * radius)
                })
            });
            (-extinction * s).exp() * extinction * 0.8 * received
        })
    });
    let disk = "kind = \"disk\"\ncenter = [1.2, 0.2, 0.1]\nnormal = [-1.0, -0.2, 0.3]\nradius = 0.9";
    cases.push(case("disk", disk, colour)?.among(&CONNECTING));
    Ok(cases)
}

/// Radiance of a wide rectangle that emits and reflects, in front of the camera.
fn emits_and_reflects() -> Result<Vec<Case>, CheckError> {
    // In format 1, a scene without a medium has a default one.
    let axis = AXIS.replace("majorant = 1", "majorant = 2");
    let toml = format!(
        "{axis}
        [[objects]]
        kind = \"rectangle\"
        center = [0.0, 0.0, 0.0]
        target = [0.0, 0.3, 1.0]
        size = [1.0, 2.0]
        material = {{ kind = \"diffuse\", albedo = {{ rgb = [0.2, 0.5, 0.8] }} }}
        emission = {{ radiance = {{ rgb = [0.3, 0.2, 0.1] }} }}
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\""
    );
    let front =
        Case::new("shapes/emits-and-reflects", &toml, Answer::uniform([0.5, 0.7, 0.9], Layout::WHOLE))?;
    // Its back reflects and does not emit.
    let back = front.varied("shapes/emits-on-one-side", |doc| {
        if let ShapeDoc::Rectangle { target, .. } = &mut doc.objects[0].shape {
            *target = [0.0, -0.3, -1.0];
        }
    });
    let flat = front.varied("shapes/emitting-box-reflects", |doc| {
        doc.objects[0].shape =
            ShapeDoc::Box { center: [0.1, 0.2, 0.0], size: [2.0; 3], rotate_deg: [0.0, 20.0, 10.0] };
        doc.objects[0].material = MaterialDoc::Diffuse { albedo: SpectrumDoc::Rgb([0.2, 0.5, 0.8]) };
    });
    let back = back.answered(Answer::uniform([0.2, 0.5, 0.8], Layout::WHOLE));
    Ok(vec![back.among(&CONNECTING_AND_ONE), flat.among(&CONNECTING_AND_ONE), front])
}

/// All estimators agree where media fill meshes, and meshes shine in them and on smooth surfaces.
fn agreement() -> Result<Vec<Case>, CheckError> {
    let toml = format!(
        "{ASIDE}
        [[media]]
        within = \"ring\"
        extinction = {{ rgb = [2.0, 4.0, 6.0] }}
        albedo = 0.8
        phase = {{ kind = \"henyey-greenstein\", g = 0.5 }}
        [[media]]
        name = \"haze\"
        within = \"everywhere\"
        extent = 2.0
        extinction = 0.15
        albedo = 0.9
        [[objects]]
        name = \"ring\"
        kind = \"mesh\"
        file = \"ring.obj\"
        placement = {{ fit = 1.3, rotate_deg = [35.0, 20.0, 0.0] }}
        material = {{ kind = \"interface\" }}
        [[objects]]
        kind = \"mesh\"
        file = \"cube.obj\"
        placement = {{ scale = [0.15, 0.3, 0.15], rotate_deg = [0.0, 30.0, 20.0], translate = [0.1, 0.0, -0.1] }}
        emission = {{ radiance = {{ rgb = [6.0, 4.0, 2.0] }} }}
        [[objects]]
        kind = \"mesh\"
        file = \"smooth.obj\"
        placement = {{ scale = [0.25, 0.35, 0.25], rotate_deg = [0.0, 20.0, 0.0], translate = [0.45, -0.1, 0.2] }}
        material = {{ kind = \"diffuse\", albedo = 0.9 }}
        [[objects]]
        kind = \"disk\"
        center = [0.0, -0.5, 0.0]
        radius = 0.9
        material = {{ kind = \"diffuse\", albedo = 0.6 }}
        [[lights]]
        kind = \"environment\"
        radiance = 0.2
        [estimator]
        mode = \"rgb\"
        max_depth = 8"
    );
    let case = Case::new("shapes/agreement", &toml, Answer::Agreement)?.in_blocks(2, 2).with_files(meshes());
    let spectral = case.varied("shapes/agreement-spectral", |doc| {
        doc.estimator.mode = Mode::Spectral;
        doc.estimator.lights = LightSelection::Power;
    });
    Ok(vec![spectral.among(&UNIDIRECTIONAL_AND_FULL), case.among(&SEVERAL_COMPONENTS)])
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let mut cases = absorbers()?;
    cases.extend(cut_grid()?);
    cases.extend(single()?);
    cases.extend(furnace()?);
    cases.extend(emitters()?);
    cases.extend(emits_and_reflects()?);
    cases.extend(agreement()?);
    cases.iter_mut().for_each(|case| case.budget = Some(BUDGET));
    Ok(cases)
}
