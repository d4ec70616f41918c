//! Several media, overlapping and apart: their coefficients add.
//!
//! ```text
//!   σt = Σ_k σt,k      σs p = Σ_k σs,k p_k      σa B = Σ_k σa,k B_k
//! ```
//!
//! Absorbers: e^(−τ) with the sum of the optical depths of all chords, also from inside, and of a medium
//! without a boundary, which extinguishes all light from infinity. A white furnace stays one. Two media of
//! different temperature in one cube emit (σ₁ B₁ + σ₂ B₂)/(σ₁ + σ₂) · (1 − e^(−τ)). Single scattering of two
//! media with their own phase functions, and of one grid that is split into two media, by the quadrature of
//! `single_scattering.rs`.

use super::super::truth::{self, Points};
use super::super::{Answer, Case, CheckError, Family, Layout, fixture};
use super::single_scattering::{Cube, Disc, QUADRATURE, in_lattice, sun};
use super::thermal::planck;
use super::{
    ASIDE, AXIS, CONNECTING, CONNECTING_AND_ONE, FAMILIES_WITH_DISTANCE_SAMPLING, SEVERAL_COMPONENTS,
    UNIDIRECTIONAL_AND_FULL,
};
use crate::io::Library;
use crate::scene::{Absorption, DistanceSampling, LightDoc, Mode, WhenExceeded};
use crate::spectrum::SpectrumDoc;
use glam::DVec3;

pub(super) const FAMILY: Family = Family {
    id: "media",
    about: "Several media, overlapping and apart: absorption, a furnace, emission, single scattering.",
    deep_only: false,
    cases,
};

const FIRST: [f64; 3] = [0.2, 1.0, 0.5];
const SECOND: [f64; 3] = [0.8, 0.1, 0.4];
const BALL: [f64; 3] = [0.05, 0.1, 0.02];

/// Two cubes, at −0.5 to 0.5 and −0.1 to 0.9 along the axis, inside a ball of radius 2.
fn absorbers() -> Result<Vec<Case>, CheckError> {
    let toml = format!(
        "{AXIS}
        [[media]]
        name = \"first\"
        extinction = {{ rgb = {FIRST:?} }}
        albedo = 0.0
        [[media]]
        name = \"second\"
        extinction = {{ rgb = {SECOND:?} }}
        albedo = 0.0
        placement = {{ translate = [0.0, 0.0, 0.4] }}
        majorant = {{ factor = 1.7 }}
        [[media]]
        name = \"ball\"
        extinction = {{ rgb = {BALL:?} }}
        albedo = 0.0
        within = \"everywhere\"
        extent = 2.0
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\""
    );
    let through = |lengths: [f64; 3]| {
        let depth = |c: usize| FIRST[c] * lengths[0] + SECOND[c] * lengths[1] + BALL[c] * lengths[2];
        Answer::uniform([0, 1, 2].map(|c| (-depth(c)).exp()), Layout::WHOLE)
    };
    let whole = Case::new("media/absorbers", &toml, through([1.0, 1.0, 4.0]))?;
    // From z = 0.2 to the back.
    let inside = whole.varied("media/absorbers-inside", |doc| {
        (doc.camera.origin, doc.camera.target) = ([0.0, 0.0, 0.2], [0.0, 0.0, -1.0]);
    });
    let disabled = whole.varied("media/absorbers-without-one", |doc| doc.media[1].enabled = false);
    let exceeded = whole.varied("media/absorbers-exceeded", |doc| {
        doc.media[0].majorant.factor = 0.6;
        doc.media[1].majorant.factor = 0.8;
    });
    let shared = whole.varied("media/absorbers-shared", |doc| {
        doc.media.iter_mut().for_each(|medium| medium.majorant.shared = true);
    });
    Ok(vec![
        inside.answered(through([0.7, 0.3, 2.2])),
        disabled.answered(through([1.0, 0.0, 4.0])),
        exceeded.among(&SEVERAL_COMPONENTS),
        shared.among(&SEVERAL_COMPONENTS),
        whole,
    ])
}

/// A lamp in a medium that reaches to infinity: the camera is 59.9 from its surface. No other light arrives.
fn unbounded() -> Result<Case, CheckError> {
    let sigma = Points(&[(430.0, 0.01), (560.0, 0.03), (650.0, 0.02)]);
    let toml = format!(
        "{AXIS}
        [[media]]
        name = \"fog\"
        within = \"everywhere\"
        extinction = {}
        albedo = 0.0
        [[lights]]
        kind = \"sphere\"
        center = [0.0, 0.0, 0.0]
        radius = 0.1
        [[lights]]
        kind = \"environment\"
        radiance = 50.0
        [[lights]]
        kind = \"sun\"
        toward = [0.0, 0.0, 1.0]
        [estimator]
        mode = \"spectral\"",
        sigma.toml()
    );
    let colour = truth::film(|l| (-59.9 * sigma.at(l)).exp());
    let case = Case::new("media/unbounded", &toml, Answer::uniform(colour, Layout::WHOLE))?;
    Ok(case.among(&SEVERAL_COMPONENTS))
}

/// A rough grid, a rotated box through it and a ball around both, with different phase functions.
fn furnace() -> Result<Vec<Case>, CheckError> {
    let rough = truth::Lattice3::npy(&fixture::rough_lattice([5, 6, 4], 4));
    let toml = format!(
        "{ASIDE}
        [[media]]
        name = \"grid\"
        extinction = {{ rgb = [3.0, 6.0, 1.0] }}
        albedo = 1.0
        density = {{ kind = \"grid\", file = \"rough.npy\" }}
        placement = {{ fit = 1.2 }}
        phase = {{ kind = \"henyey-greenstein\", g = 0.6 }}
        [[media]]
        name = \"box\"
        extinction = {{ rgb = [1.0, 0.5, 4.0] }}
        albedo = 1.0
        placement = {{ scale = [0.8, 1.2, 0.6], rotate_deg = [20.0, 30.0, 0.0], translate = [0.2, 0.1, 0.0] }}
        phase = {{ kind = \"henyey-greenstein\", g = -0.5 }}
        [[media]]
        name = \"ball\"
        extinction = 0.2
        albedo = 1.0
        within = \"everywhere\"
        extent = 1.5
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\""
    );
    let case = Case::new("media/furnace", &toml, Answer::Agreement)?
        .in_blocks(2, 2)
        .with_files(Library::default().with_volume("rough.npy", rough));
    let case = case.clone().answered(Answer::uniform([1.0; 3], case.layout));
    let spectral = case.varied("media/furnace-spectral", |doc| doc.estimator.mode = Mode::Spectral);
    let spectral = spectral.answered(Answer::uniform(truth::white(), case.layout));
    let decomposed = case.varied("media/furnace-decomposition", |doc| {
        doc.estimator.distances = DistanceSampling::Decomposition;
        doc.estimator.absorption = Absorption::Analogue;
    });
    let weighted = case.varied("media/furnace-weighted-delta", |doc| {
        doc.estimator.distances = DistanceSampling::WeightedDelta;
        doc.media[2].majorant.factor = 3.0;
    });
    // Clamping a majorant that is not exceeded has no effect.
    let clamped = case.varied("media/furnace-clamped", |doc| {
        doc.media.iter_mut().for_each(|medium| medium.majorant.when_exceeded = WhenExceeded::Clamp);
    });
    Ok(vec![
        spectral.among(&SEVERAL_COMPONENTS),
        decomposed.among(&FAMILIES_WITH_DISTANCE_SAMPLING),
        weighted.among(&FAMILIES_WITH_DISTANCE_SAMPLING),
        clamped.among(&UNIDIRECTIONAL_AND_FULL),
        case,
    ])
}

/// Two media of different temperature in one cube.
fn thermal() -> Result<Case, CheckError> {
    let (first, second) = (Points(&[(400.0, 0.3), (700.0, 1.0)]), Points(&[(450.0, 0.9), (600.0, 0.2)]));
    let toml = format!(
        "{AXIS}
        [[media]]
        name = \"cool\"
        albedo = 0.0
        extinction = {}
        emission = {{ kelvin = 2500.0, scale = 2.0 }}
        [[media]]
        name = \"hot\"
        albedo = 0.0
        extinction = {}
        emission = {{ kelvin = 4000.0 }}
        majorant = {{ factor = 1.5 }}",
        first.toml(),
        second.toml()
    );
    let colour = truth::film(|l| {
        let [a, b] = [first.at(l), second.at(l)];
        let emitted = a * 2.0 * planck(l, 2500.0) + b * planck(l, 4000.0);
        emitted / (a + b) * (1.0 - (-a - b).exp())
    });
    Case::new("media/thermal", &toml, Answer::uniform(colour, Layout::WHOLE))
}

/// Single scattering in two media that fill the same cube.
fn single() -> Result<Vec<Case>, CheckError> {
    let toward = DVec3::new(0.6, 0.1, 0.8);
    let light = "[[lights]]
        kind = \"sun\"
        toward = [0.6, 0.1, 0.8]
        angular_diameter_deg = 110.0
        irradiance = 2.0
        visible = false
        [estimator]
        mode = \"rgb\"
        max_depth = 2";
    let (first, second) = ([0.5, 1.0, 3.0], [0.5, 2.0, 0.5]);
    let toml = format!(
        "{AXIS}
        [[media]]
        name = \"first\"
        extinction = {{ rgb = {first:?} }}
        albedo = 0.9
        phase = {{ kind = \"henyey-greenstein\", g = -0.6 }}
        [[media]]
        name = \"second\"
        extinction = {{ rgb = {second:?} }}
        albedo = 0.4
        phase = {{ kind = \"henyey-greenstein\", g = 0.5 }}
        majorant = {{ factor = 1.5 }}
        {light}"
    );
    let colour = |disc: &dyn Fn(DVec3) -> Disc| {
        [0, 1, 2].map(|c| {
            let extinction = first[c] + second[c];
            let phase = |cosine: f64| {
                let [a, b] = [-0.6, 0.5].map(|g| truth::henyey_greenstein(g, cosine));
                (0.9 * first[c] * a + 0.4 * second[c] * b) / extinction
            };
            Cube { extinction, albedo: 1.0 }.single(phase, disc)
        })
    };
    let answer =
        |disc: &dyn Fn(DVec3) -> Disc| Answer::uniform(colour(disc), Layout::WHOLE).within(QUADRATURE);
    let distant = answer(&|_| sun(toward, 110.0, 2.0));
    let phases = Case::new("media/two-phase-functions", &toml, distant)?.among(&CONNECTING_AND_ONE);
    // A lamp, towards which equiangular sampling draws distances as well.
    let center = DVec3::new(1.5, 0.3, 0.6);
    let lamp = answer(&|point| {
        let to = center - point;
        Disc { axis: to.normalize(), half_angle: (0.9 / to.length()).asin(), radiance: 3.0 }
    });
    let mut sphere = phases.varied("media/two-phase-functions-lamp", |doc| doc.lights.clear()).answered(lamp);
    sphere.doc.lights.push(LightDoc::Sphere {
        center: center.as_vec3().to_array(),
        radius: 0.9,
        radiance: SpectrumDoc::Constant(3.0),
        scale: 1.0,
        visible: false,
        enabled: true,
    });

    let rough = fixture::rough_lattice([3, 3, 3], 6);
    let sigma = [1.0, 3.0, 2.0];
    let disc = sun(toward, 110.0, 2.0);
    let answer = Answer::uniform(sigma.map(|sigma| in_lattice(&rough, sigma, &disc)), Layout::WHOLE);
    let half = |name: &str, scale: f64, factor: f64| {
        format!(
            "[[media]]
            name = \"{name}\"
            extinction = {{ rgb = {sigma:?} }}
            scale = {scale}
            albedo = 0.8
            density = {{ kind = \"grid\", file = \"rough.npy\" }}
            placement = {{ fit = 1.0 }}
            majorant = {{ factor = {factor:?} }}"
        )
    };
    let toml = format!("{AXIS}\n{}\n{}\n{light}", half("some", 0.3, 1.0), half("rest", 0.7, 1.4));
    let split = Case::new("media/one-grid-as-two-media", &toml, answer.within(5e-4))?
        .with_files(Library::default().with_volume("rough.npy", rough.npy()));
    Ok(vec![phases, sphere.among(&CONNECTING), split])
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let mut cases = absorbers()?;
    cases.push(unbounded()?);
    cases.extend(furnace()?);
    cases.push(thermal()?);
    cases.extend(single()?);
    Ok(cases)
}
