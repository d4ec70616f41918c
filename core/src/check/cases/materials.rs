//! Mirrors, metals and dielectrics: Fresnel's equations and microfacets in closed form.
//!
//! A slab of index n around an absorber, seen at the angle θ in a white environment, has the radiance
//!
//! ```text
//!   L = R + (1 − R)² A (1 + R A) / (1 − R² A²),   A = e^(−σ d / cos θt)
//! ```
//!
//! by the sum over all internal reflections; from its middle, n² (1 − R) √A / (1 − R A). A rough surface reflects
//!
//! ```text
//!   L = ∫ F D(m) G₁(ωo) G₁(ωi) / (4 cos θo) Le(ωi) dωi
//! ```
//!
//! of an environment or of a rectangle, by quadrature. Refraction, reflection and scattering without absorption
//! keep a white furnace white, whatever is inside what.

use super::super::truth;
use super::super::{Answer, Case, CheckError, Family, Layout, fixture};
use super::{ASIDE, AXIS, CONNECTING_AND_ONE, SEVERAL_COMPONENTS, UNIDIRECTIONAL_AND_FULL};
use crate::io::Library;
use crate::scene::{Bookkeeping, IorDoc, LightSelection, MaterialDoc, Mode, ShapeDoc};
use crate::spectrum::SpectrumDoc;
use glam::DVec3;
use std::f64::consts::PI;

pub(super) const FAMILY: Family = Family {
    id: "materials",
    about: "Mirrors, metals and dielectrics: slabs, rough lobes, furnaces, bodies inside bodies.",
    deep_only: false,
    cases,
};

/// Paths per estimator and case: a deep check of all materials would take as long as that of all other families.
const BUDGET: u64 = 400_000;

/// A scene without the default medium of format 1.
fn axis() -> String {
    AXIS.replace("majorant = 1", "majorant = 2")
}

const ENVIRONMENT: &str = "[[lights]]\nkind = \"environment\"\n[estimator]\nmode = \"rgb\"";

/// Reflectance of an unpolarised ray at a boundary of relative index η, and the cosine behind it.
fn boundary(cosine: f64, eta: f64) -> (f64, f64) {
    let behind = (1.0 - (1.0 - cosine * cosine) / (eta * eta)).sqrt();
    let s = ((cosine - eta * behind) / (cosine + eta * behind)).powi(2);
    let p = ((eta * cosine - behind) / (eta * cosine + behind)).powi(2);
    (0.5 * (s + p), behind)
}

/// Reflectance of a metal n + i k, by complex arithmetic.
fn metal(cosine: f64, n: f64, k: f64) -> f64 {
    type C = (f64, f64);
    let times = |a: C, b: C| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    let square = times((n, k), (n, k));
    // √(N² − sin² θ), in the first quadrant.
    let (re, im) = (square.0 - (1.0 - cosine * cosine), square.1);
    let size = re.hypot(im).sqrt();
    let (sin, cos) = (0.5 * im.atan2(re)).sin_cos();
    let root = (size * cos, size * sin);
    let norm = |a: C| a.0 * a.0 + a.1 * a.1;
    let s = norm((cosine - root.0, -root.1)) / norm((cosine + root.0, root.1));
    let scaled = (square.0 * cosine, square.1 * cosine);
    let p = norm((scaled.0 - root.0, scaled.1 - root.1)) / norm((scaled.0 + root.0, scaled.1 + root.1));
    0.5 * (s + p)
}

/// f cos θi of a rough reflection, without Fresnel's factor, and the cosine at the facet.
fn facets(alpha: f64, wo: DVec3, wi: DVec3) -> (f64, f64) {
    let m = (wo + wi).normalize();
    let a2 = alpha * alpha;
    let density = a2 / (PI * (m.z * m.z * (a2 - 1.0) + 1.0).powi(2));
    let masking = |w: DVec3| 2.0 / (1.0 + (1.0 + a2 * (1.0 - w.z * w.z) / (w.z * w.z)).sqrt());
    (density * masking(wo) * masking(wi) / (4.0 * wo.z), wo.dot(m))
}

const SURFACE: &str = "[[objects]]
    kind = \"rectangle\"
    center = [0.0, 0.0, 0.0]
    size = [1.0, 3.0]";

/// Target of a rectangle whose normal is at an angle to the z axis, in the plane of y and z.
fn tilted(angle: f64) -> String {
    format!("target = [0.0, {}, {}]", angle.sin(), angle.cos())
}

/// Surfaces without a medium in a white environment.
fn reflections() -> Result<Vec<Case>, CheckError> {
    let case = |name: &str, angle: f64, material: &str, colour: [f64; 3]| {
        let toml = format!("{}\n{SURFACE}\n{}\n{material}\n{ENVIRONMENT}", axis(), tilted(angle));
        Case::new(format!("materials/{name}"), &toml, Answer::uniform(colour, Layout::WHOLE).within(2e-4))
    };
    let (n, k): ([f64; 3], [f64; 3]) = ([0.2, 0.5, 1.4], [3.5, 2.3, 1.9]);
    let constants = format!("eta = {{ rgb = {n:?} }}, k = {{ rgb = {k:?} }}");
    let smooth = [0, 1, 2].map(|c| metal(0.5, n[c], k[c]));
    let (alpha, angle) = (0.35, 0.9f64);
    let wo = DVec3::new(angle.sin(), 0.0, angle.cos());
    let rough = |fresnel: &dyn Fn(f64) -> f64| {
        truth::over_cap(DVec3::Z, 0.5 * PI, 400, |wi| {
            let (lobe, cosine) = facets(alpha, wo, wi);
            lobe * fresnel(cosine)
        })
    };
    let metals = [0, 1, 2].map(|c| rough(&|cosine| metal(cosine, n[c], k[c])));
    // Both sides of the pane see the environment.
    let pane =
        case("thin-dielectric", 1.0, "material = { kind = \"thin-dielectric\", ior = 1.7 }", [1.0; 3])?;
    Ok(vec![
        case(
            "mirror",
            0.7,
            "material = { kind = \"mirror\", reflectance = { rgb = [0.2, 0.5, 0.9] } }",
            [0.2, 0.5, 0.9],
        )?
        .among(&CONNECTING_AND_ONE),
        case("conductor", PI / 3.0, &format!("material = {{ kind = \"conductor\", {constants} }}"), smooth)?,
        case(
            "rough-conductor",
            angle,
            &format!("material = {{ kind = \"conductor\", {constants}, roughness = {alpha} }}"),
            metals,
        )?
        .among(&SEVERAL_COMPONENTS),
        pane.among(&CONNECTING_AND_ONE),
    ])
}

/// A rectangle of radiance 3 reflected by a rough metal.
fn reflected_lamp() -> Result<Case, CheckError> {
    let (alpha, angle) = (0.3, 0.6f64);
    let (n, k): ([f64; 3], [f64; 3]) = ([0.2, 0.5, 1.4], [3.5, 2.3, 1.9]);
    let toml = format!(
        "{}\n{SURFACE}\n{}
        material = {{ kind = \"conductor\", eta = {{ rgb = {n:?} }}, k = {{ rgb = {k:?} }}, roughness = {alpha} }}
        [[lights]]
        kind = \"rectangle\"
        center = [0.0, 3.0, 1.0]
        target = [0.0, 0.0, 0.0]
        size = [2.0, 2.0]
        radiance = 3.0
        [estimator]
        mode = \"rgb\"",
        axis(),
        tilted(angle)
    );
    let normal = DVec3::new(0.0, angle.sin(), angle.cos());
    let (u, v) = normal.any_orthonormal_pair();
    let local = |w: DVec3| DVec3::new(w.dot(u), w.dot(v), w.dot(normal));
    let center = DVec3::new(0.0, 3.0, 1.0);
    let facing = -center.normalize();
    let (a, b) = (DVec3::X, facing.cross(DVec3::X).normalize());
    let colour = [0, 1, 2].map(|c| {
        truth::integrate(60, |s| {
            truth::integrate(60, |t| {
                let point = center + a * (2.0 * s - 1.0) + b * (2.0 * t - 1.0);
                let (squared, wi) = (point.length_squared(), point.normalize());
                let (lobe, cosine) = facets(alpha, local(DVec3::Z), local(wi));
                lobe * metal(cosine, n[c], k[c]) * 3.0 * 4.0 * -wi.dot(facing) / squared
            })
        })
    });
    Case::new("materials/reflected-lamp", &toml, Answer::uniform(colour, Layout::WHOLE).within(3e-4))
}

/// Radiance of a slab in a white environment.
fn slab(cosine: f64, eta: f64, depth: f64) -> f64 {
    let (r, behind) = boundary(cosine, eta);
    let a = (-depth / behind).exp();
    r + (1.0 - r).powi(2) * a * (1.0 + r * a) / (1.0 - r * r * a * a)
}

/// Slabs of glass around an absorber, from outside and inside, one index or three.
fn slabs() -> Result<Vec<Case>, CheckError> {
    let sigma = [0.2, 0.6, 1.5];
    let toml = format!(
        "{}
        [[media]]
        within = \"slab\"
        extinction = {{ rgb = {sigma:?} }}
        albedo = 0.0
        [[objects]]
        name = \"slab\"
        kind = \"box\"
        center = [0.0, 0.0, 0.0]
        size = [400.0, 400.0, 1.0]
        material = {{ kind = \"dielectric\", ior = 1.6 }}
        {ENVIRONMENT}",
        axis()
    );
    let answer = |f: &dyn Fn(usize) -> f64| Answer::uniform([0, 1, 2].map(f), Layout::WHOLE).within(1e-4);
    let straight = Case::new("materials/slab", &toml, answer(&|c| slab(1.0, 1.6, sigma[c])))?;
    let tilted = straight.varied("materials/slab-tilted", |doc| {
        if let ShapeDoc::Box { rotate_deg, .. } = &mut doc.objects[0].shape {
            *rotate_deg = [50.0, 0.0, 0.0];
        }
    });
    let cosine = 50f64.to_radians().cos();
    let indices = [1.2, 1.5, 2.1];
    let coloured = tilted.varied("materials/slab-dispersive", |doc| {
        let ior = IorDoc::Spectrum(SpectrumDoc::Rgb(indices.map(|n: f64| n as f32)));
        doc.objects[0].material = MaterialDoc::Dielectric { ior, roughness: 0.0 };
    });
    let pairwise = coloured.varied("materials/slab-dispersive-pairwise", |doc| {
        doc.estimator.bookkeeping = Bookkeeping::Pairwise;
    });
    let apart = coloured.varied("materials/slab-dispersive-apart", |doc| {
        doc.estimator.bookkeeping = Bookkeeping::ApartF64;
    });
    let dispersive = answer(&|c| slab(cosine, indices[c], sigma[c]));
    let (points, cauchy) = (truth::Points(&[(420.0, 0.3), (560.0, 1.1), (690.0, 0.5)]), [1.4, 0.02]);
    let by_wavelength = coloured.varied("materials/slab-cauchy", |doc| {
        doc.estimator.mode = Mode::Spectral;
        let ior = IorDoc::Cauchy { cauchy: cauchy.map(|x: f64| x as f32) };
        doc.objects[0].material = MaterialDoc::Dielectric { ior, roughness: 0.0 };
        if let Ok(spectrum) = toml::from_str::<toml::Table>(&format!("v = {}", points.toml()))
            && let Some(Ok(spectrum)) = spectrum.get("v").map(|v| v.clone().try_into())
        {
            doc.media[0].extinction = spectrum;
        }
    });
    let spectrum = truth::film(|l| slab(cosine, cauchy[0] + cauchy[1] * 1e6 / (l * l), points.at(l)));
    // The camera stands in the middle of the slab.
    let within = straight.varied("materials/slab-from-inside", |doc| {
        (doc.camera.origin, doc.camera.target) = ([0.0; 3], [0.0, 0.0, -1.0]);
    });
    let from_inside = answer(&|c| {
        let (r, a) = (boundary(1.0, 1.6).0, (-sigma[c]).exp());
        1.6 * 1.6 * (1.0 - r) * a.sqrt() / (1.0 - r * a)
    });
    Ok(vec![
        tilted.answered(answer(&|c| slab(cosine, 1.6, sigma[c]))).among(&CONNECTING_AND_ONE),
        coloured.answered(dispersive.clone()),
        pairwise.answered(dispersive.clone()).among(&UNIDIRECTIONAL_AND_FULL),
        apart.answered(dispersive).among(&UNIDIRECTIONAL_AND_FULL),
        by_wavelength
            .answered(Answer::uniform(spectrum, Layout::WHOLE).within(1e-3))
            .among(&SEVERAL_COMPONENTS),
        within.answered(from_inside).among(&CONNECTING_AND_ONE),
        straight,
    ])
}

/// The reflection alone of a rough body whose inside absorbs all light.
fn rough_body() -> Result<Case, CheckError> {
    let (alpha, eta, angle) = (0.4, [1.3, 1.5, 2.0], 40f64.to_radians());
    let toml = format!(
        "{}
        [[media]]
        within = \"body\"
        extinction = 5000.0
        albedo = 0.0
        [[objects]]
        name = \"body\"
        kind = \"box\"
        center = [0.0, 0.0, 0.0]
        size = [20.0, 20.0, 1.0]
        rotate_deg = [40.0, 0.0, 0.0]
        material = {{ kind = \"dielectric\", ior = {{ rgb = {eta:?} }}, roughness = {alpha} }}
        {ENVIRONMENT}",
        axis()
    );
    let wo = DVec3::new(angle.sin(), 0.0, angle.cos());
    let colour = eta.map(|eta| {
        truth::over_cap(DVec3::Z, 0.5 * PI, 400, |wi| {
            let (lobe, cosine) = facets(alpha, wo, wi);
            lobe * boundary(cosine, eta).0
        })
    });
    let answer = Answer::uniform(colour, Layout::WHOLE).within(3e-4);
    Ok(Case::new("materials/rough-dielectric", &toml, answer)?.among(&SEVERAL_COMPONENTS))
}

/// Bodies displace the media around them, and each other by priority; faces of glass and liquid coincide.
fn displacement() -> Result<Vec<Case>, CheckError> {
    let [fog, glass, liquid] = [[0.3, 0.1, 0.2], [0.5, 0.9, 0.2], [0.1, 0.4, 1.2]];
    let medium = |name: &str, within: &str, sigma: [f64; 3]| {
        format!(
            "[[media]]
            name = \"{name}\"
            within = \"{within}\"
            extinction = {{ rgb = {sigma:?} }}
            albedo = 0.0\n"
        )
    };
    let body = |name: &str, shape: &str, priority: i32| {
        format!(
            "[[objects]]
            name = \"{name}\"
            {shape}
            priority = {priority}
            material = {{ kind = \"dielectric\", ior = 1.5 }}\n"
        )
    };
    let text = |objects: &str| {
        format!(
            "{}\n{}extent = 3.0\n{}{}{objects}\n{ENVIRONMENT}",
            axis(),
            medium("fog", "everywhere", fog),
            medium("glass", "glass", glass),
            medium("liquid", "liquid", liquid)
        )
    };
    // A slab from −1 to 1 in which a slab from −0.5 to 0.5 is another body of the same index.
    let outer = "kind = \"box\"\ncenter = [0.0, 0.0, 0.0]\nsize = [400.0, 400.0, 2.0]";
    let inner = "kind = \"box\"\ncenter = [0.0, 0.0, 0.0]\nsize = [300.0, 300.0, 1.0]";
    let answer = |in_fog: [f64; 2], in_body: [f64; 2]| {
        let colour = [0, 1, 2].map(|c| {
            // Light from behind crosses the fog on both sides, reflected light that in front twice.
            let depth = glass[c] * in_body[0] + liquid[c] * in_body[1];
            let (r, a) = (boundary(1.0, 1.5).0, (-depth).exp());
            let [front, back] = in_fog.map(|length| (-fog[c] * length).exp());
            let inside = (1.0 - r).powi(2) / (1.0 - r * r * a * a);
            front * (front * (r + inside * r * a * a) + back * inside * a)
        });
        Answer::uniform(colour, Layout::WHOLE).within(1e-4)
    };
    let nested = text(&format!("{}{}", body("glass", outer, 0), body("liquid", inner, 1)));
    let nested = Case::new("materials/liquid-in-glass", &nested, answer([2.0; 2], [1.0, 1.0]))?;
    // The liquid has the lower rank and is not there.
    let displaced = nested.varied("materials/liquid-displaced", |doc| doc.objects[1].priority = -1);
    // Two halves that touch: from −1 to 0 liquid, from 0 to 1 glass.
    let touching = nested.varied("materials/coincident-faces", |doc| {
        for (object, at) in doc.objects.iter_mut().zip([0.5, -0.5]) {
            if let ShapeDoc::Box { center, size, .. } = &mut object.shape {
                (center[2], size[2]) = (at, 1.0);
            }
        }
    });
    Ok(vec![
        displaced.answered(answer([2.0; 2], [2.0, 0.0])).among(&CONNECTING_AND_ONE),
        touching.among(&CONNECTING_AND_ONE),
        nested,
    ])
}

/// Bodies, panes and mirrors without absorption around and within scattering media.
fn furnace() -> Result<Vec<Case>, CheckError> {
    let toml = format!(
        "{ASIDE}
        [[media]]
        name = \"milk\"
        within = \"ball\"
        extinction = {{ rgb = [2.0, 1.0, 3.0] }}
        albedo = 1.0
        phase = {{ kind = \"henyey-greenstein\", g = 0.5 }}
        [[media]]
        name = \"haze\"
        within = \"everywhere\"
        extent = 2.0
        extinction = 0.2
        albedo = 1.0
        [[objects]]
        name = \"ball\"
        kind = \"sphere\"
        center = [0.1, 0.0, 0.0]
        radius = 0.4
        priority = 1
        material = {{ kind = \"dielectric\", ior = {{ rgb = [1.3, 1.5, 1.4] }} }}
        [[objects]]
        name = \"ring\"
        kind = \"mesh\"
        file = \"ring.obj\"
        placement = {{ fit = 1.4, rotate_deg = [30.0, 0.0, 10.0] }}
        material = {{ kind = \"dielectric\", ior = 1.2 }}
        [[objects]]
        kind = \"box\"
        center = [-0.3, 0.3, 0.3]
        size = [0.2, 0.3, 0.1]
        rotate_deg = [20.0, 30.0, 0.0]
        material = {{ kind = \"mirror\" }}
        [[objects]]
        kind = \"disk\"
        center = [0.4, 0.5, 0.2]
        normal = [1.0, 1.0, 0.3]
        radius = 0.4
        material = {{ kind = \"thin-dielectric\", ior = {{ rgb = [1.5, 1.7, 2.0] }} }}
        [[objects]]
        kind = \"rectangle\"
        center = [0.0, -0.7, 0.0]
        target = [0.0, 1.0, 0.0]
        up = [0.0, 0.0, 1.0]
        size = [1.5, 1.5]
        material = {{ kind = \"diffuse\", albedo = 1.0 }}
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\""
    );
    let ring = fixture::torus(1.0, 0.3, [24, 12]).into_bytes();
    let case = Case::new("materials/furnace", &toml, Answer::Agreement)?
        .in_blocks(2, 2)
        .with_files(Library::default().with_volume("ring.obj", ring));
    let case = case.clone().answered(Answer::uniform([1.0; 3], case.layout));
    let spectral = case.varied("materials/furnace-spectral", |doc| {
        doc.estimator.mode = Mode::Spectral;
        let ior = IorDoc::Cauchy { cauchy: [1.3, 0.03] };
        doc.objects[0].material = MaterialDoc::Dielectric { ior, roughness: 0.0 };
    });
    let spectral = spectral.answered(Answer::uniform(truth::white(), case.layout));
    Ok(vec![spectral.among(&UNIDIRECTIONAL_AND_FULL), case.among(&SEVERAL_COMPONENTS)])
}

/// All estimators agree on rough glass and metal among media, a lamp inside a body and one outside.
fn agreement() -> Result<Vec<Case>, CheckError> {
    let toml = format!(
        "{ASIDE}
        [[media]]
        name = \"jelly\"
        within = \"ball\"
        extinction = {{ rgb = [1.0, 2.0, 0.5] }}
        albedo = 0.8
        [[media]]
        name = \"haze\"
        within = \"everywhere\"
        extent = 2.0
        extinction = 0.2
        albedo = 0.9
        [[objects]]
        name = \"ball\"
        kind = \"sphere\"
        center = [-0.3, 0.0, 0.0]
        radius = 0.4
        material = {{ kind = \"dielectric\", ior = {{ rgb = [1.3, 1.4, 1.5] }}, roughness = 0.3 }}
        [[objects]]
        kind = \"sphere\"
        center = [-0.3, 0.1, 0.0]
        radius = 0.15
        material = {{ kind = \"diffuse\", albedo = 0.3 }}
        emission = {{ radiance = {{ rgb = [4.0, 3.0, 2.0] }} }}
        [[objects]]
        kind = \"box\"
        center = [0.4, -0.1, 0.0]
        size = [0.4, 0.6, 0.4]
        rotate_deg = [0.0, 30.0, 10.0]
        material = {{ kind = \"conductor\", eta = {{ rgb = [0.2, 0.5, 1.4] }}, k = {{ rgb = [3.5, 2.3, 1.9] }}, roughness = 0.4 }}
        [[objects]]
        kind = \"ground\"
        point = [0.0, -0.5, 0.0]
        material = {{ kind = \"diffuse\", albedo = 0.5 }}
        [[lights]]
        kind = \"rectangle\"
        center = [0.5, 1.4, 0.5]
        target = [0.0, 0.0, 0.0]
        size = [0.9, 0.9]
        radiance = 4.0
        [[lights]]
        kind = \"environment\"
        radiance = 0.3
        [estimator]
        mode = \"rgb\"
        max_depth = 7"
    );
    let case = Case::new("materials/agreement", &toml, Answer::Agreement)?.in_blocks(2, 2);
    let spectral = case.varied("materials/agreement-spectral", |doc| {
        doc.estimator.mode = Mode::Spectral;
        doc.estimator.lights = LightSelection::Power;
        let ior = IorDoc::Cauchy { cauchy: [1.3, 0.02] };
        doc.objects[0].material = MaterialDoc::Dielectric { ior, roughness: 0.3 };
    });
    Ok(vec![spectral.among(&UNIDIRECTIONAL_AND_FULL), case.among(&SEVERAL_COMPONENTS)])
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let mut cases = reflections()?;
    cases.push(reflected_lamp()?);
    cases.extend(slabs()?);
    cases.push(rough_body()?);
    cases.extend(displacement()?);
    cases.extend(furnace()?);
    cases.extend(agreement()?);
    cases.iter_mut().for_each(|case| case.budget = Some(BUDGET));
    Ok(cases)
}
