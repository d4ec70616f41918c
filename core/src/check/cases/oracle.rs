//! Images of fifteen scenes from independent renderers.
//!
//! The scenes, references and their provenance are in `assets/oracle`: block means of converged images in
//! linear sRGB with standard errors, and for S6 also by quadrature. S4 and S5 are one plume in RGB and in
//! spectral mode. S7 has two overlapping media, which are one grid in the other renderer, and S8 a ball of
//! fog around a light; S9 to S11 have meshes that reflect, bound a medium and emit, S12 to S14 glass,
//! metal, a mirror and a pane. S1, S2, S3 and S6 have the same coefficients at every wavelength, so that their images apply to
//! spectral mode as well, in the colour of illuminant E instead of white. The reference of S5 was rendered
//! with observer tables that are 0.1 % off. Where an estimator rarely hits a light, blocks are larger, since
//! every batch must yield a reliable noise estimate.

use super::super::{Answer, Case, CheckError, Family, Value, truth};
use crate::estimator::REGISTRY;
use crate::io::volume::{ReadLimits, read_volume_bytes};
use crate::io::{Library, scene_file};
use crate::scene::Mode;

pub(super) const FAMILY: Family = Family {
    id: "oracle",
    about: "Images of nine scenes by independent renderers, in blocks, within both standard errors.",
    deep_only: true,
    cases,
};

struct Oracle {
    name: &'static str,
    /// File with the expected image.
    file: &'static str,
    toml: &'static str,
    reference: &'static [u8],
    stderr: &'static [u8],
    /// Blocks along a side.
    side: usize,
    /// Maximum number of paths of an estimator that rarely hits a light.
    budget: Option<u64>,
}

macro_rules! oracle {
    ($name:literal, $reference:literal, $side:literal, $budget:expr) => {
        Oracle {
            name: $name,
            file: $reference,
            toml: include_str!(concat!("../../../../assets/oracle/", $name, "/scene.toml")),
            reference: include_bytes!(concat!("../../../../assets/oracle/", $name, "/", $reference)),
            stderr: include_bytes!(concat!("../../../../assets/oracle/", $name, "/stderr.npy")),
            side: $side,
            budget: $budget,
        }
    };
}

static ORACLES: &[Oracle] = &[
    oracle!("S1", "reference.npy", 8, None),
    oracle!("S1f", "reference.npy", 8, None),
    oracle!("S2", "reference.npy", 2, Some(3_000_000)),
    oracle!("S3", "reference.npy", 2, Some(3_000_000)),
    oracle!("S4", "reference.npy", 8, None),
    oracle!("S5", "reference.npy", 8, None),
    oracle!("S6", "reference.npy", 8, None),
    oracle!("S6", "analytic.npy", 8, None),
    oracle!("S7", "reference.npy", 8, None),
    oracle!("S8", "reference.npy", 8, Some(3_000_000)),
    oracle!("S9", "reference.npy", 8, Some(400_000)),
    oracle!("S10", "reference.npy", 4, Some(400_000)),
    oracle!("S11", "reference.npy", 4, Some(400_000)),
    oracle!("S12", "reference.npy", 4, Some(400_000)),
    oracle!("S13", "reference.npy", 4, Some(400_000)),
    oracle!("S14", "reference.npy", 4, Some(400_000)),
];

fn files() -> Library {
    let cloud: &'static [u8] = include_bytes!("../../../../assets/oracle/S2/density.npy");
    let plume: &'static [u8] = include_bytes!("../../../../assets/oracle/S4/density.npy");
    let slab: &'static [u8] = include_bytes!("../../../../assets/oracle/S6/density.npy");
    let torus: &'static [u8] = include_bytes!("../../../../assets/oracle/S9/torus.obj");
    let lantern: &'static [u8] = include_bytes!("../../../../assets/oracle/S10/lantern.obj");
    Library::default()
        .with_volume("../S2/density.npy", cloud)
        .with_volume("../S4/density.npy", plume)
        .with_volume("../S6/density.npy", slab)
        .with_volume("../S9/torus.obj", torus)
        .with_volume("../S10/lantern.obj", lantern)
}

/// Blocks along a side of a stored image; it has three channels.
const BLOCKS: usize = 16;

fn table(name: &str, bytes: &[u8]) -> Result<Vec<f64>, CheckError> {
    let damaged = |reason: String| CheckError::Reference { name: name.to_owned(), reason };
    let grid = read_volume_bytes(bytes, "reference.npy", None, &ReadLimits::default())
        .map_err(|e| damaged(e.to_string()))?;
    if (grid.size, grid.channels) != ([BLOCKS, BLOCKS, 1], 3) {
        return Err(damaged(format!("{:?} × {} values", grid.size, grid.channels)));
    }
    Ok(grid.values.iter().map(|v| f64::from(*v)).collect())
}

/// Merges blocks into `side × side`; the errors of independent blocks add in quadrature.
fn merged(mean: &[f64], error: &[f64], side: usize) -> Vec<Value> {
    let k = BLOCKS / side;
    let n = (k * k) as f64;
    let mut out = vec![Value { mean: 0.0, error: 0.0 }; side * side * 3];
    for (i, (mean, error)) in mean.iter().zip(error).enumerate() {
        let (pixel, c) = (i / 3, i % 3);
        let (y, x) = (pixel / BLOCKS, pixel % BLOCKS);
        let value = &mut out[(y / k * side + x / k) * 3 + c];
        value.mean += mean / n;
        value.error = value.error.hypot(error / n);
    }
    out
}

/// Around the plume fewer than one path in a hundred collides, and few of those reach the key light. Blocks
/// can miss this contribution to the sky's radiance of 0.3, and then underestimate their noise; the
/// contribution is therefore added to the error of the expected value.
fn thin_air(value: &mut Value) {
    let added = (value.mean - 0.3).abs();
    if added < 1e-3 {
        value.error = value.error.hypot(added);
    }
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let white = truth::white();
    let mut cases = Vec::new();
    for o in ORACLES {
        let mut doc = scene_file::parse(o.toml, o.name)?;
        // The references are means over blocks of 8 × 8 pixels, which equal the means over 32 × 32 pixels.
        (doc.film.width, doc.film.height) = (32, 32);
        // Independent samples, as the power of the comparison assumes; lattices have a case of their own.
        doc.estimator.sampler = crate::math::SamplerKind::Independent;
        for file in doc.files_mut().into_iter().filter(|file| !file.starts_with("../")) {
            *file = format!("../{}/{file}", o.name);
        }
        let mut values = merged(&table(o.name, o.reference)?, &table(o.name, o.stderr)?, o.side);
        if o.name == "S4" {
            values.iter_mut().for_each(thin_air);
        }
        let mut answer = Answer::Known(values.clone());
        if o.name == "S5" {
            answer = answer.within(1e-3);
        }
        let side = o.side as u32;
        let by_quadrature = o.file == "analytic.npy";
        let name = format!("oracle/{}{}", o.name, if by_quadrature { "-analytic" } else { "" });
        let case = Case {
            name: name.clone(),
            doc,
            layout: super::super::Layout { columns: side, rows: side },
            answer,
            library: files(),
            registry: REGISTRY,
            budget: o.budget,
        };
        // Grey scenes have the same answer in every channel and at every wavelength. S2 is by far the
        // slowest.
        let is_grey = matches!(o.name, "S1" | "S1f" | "S3" | "S6");
        if !by_quadrature && is_grey {
            let coloured = values
                .iter()
                .enumerate()
                .map(|(i, v)| Value { mean: v.mean * white[i % 3], error: v.error * white[i % 3] });
            let spectral = case
                .varied(format!("{name}-nm"), |d| d.estimator.mode = Mode::Spectral)
                .answered(Answer::Known(coloured.collect()));
            cases.push(spectral);
        }
        cases.push(case);
    }
    Ok(cases)
}
