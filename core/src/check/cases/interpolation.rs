//! Absorption through rough grids, in blocks of pixels, by quadrature.
//!
//! The colour of a block is the mean over its pixel areas of e^(−σ ∫ density ds). The column ∫ density ds is
//! integrated along every ray of a fine raster, through a trilinear interpolation that is written index by
//! index from the definitions of the two formats: `.npy` values at cell centres, constant beyond the
//! outermost; OpenVDB values at integer indices, interpolated to the background. An offset of half a voxel is
//! detected. Most voxels of one grid are empty.

use super::super::truth::{self, Lattice3, Points};
use super::super::{Answer, Case, CheckError, Family, Layout, fixture};
use super::ASIDE;
use crate::io::Library;
use crate::io::volume::{self, ReadLimits};
use crate::scene::{DensityDoc, GridRef};
use glam::DVec3;

pub(super) const FAMILY: Family = Family {
    id: "interpolation",
    about: "Absorption through rough grids, in blocks of pixels, by quadrature along every ray.",
    deep_only: false,
    cases,
};

const LAYOUT: Layout = Layout { columns: 4, rows: 4 };
/// Pixels along a side of the image, and quadrature rays along a side of each pixel.
const PIXELS: u32 = 8;
const RAYS: u32 = 28;
const CELLS: u32 = 100;

/// Columns ∫ density ds of a raster of rays, grouped by block.
fn columns(density: impl Fn(DVec3) -> f64 + Sync, half: DVec3) -> Vec<Vec<f64>> {
    // The camera of `ASIDE`, derived from its definition.
    let origin = DVec3::new(0.9, 0.7, 2.2);
    let forward = -origin.normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let tan = 15f64.to_radians().tan();
    let side = PIXELS * RAYS;
    let mut blocks = vec![Vec::new(); LAYOUT.blocks()];
    for j in 0..side {
        for i in 0..side {
            let at = |k: u32| (f64::from(k) + 0.5) / f64::from(side);
            let (x, y) = (2.0 * at(i) - 1.0, 1.0 - 2.0 * at(j));
            let direction = (right * (x * tan) + up * (y * tan) + forward).normalize();
            let column = truth::box_interval(origin, direction, DVec3::ZERO, half).map_or(0.0, |(a, b)| {
                (b - a) * truth::integrate(CELLS, |s| density(origin + direction * (a + (b - a) * s)))
            });
            let block = (j * LAYOUT.rows / side) * LAYOUT.columns + i * LAYOUT.columns / side;
            blocks[block as usize].push(column);
        }
    }
    blocks
}

/// Expected image of these columns in RGB mode.
fn rgb(blocks: &[Vec<f64>], sigma: [f64; 3]) -> Answer {
    let colours: Vec<_> = blocks
        .iter()
        .map(|rays| sigma.map(|s| rays.iter().map(|c| (-s * c).exp()).sum::<f64>() / rays.len() as f64))
        .collect();
    Answer::blocks(&colours).within(RASTER)
}

/// Expected image in spectral mode.
fn spectral(blocks: &[Vec<f64>], sigma: Points) -> Answer {
    // Transmittance is smooth in σ, so that a table suffices.
    let (most, entries) = (8.0, 400);
    let table = |rays: &[f64]| -> Vec<f64> {
        (0..=entries)
            .map(|i| {
                let s = most * f64::from(i) / f64::from(entries);
                rays.iter().map(|c| (-s * c).exp()).sum::<f64>() / rays.len() as f64
            })
            .collect()
    };
    let colours: Vec<_> = blocks
        .iter()
        .map(|rays| {
            let table = table(rays);
            truth::film(|lambda| {
                let x = sigma.at(lambda) / most * f64::from(entries);
                let i = x as usize;
                table[i] + (table[i + 1] - table[i]) * (x - i as f64)
            })
        })
        .collect();
    Answer::blocks(&colours).within(RASTER)
}

/// Relative error from the finite raster of rays: one twice as fine differs by at most 2.9·10⁻⁴ in any block.
const RASTER: f64 = 4e-4;

fn case(name: &str, file: &str, extinction: &str, mode: &str, fit: f64) -> Result<Case, CheckError> {
    let toml = format!(
        "{ASIDE}
        [medium]
        extinction = {extinction}
        albedo = 0.0
        density = {{ kind = \"grid\", file = \"{file}\" }}
        placement = {{ fit = {fit} }}
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"{mode}\""
    );
    Ok(Case::new(format!("interpolation/{name}"), &toml, Answer::Agreement)?
        .in_blocks(LAYOUT.columns, LAYOUT.rows))
}

/// Indices beyond the ends are clamped.
fn held(i: i64, n: i64) -> Option<i64> {
    Some(i.clamp(0, n - 1))
}

/// Indices beyond the ends have no value.
fn fading(i: i64, n: i64) -> Option<i64> {
    (0..n).contains(&i).then_some(i)
}

fn cell_centred(lattice: &Lattice3, half: DVec3) -> Vec<Vec<f64>> {
    let n = DVec3::from_array(lattice.size.map(|n| n as f64));
    columns(|p| lattice.at((p / (2.0 * half) + 0.5) * n - 0.5, held), half)
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let sigma = [1.0, 3.0, 6.0];
    let sigma_toml = "{ rgb = [1.0, 3.0, 6.0] }";
    // The longest side is scaled to `fit`.
    let half = |size: [usize; 3], fit: f64| {
        let n = DVec3::from_array(size.map(|n| n as f64));
        n * (0.5 * fit / n.max_element())
    };
    let rough = fixture::rough_lattice([3, 4, 5], 7);
    let rough_columns = cell_centred(&rough, half(rough.size, 1.2));
    let files = Library::default().with_volume("rough.npy", rough.npy());
    let base = case("cells", "rough.npy", sigma_toml, "rgb", 1.2)?
        .with_files(files.clone())
        .answered(rgb(&rough_columns, sigma));
    let mut cases = [0.5f32, 1.7, 10.0]
        .map(|factor| {
            base.varied(format!("interpolation/majorant-{factor}"), |doc| {
                doc.medium_mut().majorant.factor = factor;
            })
        })
        .to_vec();
    cases.push(base);

    let points = Points(&[(430.0, 1.0), (540.0, 6.0), (620.0, 0.5)]);
    cases.push(
        case("cells-nm", "rough.npy", &points.toml(), "spectral", 1.2)?
            .with_files(files)
            .answered(spectral(&rough_columns, points)),
    );

    let sparse = fixture::rough_lattice([9, 7, 8], 1);
    cases.push(
        case("empty-cells", "sparse.npy", sigma_toml, "rgb", 1.2)?
            .with_files(Library::default().with_volume("sparse.npy", sparse.npy()))
            .answered(rgb(&cell_centred(&sparse, half(sparse.size, 1.2)), sigma)),
    );

    // In an OpenVDB file the box extends one voxel beyond the outermost values on every side.
    let bytes: &'static [u8] = include_bytes!("../../../../assets/volumes/tiny_instance.vdb");
    let voxels = volume::read_volume_bytes(bytes, "tiny.vdb", Some("density"), &ReadLimits::default());
    let voxels = voxels
        .map_err(|e| CheckError::Reference { name: "interpolation/vdb".into(), reason: e.to_string() })?;
    let n = DVec3::from_array(voxels.size.map(|n| n as f64 + 1.0));
    let half = n * (0.6 / n.max_element());
    let lattice = Lattice3 { size: voxels.size, values: voxels.values };
    let rays = columns(|p| lattice.at((p / (2.0 * half) + 0.5) * n - 1.0, fading), half);
    let vdb = case("vdb", "tiny.vdb", sigma_toml, "rgb", 1.2)?
        .with_files(Library::default().with_volume("tiny.vdb", bytes))
        .answered(rgb(&rays, sigma));
    // The file has two grids.
    cases.push(vdb.varied("interpolation/vdb", |doc| {
        doc.medium_mut().density =
            DensityDoc::Grid(GridRef { file: "tiny.vdb".into(), grid: Some("density".into()) });
    }));
    Ok(cases)
}
