//! Single scattering along the axis of a cube, by quadrature, with a depth limit of 2.
//!
//! ```text
//!   L = ∫₀¹ e^(−τ(s)) μs(s) ∫ p(−z · −ω) Li(ω) e^(−τ(s, ω)) dω ds
//! ```
//!
//! s runs from the face of the cube along the axis, ω over the directions to the light, and τ(s, ω) is the
//! optical depth from the point to the face of the cube. Light propagates along −ω and leaves towards the
//! camera, along +z: the cosine in the phase function is −ω · z. Suns and spheres are wide here, so that
//! randomly scattered paths hit them; the quadrature integrates over their discs instead of approximating
//! them. They are invisible to the camera.

use super::super::truth::{self, Lattice3, Points};
use super::super::{Answer, Case, CheckError, Family, Layout, fixture};
use super::{AXIS, CONNECTING, CONNECTING_AND_ONE, UNIDIRECTIONAL_AND_FULL};
use crate::io::Library;
use crate::scene::{Angle, DirectionSampling, LightSampling, PhaseDoc};
use glam::DVec3;

pub(super) const FAMILY: Family = Family {
    id: "single-scattering",
    about: "Single scattering of a sun or a sphere, by quadrature over the axis and the light's disc.",
    deep_only: false,
    cases,
};

/// A disc of uniform radiance, as seen from a point.
pub(super) struct Disc {
    pub axis: DVec3,
    pub half_angle: f64,
    pub radiance: f64,
}

/// A homogeneous unit cube.
pub(super) struct Cube {
    pub extinction: f64,
    pub albedo: f64,
}

impl Cube {
    /// Single scattering along the axis, integrated over the axis and over the disc seen from each of its
    /// points.
    pub fn single(&self, phase: impl Fn(f64) -> f64, disc: impl Fn(DVec3) -> Disc) -> f64 {
        self.single_fine((60, 16), phase, disc, |_, _| true)
    }

    /// As [`Self::single`], with a given raster along the axis and across the disc, and with occluders: `lit`
    /// returns whether a point receives light from a direction.
    pub fn single_fine(
        &self,
        (along, across): (u32, u32),
        phase: impl Fn(f64) -> f64,
        disc: impl Fn(DVec3) -> Disc,
        lit: impl Fn(DVec3, DVec3) -> bool,
    ) -> f64 {
        truth::integrate(along, |s| {
            let point = DVec3::new(0.0, 0.0, 0.5 - s);
            let light = disc(point);
            let received = truth::over_cap(light.axis, light.half_angle, across, |omega| {
                if !lit(point, omega) {
                    return 0.0;
                }
                phase(-omega.z) * light.radiance * (-self.extinction * to_face(point, omega)).exp()
            });
            (-self.extinction * s).exp() * self.extinction * self.albedo * received
        })
    }
}

/// Distance from a point in the cube to its face along a direction.
pub(super) fn to_face(point: DVec3, direction: DVec3) -> f64 {
    truth::box_interval(point, direction, DVec3::ZERO, DVec3::splat(0.5)).map_or(0.0, |(_, far)| far)
}

/// Relative error of the quadrature: a raster two to three times as fine in every dimension differs by at
/// most 2.1·10⁻⁴, and by 1.1·10⁻⁴ in the rough grid.
pub(super) const QUADRATURE: f64 = 3e-4;

/// A sun of angular diameter `diameter` in degrees.
pub(super) fn sun(toward: DVec3, diameter: f64, irradiance: f64) -> Disc {
    let half_angle = 0.5 * diameter.to_radians();
    let radiance = irradiance / (std::f64::consts::PI * half_angle.sin().powi(2));
    Disc { axis: toward.normalize(), half_angle, radiance }
}

fn sun_toml(toward: DVec3, diameter: f64) -> String {
    format!(
        "[[lights]]\nkind = \"sun\"\ntoward = [{}, {}, {}]\nangular_diameter_deg = {diameter}\nirradiance = 2.0\nvisible = false",
        toward.x, toward.y, toward.z
    )
}

fn case(name: &str, medium: &str, lights: &str, mode: &str, answer: Answer) -> Result<Case, CheckError> {
    let toml = format!(
        "{AXIS}
        [medium]
        albedo = 0.8
        {medium}
        {lights}
        [estimator]
        mode = \"{mode}\"
        max_depth = 2"
    );
    Case::new(format!("single-scattering/{name}"), &toml, answer.within(QUADRATURE))
}

/// Single scattering in a lattice over the unit cube, constant beyond its outermost values.
pub(super) fn in_lattice(lattice: &Lattice3, sigma: f64, light: &Disc) -> f64 {
    let n = DVec3::from_array(lattice.size.map(|n| n as f64));
    let held = |i: i64, n: i64| Some(i.clamp(0, n - 1));
    let density = |p: DVec3| lattice.at((p + 0.5) * n - 0.5, held);
    let column = |from: DVec3, direction: DVec3, length: f64| {
        length * truth::integrate(24, |t| density(from + direction * (length * t)))
    };
    let face = DVec3::new(0.0, 0.0, 0.5);
    truth::integrate(60, |s| {
        let point = face - DVec3::Z * s;
        let here = density(point);
        let tau = sigma * column(face, -DVec3::Z, s);
        let received = truth::over_cap(light.axis, light.half_angle, 8, |omega| {
            light.radiance * (-sigma * column(point, omega, to_face(point, omega))).exp()
        });
        (-tau).exp() * sigma * 0.8 * here * received / (4.0 * std::f64::consts::PI)
    })
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let sigma = [1.0, 2.0, 4.0];
    let medium = "extinction = { rgb = [1.0, 2.0, 4.0] }";
    let isotropic = |_: f64| 0.25 / std::f64::consts::PI;
    let mut cases = Vec::new();

    let behind = DVec3::new(0.6, 0.1, -0.8);
    let before = DVec3::new(0.6, 0.1, 0.8);
    let hg = |g| PhaseDoc::HenyeyGreenstein { g };
    let points = vec![[-1.0, 1.0], [0.0, 1.0], [1.0, 3.0]];
    let table = PhaseDoc::Tabulated { angle: Angle::Cosine, points, file: String::new() };
    type Phase = (&'static str, PhaseDoc, (DVec3, f64), fn(f64) -> f64);
    let phases: [Phase; 7] = [
        ("isotropic", PhaseDoc::Isotropic {}, (before, 110.0), |_| 0.25 / std::f64::consts::PI),
        ("hg0.9", hg(0.9), (behind, 60.0), |c| truth::henyey_greenstein(0.9, c)),
        ("hg-0.9", hg(-0.9), (before, 60.0), |c| truth::henyey_greenstein(-0.9, c)),
        ("rayleigh", PhaseDoc::Rayleigh {}, (behind, 110.0), truth::rayleigh),
        ("draine", PhaseDoc::Draine { g: 0.6, alpha: 5.0 }, (behind, 110.0), |c| truth::draine(0.6, 5.0, c)),
        ("mie", PhaseDoc::Mie { diameter_um: 6.0 }, (before, 150.0), |c| truth::droplets(6.0, c)),
        ("table", table, (behind, 110.0), |c| (1.0 + 2.0 * c.max(0.0)) / (6.0 * std::f64::consts::PI)),
    ];
    for (name, doc, (toward, diameter), phase) in phases {
        let single = sigma
            .map(|extinction| Cube { extinction, albedo: 0.8 }.single(phase, |_| sun(toward, diameter, 2.0)));
        let answer = Answer::uniform(single, Layout::WHOLE);
        let case = case(&format!("sun-{name}"), medium, &sun_toml(toward, diameter), "rgb", answer)?;
        let case = case.varied(case.name.clone(), |d| d.medium_mut().phase = doc);
        if name.starts_with("hg") {
            let by_product = case.varied(format!("{}-product", case.name), |d| {
                d.estimator.light_sampling = LightSampling::Product;
                d.estimator.directions = DirectionSampling::Product;
            });
            cases.push(by_product.among(&CONNECTING));
        }
        // Droplets scatter little to the side: estimators without next-event estimation need a hundred
        // million paths.
        cases.push(match name {
            "mie" => case.among(&CONNECTING),
            "isotropic" => case,
            // For these lobes, estimators with next-event estimation are tested with product sampling as
            // well.
            "hg0.9" | "hg-0.9" => case.among(&UNIDIRECTIONAL_AND_FULL),
            _ => case.among(&CONNECTING_AND_ONE),
        });
    }

    // A sphere beside the cube subtends a different angle at every point.
    let center = DVec3::new(1.75, 0.3, 0.2);
    let sphere = |point: DVec3| {
        let to = center - point;
        Disc { axis: to.normalize(), half_angle: (1.2 / to.length()).asin(), radiance: 3.0 }
    };
    let lamp = "[[lights]]
        kind = \"sphere\"
        center = [1.75, 0.3, 0.2]
        radius = 1.2
        radiance = 3.0
        visible = false";
    let single = sigma.map(|extinction| Cube { extinction, albedo: 0.8 }.single(isotropic, sphere));
    let sphere = case("sphere", medium, lamp, "rgb", Answer::uniform(single, Layout::WHOLE))?;
    cases.push(sphere.among(&CONNECTING_AND_ONE));

    // A sun that fills most of the half-space, since one wavelength per path is noisy enough.
    let (points, wide) = (Points(&[(430.0, 1.0), (540.0, 5.0), (620.0, 2.0)]), 150.0);
    let table: Vec<f64> = (0..=50)
        .map(|i| {
            Cube { extinction: f64::from(i) * 0.1, albedo: 0.8 }.single(isotropic, |_| sun(before, wide, 2.0))
        })
        .collect();
    let spectral = truth::film(|l| {
        let x = points.at(l) * 10.0;
        let i = (x as usize).min(49);
        table[i] + (table[i + 1] - table[i]) * (x - i as f64)
    });
    let extinction = format!("extinction = {}", points.toml());
    let answer = Answer::uniform(spectral, Layout::WHOLE).within(3e-4);
    cases.push(case("sun-nm", &extinction, &sun_toml(before, wide), "spectral", answer)?);

    let rough = fixture::rough_lattice([3, 3, 3], 6);
    let toward = DVec3::new(0.8, 0.5, 0.3);
    let light = sun(toward, 150.0, 2.0);
    let single = [1.0, 3.0, 2.0].map(|sigma| in_lattice(&rough, sigma, &light));
    let medium = "extinction = { rgb = [1.0, 3.0, 2.0] }
        density = { kind = \"grid\", file = \"rough.npy\" }
        placement = { fit = 1.0 }";
    let answer = Answer::uniform(single, Layout::WHOLE).within(5e-4);
    let grid = case("grid", medium, &sun_toml(toward, 150.0), "rgb", answer)?
        .with_files(Library::default().with_volume("rough.npy", rough.npy()));
    cases.extend([0.5f32, 1.7, 10.0].map(|factor| {
        let loose = grid.varied(format!("single-scattering/grid-majorant-{factor}"), |doc| {
            doc.medium_mut().majorant.factor = factor;
        });
        // A tenfold majorant has ten times the null collisions, which all unidirectional estimators weight
        // alike.
        if factor > 2.0 { loose.among(&CONNECTING_AND_ONE) } else { loose }
    }));
    cases.push(grid);
    Ok(cases)
}
