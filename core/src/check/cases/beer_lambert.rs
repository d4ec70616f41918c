//! Pure absorption: a ray receives e^(−∫σ ds) of the light behind the medium, at every wavelength.
//!
//! Bouguer, Lambert and Beer: with albedo 0, L = e^(−τ), τ = ∫ σt ds. The cube has depth 1 along the axis, so
//! that a homogeneous one has τ = σ. A density that is linear along the axis, from a at the back to b in
//! front, has τ = σ (a + b)/2; from inside, at depth fraction s from the back, σ (a s + (b−a) s²/2). (A
//! two-voxel grid is constant beyond the voxel centres: linear from ¼ to ¾, constant outside.) In spectral
//! mode the film shows ∫ L(λ) e^(−τ(λ)) response(λ) dλ; light in a narrow band tests single wavelengths.

use super::super::truth::{self, Points};
use super::super::{Answer, Case, CheckError, Family, Layout, fixture};
use super::AXIS;
use crate::io::Library;

pub(super) const FAMILY: Family = Family {
    id: "beer-lambert",
    about: "Pure absorption: e^(−∫σ ds) of the light behind the medium, at every wavelength.",
    deep_only: false,
    cases,
};

const SIGMA: Points = Points(&[(400.0, 0.3), (500.0, 1.5), (560.0, 0.5), (700.0, 1.0)]);
/// Ratio of 100 between wavelengths, and no extinction at the red end.
const CHROMATIC: Points = Points(&[(420.0, 0.04), (530.0, 4.0), (620.0, 0.0)]);
const BANDS: [(&str, Points); 3] = [
    ("band-450nm", Points(&[(415.0, 0.0), (425.0, 1.0), (475.0, 1.0), (485.0, 0.0)])),
    ("band-540nm", Points(&[(505.0, 0.0), (515.0, 1.0), (565.0, 1.0), (575.0, 0.0)])),
    ("band-620nm", Points(&[(585.0, 0.0), (595.0, 1.0), (645.0, 1.0), (655.0, 0.0)])),
];

fn slab(name: &str, medium: &str, light: &str, mode: &str, colour: [f64; 3]) -> Result<Case, CheckError> {
    let toml = format!(
        "{AXIS}
        [medium]
        albedo = 0.0
        {medium}
        [[lights]]
        kind = \"environment\"
        radiance = {light}
        [estimator]
        mode = \"{mode}\""
    );
    Case::new(format!("beer-lambert/{name}"), &toml, Answer::uniform(colour, Layout::WHOLE))
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let through = |sigma: Points, light: Points| truth::film(|l| light.at(l) * (-sigma.at(l)).exp());
    let mut cases = Vec::new();
    for (name, band) in BANDS {
        let medium = format!("extinction = {}", SIGMA.toml());
        cases.push(slab(name, &medium, &band.toml(), "spectral", through(SIGMA, band))?);
    }
    let medium = format!("extinction = {}", CHROMATIC.toml());
    let white = Points(&[(500.0, 1.0)]);
    cases.push(slab("chromatic-nm", &medium, "1.0", "spectral", through(CHROMATIC, white))?);

    let rgb = |sigma: [f64; 3]| sigma.map(|s| (-s).exp());
    for factor in [0.5f64, 1.0, 1.7, 10.0] {
        // Below 1 the variance grows exponentially with the excess: the optical depth stays near one mean
        // free path.
        let scale = if factor < 1.0 { 0.3 } else { 1.0 };
        let sigma = [0.04, 4.0, 0.0];
        let medium = format!(
            "extinction = {{ rgb = {sigma:?} }}\nscale = {scale}\nmajorant = {{ factor = {factor:?} }}"
        );
        let colour = rgb(sigma.map(|s| s * scale));
        cases.push(slab(&format!("majorant-{factor}"), &medium, "1.0", "rgb", colour)?);
    }

    // z increases towards the camera: 0.5 at the back, 3.5 in front.
    let (back, front) = (0.5f64, 3.5f64);
    let two = fixture::npy([1, 1, 2], 1, &[back as f32, front as f32]);
    let medium = "extinction = { rgb = [0.2, 0.6, 1.0] }
        density = { kind = \"grid\", file = \"linear.npy\" }
        placement = { fit = 1.0, scale = [2.0, 2.0, 1.0] }";
    let column = 0.5 * (back + front);
    let whole = [0.2, 0.6, 1.0].map(|s| (-s * column).exp());
    let linear = slab("linear", medium, "1.0", "rgb", whole)?
        .with_files(Library::default().with_volume("linear.npy", two));
    // From the centre of the cube to the back: constant over a quarter, then linear up to the mean.
    let rest = 0.25 * back + 0.25 * 0.5 * (back + column);
    let inside = [0.2, 0.6, 1.0].map(|s| (-s * rest).exp());
    cases.push(
        linear
            .varied("beer-lambert/linear-inside", |doc| doc.camera.origin = [0.0, 0.0, 0.0])
            .varied("beer-lambert/linear-inside", |doc| doc.camera.target = [0.0, 0.0, -1.0])
            .answered(Answer::uniform(inside, Layout::WHOLE)),
    );
    cases.push(linear);
    Ok(cases)
}
