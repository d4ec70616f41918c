//! Scenes without a known answer, on which all estimators have to agree.
//!
//! Estimators share little beyond the algebra of `transport`, and fail differently: unidirectional ones do
//! not sample lights, independent tracking uses neither hero wavelengths nor MIS weights. The scenes cover
//! extremes and features for which there is no closed form: chromatic grids, several lights, surfaces, albedo
//! grids, depth limits, analogue absorption, roulette.

use super::super::{Answer, Case, CheckError, Family, fixture};
use super::{ASIDE, CONNECTING, FAMILIES_WITH_DISTANCE_SAMPLING, SEVERAL_COMPONENTS, WITH_DISTANCE_SAMPLING};
use crate::io::Library;
use crate::light::Panorama;
use crate::math::SamplerKind;
use crate::scene::{
    Absorption, Bookkeeping, DirectionSampling, DistanceSampling, EmissionDoc, GridRef, Heuristic,
    Heuristics, LightSampling, LightSelection, LightWalk, Mode, Tracking,
};
use crate::spectrum::WavelengthSampling;

pub(super) const FAMILY: Family = Family {
    id: "agreement",
    about: "No answer is known: the estimators are compared with each other, pair by pair.",
    deep_only: false,
    cases,
};

const PLUME: &str = "
[medium]
extinction = \"430:8, 540:40, 572:8\"
albedo = 0.95
density = { kind = \"grid\", file = \"embedded:plume.vdb\" }
placement = { translate = [0.0, -0.8, 0.0] }
[[lights]]
kind = \"rectangle\"
center = [-1.4, 1.6, 1.2]
target = [0.0, 0.0, 0.0]
size = [1.2, 1.2]
scale = 8.0
[[lights]]
kind = \"environment\"
scale = 0.3
";

const CLOUD: &str = "
[medium]
extinction = { rgb = [8.0, 6.0, 4.0] }
albedo = { rgb = [0.99, 0.9, 0.8] }
phase = { kind = \"henyey-greenstein\", g = 0.7 }
density = { kind = \"grid\", file = \"embedded:cloud.vdb\" }
[[lights]]
kind = \"sun\"
toward = [0.3, 0.8, 0.5]
angular_diameter_deg = 60.0
[[lights]]
kind = \"sphere\"
center = [0.8, 0.8, 0.3]
radius = 0.45
scale = 2.0
[[objects]]
kind = \"ground\"
point = [0.0, -0.5, 0.0]
albedo = { rgb = [0.6, 0.5, 0.3] }
[estimator]
mode = \"rgb\"
";

const INSIDE: &str = "
majorant = 1
[camera]
origin = [0.1, 0.05, 0.3]
fov_deg = 70.0
[film]
width = 8
height = 8
[medium]
extinction = \"400:3, 560:6, 700:1\"
albedo = \"400:0.5, 700:0.9\"
phase = { kind = \"two-lobe\", g_forward = 0.6, g_backward = -0.4, forward = 0.7 }
majorant = { factor = 1.7, shared = true }
[[lights]]
kind = \"environment\"
radiance = \"400:1, 700:2\"
[[objects]]
kind = \"box\"
center = [0.1, 0.0, -0.2]
size = [0.3, 0.3, 0.1]
rotate_deg = [0.0, 30.0, 10.0]
";

const RGB_GRIDS: &str = "
[medium]
density = { kind = \"rgb-grid\", file = \"extinction.npy\" }
albedo_grid = { file = \"albedo.npy\" }
placement = { fit = 1.0 }
[[lights]]
kind = \"environment-map\"
file = \"sky\"
rotate_deg = 40.0
[[lights]]
kind = \"rectangle\"
center = [0.1, 0.9, 0.1]
target = [0.0, 0.0, 0.0]
size = [0.5, 0.5]
scale = 2.0
visible = false
[estimator]
max_depth = 4
";

const NO_EXTINCTION_AT_THE_ENDS: &str = "
[medium]
extinction = { points = \"450:5, 500:9, 600:2\", outside = \"zero\" }
albedo = 0.9
phase = { kind = \"rayleigh\" }
[[lights]]
kind = \"sphere\"
center = [0.0, 0.0, 0.0]
radius = 0.15
radiance = \"tungsten\"
scale = 5.0
[[lights]]
kind = \"environment\"
visible = false
[estimator]
max_depth = 3
";

const FOG: &str = "
[medium]
coefficients = { kind = \"mean-free-path-colour\", mean_free_path = \"430:0.1, 600:0.4\", colour = { rgb = [0.8, 0.6, 0.4] } }
phase = { kind = \"mie\", diameter_um = 1.2 }
[[lights]]
kind = \"sun\"
toward = [0.3, 0.8, -0.5]
angular_diameter_deg = 90.0
[[lights]]
kind = \"environment\"
radiance = \"440:1.4, 640:0.7\"
scale = 0.3
";

/// An environment map with one bright texel, and grids of two resolutions with components that are zero.
fn files() -> Library {
    let mut texels = vec![[0.4, 0.5, 0.8]; 16 * 8];
    texels[2 * 16 + 11] = [12.0, 10.0, 8.0];
    let extinction: Vec<f32> =
        (0..64u8).flat_map(|i| [0.0, f32::from(i % 5), f32::from(i % 3) * 2.0]).collect();
    let albedo: Vec<f32> = (0..12u8).flat_map(|i| [0.9, 0.2 + 0.06 * f32::from(i), 1.0]).collect();
    let files = Library::default()
        .with_volume("extinction.npy", fixture::npy([4, 4, 4], 3, &extinction))
        .with_volume("albedo.npy", fixture::npy([2, 3, 2], 3, &albedo));
    match Panorama::new(16, 8, texels) {
        Some(sky) => files.with_panorama("sky", sky),
        None => files,
    }
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let scene = |name: &str, toml: &str| {
        Ok::<_, CheckError>(Case::new(format!("agreement/{name}"), toml, Answer::Agreement)?.in_blocks(2, 2))
    };
    let plume = scene("plume", &format!("{ASIDE}{PLUME}"))?;
    let cloud = scene("cloud", &format!("{ASIDE}{CLOUD}"))?;
    let inside = scene("inside", INSIDE)?;
    let grids = scene("rgb-grids", &format!("{ASIDE}{RGB_GRIDS}"))?.with_files(files());
    Ok(vec![
        plume
            .varied("agreement/plume-split-glowing", |d| {
                let grid = GridRef { file: "embedded:plume.vdb".into(), grid: Some("temperature".into()) };
                d.medium_mut().emission =
                    Some(EmissionDoc { temperature: Some(grid), kelvin: 1.3, scale: 20.0 });
                d.estimator.distances = DistanceSampling::Decomposition;
                d.medium_mut().majorant.resolution = Some(32);
            })
            .among(&WITH_DISTANCE_SAMPLING),
        cloud
            .varied("agreement/cloud-weighted-delta", |d| {
                d.estimator.distances = DistanceSampling::WeightedDelta;
            })
            .among(&WITH_DISTANCE_SAMPLING),
        inside
            .varied("agreement/inside-split", |d| {
                d.estimator.distances = DistanceSampling::Decomposition;
                d.estimator.absorption = Absorption::Analogue;
                d.medium_mut().majorant.shared = false;
            })
            .among(&FAMILIES_WITH_DISTANCE_SAMPLING),
        plume.varied("agreement/plume-analogue-rgb", |d| {
            d.estimator.absorption = Absorption::Analogue;
            d.estimator.light_walk = LightWalk::Separate;
            d.estimator.mode = Mode::Rgb;
        }),
        plume
            .varied("agreement/plume-uniform-guided", |d| {
                d.estimator.wavelengths = WavelengthSampling::Uniform;
                d.estimator.directions = DirectionSampling::TowardsLights;
                d.medium_mut().majorant.resolution = Some(1);
            })
            .among(&SEVERAL_COMPONENTS),
        plume
            .varied("agreement/plume-power", |d| {
                d.estimator.heuristics =
                    Heuristics { components: Heuristic::Power, techniques: Heuristic::Power };
                d.estimator.tracking = Tracking::Maximum;
                d.estimator.lights = LightSelection::Power;
                d.estimator.light_sampling = LightSampling::Product;
                d.estimator.directions = DirectionSampling::Product;
                d.estimator.sampler = SamplerKind::Sobol;
            })
            .among(&SEVERAL_COMPONENTS),
        plume
            .varied("agreement/plume-maximum", |d| {
                d.estimator.heuristics =
                    Heuristics { components: Heuristic::Maximum, techniques: Heuristic::Maximum };
                d.estimator.tracking = Tracking::Average;
                d.estimator.lights = LightSelection::Contribution;
                d.estimator.absorption = Absorption::Roulette;
            })
            .among(&SEVERAL_COMPONENTS),
        plume
            .varied("agreement/plume-hero-only", |d| {
                d.estimator.heuristics =
                    Heuristics { components: Heuristic::HeroOnly, techniques: Heuristic::Power };
                d.estimator.absorption = Absorption::Analogue;
                d.estimator.mode = Mode::Rgb;
            })
            .among(&SEVERAL_COMPONENTS),
        plume
            .varied("agreement/plume-glowing", |d| {
                let grid = GridRef { file: "embedded:plume.vdb".into(), grid: Some("temperature".into()) };
                d.medium_mut().emission =
                    Some(EmissionDoc { temperature: Some(grid), kelvin: 1.3, scale: 20.0 });
                d.estimator.heuristics.components = Heuristic::Power;
            })
            .among(&SEVERAL_COMPONENTS),
        plume
            .varied("agreement/plume-residual-ratio", |d| d.estimator.transmittance = "residual-ratio".into())
            .among(&CONNECTING),
        plume
            .varied("agreement/plume-power-series", |d| d.estimator.transmittance = "power-series".into())
            .among(&CONNECTING),
        cloud
            .varied("agreement/cloud-unbiased-marching", |d| {
                d.estimator.transmittance = "unbiased-marching".into();
            })
            .among(&CONNECTING),
        cloud
            .varied("agreement/cloud-delta", |d| d.estimator.transmittance = "delta".into())
            .among(&CONNECTING),
        plume
            .varied("agreement/plume-apart", |d| d.estimator.bookkeeping = Bookkeeping::ApartF64)
            .among(&FAMILIES_WITH_DISTANCE_SAMPLING),
        plume
            .varied("agreement/plume-pairwise", |d| d.estimator.bookkeeping = Bookkeeping::Pairwise)
            .among(&FAMILIES_WITH_DISTANCE_SAMPLING),
        plume,
        cloud.varied("agreement/cloud-roulette", |d| d.estimator.roulette_depth = Some(2)),
        cloud.varied("agreement/cloud-guided-lattice", |d| {
            d.estimator.directions = DirectionSampling::TowardsLights;
            d.estimator.sampler = SamplerKind::Lattice;
            d.medium_mut().majorant.resolution = Some(9);
        }),
        cloud,
        inside,
        scene("fog", &format!("{ASIDE}{FOG}"))?.among(&SEVERAL_COMPONENTS),
        grids.varied("agreement/rgb-grids-rgb", |d| d.estimator.mode = Mode::Rgb),
        grids,
        scene("zero-ends", &format!("{ASIDE}{NO_EXTINCTION_AT_THE_ENDS}"))?,
    ])
}
