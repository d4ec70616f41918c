//! Families of cases, one file each, the derivation of the answer at its head. A line in [`FAMILIES`]
//! adds one: the command line, the window and the tests iterate it.

mod agreement;
mod beer_lambert;
mod emission;
mod furnace;
mod half_space;
mod interpolation;
mod lights;
mod oracle;
mod single_scattering;
mod thermal;

use super::{Case, CheckError, Family};
use crate::estimator::{Axis, Entry, REGISTRY};
use rayon::prelude::*;
use std::sync::LazyLock;

/// Every family, the quickest to understand first.
pub static FAMILIES: &[Family] = &[
    furnace::FAMILY,
    beer_lambert::FAMILY,
    interpolation::FAMILY,
    emission::FAMILY,
    single_scattering::FAMILY,
    thermal::FAMILY,
    lights::FAMILY,
    half_space::FAMILY,
    agreement::FAMILY,
    oracle::FAMILY,
];

/// Estimators that connect to lights.
static CONNECTING: LazyLock<Vec<Entry>> =
    LazyLock::new(|| REGISTRY.iter().filter(|entry| entry.connects()).copied().collect());

/// The same, and one that does not connect: for cases about phase functions and lights, on which the unidirectional
/// estimators differ in nothing but the time that they need to tell.
static CONNECTING_AND_ONE: LazyLock<Vec<Entry>> = LazyLock::new(|| {
    REGISTRY.iter().filter(|e| e.id == "spectral-mis").chain(CONNECTING.iter()).copied().collect()
});

/// Those whose paths carry several components. An estimator that carries one at a time is noisier by the noise of colours,
/// and is left out of cases about what it has no part in: it would take most of their time.
static SEVERAL_COMPONENTS: LazyLock<Vec<Entry>> =
    LazyLock::new(|| REGISTRY.iter().filter(|entry| entry.id != "independent").copied().collect());

/// Those that offer a choice of how distances are drawn.
static SPLITTING: LazyLock<Vec<Entry>> =
    LazyLock::new(|| REGISTRY.iter().filter(|entry| entry.uses(Axis::Distances)).copied().collect());

/// Those of them whose paths carry several components.
static SPLITTING_FAMILIES: LazyLock<Vec<Entry>> =
    LazyLock::new(|| SPLITTING.iter().filter(|entry| entry.carries_family()).copied().collect());

/// Walking alone, and all that there is: for cases about the medium, in which connecting alone takes long to tell.
static WALKING_AND_ALL: LazyLock<Vec<Entry>> = LazyLock::new(|| {
    REGISTRY.iter().filter(|entry| ["spectral-mis", "uni-nee-mis"].contains(&entry.id)).copied().collect()
});

/// Those whose paths fly by the majorant of their hero: where extinctions differ a hundredfold, flights by that of the
/// densest component take a hundred times as long to tell the same.
static BY_HERO: LazyLock<Vec<Entry>> =
    LazyLock::new(|| REGISTRY.iter().filter(|entry| entry.hero_draws()).copied().collect());

/// The cases of a usual look, or of a thorough one.
///
/// # Errors
/// When the program was built with a damaged case.
pub fn built_in(deep: bool) -> Result<Vec<Case>, CheckError> {
    let families = FAMILIES.par_iter().filter(|f| deep || !f.deep_only);
    families.map(|f| (f.cases)()).collect::<Result<Vec<_>, _>>().map(|cases| cases.concat())
}

/// The cases of a family, or the one of this name; none if there is no such.
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

/// A camera far away on the z axis, so narrow that all its rays are the axis: a cube about the origin is
/// crossed from z = ½ to z = −½.
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

/// A camera that looks at the origin from the side and above.
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
