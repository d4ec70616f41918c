//! Families of validation cases, one file each, with the derivation of the answer at its head. A new family
//! is one line in [`FAMILIES`]: the command line, the window and the tests iterate over it.

mod agreement;
mod beer_lambert;
mod emission;
mod furnace;
mod half_space;
mod interpolation;
mod lights;
mod materials;
mod media;
mod oracle;
mod shapes;
mod single_scattering;
mod thermal;

use super::{Case, CheckError, Family};
use crate::estimator::{Axis, Entry, REGISTRY};
use rayon::prelude::*;
use std::sync::LazyLock;

/// All families, from the simplest to the most complex.
pub static FAMILIES: &[Family] = &[
    furnace::FAMILY,
    beer_lambert::FAMILY,
    interpolation::FAMILY,
    emission::FAMILY,
    single_scattering::FAMILY,
    thermal::FAMILY,
    lights::FAMILY,
    media::FAMILY,
    shapes::FAMILY,
    materials::FAMILY,
    half_space::FAMILY,
    agreement::FAMILY,
    oracle::FAMILY,
];

/// Estimators with next-event estimation.
static CONNECTING: LazyLock<Vec<Entry>> =
    LazyLock::new(|| REGISTRY.iter().filter(|entry| entry.connects()).copied().collect());

/// Estimators with next-event estimation and one without: for cases about phase functions and lights, on
/// which the unidirectional estimators differ only in the time that they need.
static CONNECTING_AND_ONE: LazyLock<Vec<Entry>> = LazyLock::new(|| {
    REGISTRY.iter().filter(|e| e.id == "spectral-mis").chain(CONNECTING.iter()).copied().collect()
});

/// Estimators whose paths carry several components. An estimator with one component per path has additional
/// colour noise. It would take most of the time, and is excluded from cases about features that do not affect
/// it.
static SEVERAL_COMPONENTS: LazyLock<Vec<Entry>> =
    LazyLock::new(|| REGISTRY.iter().filter(|entry| entry.id != "independent").copied().collect());

/// Estimators with a choice of distance sampling.
static WITH_DISTANCE_SAMPLING: LazyLock<Vec<Entry>> =
    LazyLock::new(|| REGISTRY.iter().filter(|entry| entry.uses(Axis::Distances)).copied().collect());

/// Estimators of [`WITH_DISTANCE_SAMPLING`] whose paths carry several components.
static FAMILIES_WITH_DISTANCE_SAMPLING: LazyLock<Vec<Entry>> =
    LazyLock::new(|| WITH_DISTANCE_SAMPLING.iter().filter(|entry| entry.carries_family()).copied().collect());

/// Unidirectional sampling alone and the full combination: for cases about the medium, where next-event
/// estimation alone needs many paths.
static UNIDIRECTIONAL_AND_FULL: LazyLock<Vec<Entry>> = LazyLock::new(|| {
    REGISTRY.iter().filter(|entry| ["spectral-mis", "uni-nee-mis"].contains(&entry.id)).copied().collect()
});

/// Estimators that sample free flights by the majorant of the hero: where extinctions differ a hundredfold,
/// free flights by the majorant of the densest component take a hundred times as long for the same result.
static BY_HERO: LazyLock<Vec<Entry>> =
    LazyLock::new(|| REGISTRY.iter().filter(|entry| entry.hero_draws()).copied().collect());

/// The cases of a quick check, or of a deep one.
///
/// # Errors
/// When the program was built with a damaged case.
pub fn built_in(deep: bool) -> Result<Vec<Case>, CheckError> {
    let families = FAMILIES.par_iter().filter(|f| deep || !f.deep_only);
    families.map(|f| (f.cases)()).collect::<Result<Vec<_>, _>>().map(|cases| cases.concat())
}

/// The cases of a family, or the single case with this name; empty if there is none.
///
/// # Errors
/// As [`built_in`].
pub fn named(name: &str) -> Result<Vec<Case>, CheckError> {
    let Some(family) = FAMILIES.iter().find(|f| name.split('/').next() == Some(f.id)) else {
        return Ok(Vec::new());
    };
    let mut cases = (family.cases)()?;
    cases.retain(|case| name == family.id || name == case.name);
    Ok(cases)
}

/// A distant camera on the z axis, so narrow that all rays coincide with the axis: they cross a cube about
/// the origin from z = ½ to z = −½.
const AXIS: &str = "
majorant = 1
[camera]
origin = [0.0, 0.0, 60.0]
target = [0.0, 0.0, 0.0]
fov_deg = 0.01
[film]
width = 2
height = 2
";

/// A camera that views the origin from the side and above.
const ASIDE: &str = "
majorant = 1
[camera]
origin = [0.9, 0.7, 2.2]
target = [0.0, 0.0, 0.0]
fov_deg = 30.0
[film]
width = 8
height = 8
";
