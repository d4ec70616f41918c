//! Comparison of grids with the ground truth in `truth.json`.

use std::path::Path;

use majorant_core::io::volume::{
    BLOCK, Background, BlockGrid, GridInfo, ReadLimits, Volume, VolumeError, VoxelGrid, info,
    read_sparse_volume, read_vdb, validate_density,
};
use serde_json::Value;

/// Result of the comparison of one grid.
#[derive(Debug)]
pub struct Verdict {
    pub file: String,
    pub grid: String,
    pub kind: String,
    /// Error message, if the grid was refused.
    pub refused: Option<String>,
    /// Differences from the truth.
    pub wrong: Vec<String>,
    /// Description of the dense grid, or the reason why there is none.
    pub dense: String,
}

impl Verdict {
    pub fn is_wrong(&self) -> bool {
        !self.wrong.is_empty()
    }
}

pub fn print(verdicts: &[Verdict]) {
    for v in verdicts {
        let verdict = match (&v.refused, v.is_wrong()) {
            (_, true) => format!("WRONG {:?}", v.wrong),
            (Some(message), _) => format!("refused: {message}"),
            (None, _) => format!("exact; dense: {}", v.dense),
        };
        println!("{:44} {:20} {:18} {verdict}", v.file, v.grid, v.kind);
    }
    let refused = verdicts.iter().filter(|v| v.refused.is_some()).count();
    let wrong = verdicts.iter().filter(|v| v.is_wrong()).count();
    let exact = verdicts.len() - refused - wrong;
    println!("{} grids: {exact} exact, {refused} refused, {wrong} wrong", verdicts.len());
}

fn load(truth: &Path) -> Vec<Value> {
    serde_json::from_slice(&std::fs::read(truth).unwrap()).unwrap()
}

/// Compares the files in `folder` with all entries of `truth`.
pub fn compare(folder: &Path, truth: &Path) -> Vec<Verdict> {
    let files = load(truth);
    let name = |file: &Value| file["file"].as_str().unwrap().to_owned();
    files.iter().flat_map(|file| compare_file(folder, &name(file), file)).collect()
}

/// Compares a file that contains the grids of another file in another version or compression.
pub fn compare_rewrite(folder: &Path, truth: &Path, rewrite: &str, original: &str) -> Vec<Verdict> {
    let files = load(truth);
    let file = files.iter().find(|file| file["file"] == original).unwrap();
    compare_file(folder, rewrite, file)
}

fn compare_file(folder: &Path, name: &str, file: &Value) -> Vec<Verdict> {
    let path = super::find(folder, name).unwrap_or_else(|| panic!("{name} is missing"));
    let truths = file["grids"].as_array().cloned().unwrap_or_default();
    let infos = match info(&path) {
        Ok(infos) => infos,
        Err(error) => {
            return vec![Verdict {
                file: name.to_owned(),
                grid: String::new(),
                kind: String::new(),
                refused: Some(error.to_string()),
                wrong: Vec::new(),
                dense: String::new(),
            }];
        }
    };
    let mut verdicts = Vec::new();
    let mut used = vec![false; truths.len()];
    for info in &infos {
        let mut verdict = Verdict {
            file: name.to_owned(),
            grid: info.name.clone(),
            kind: info.kind.replace("Tree_", "").replace("_5_4_3", ""),
            refused: info.error.clone(),
            wrong: Vec::new(),
            dense: String::new(),
        };
        let stem = info.name.split('[').next().unwrap();
        let found = (0..truths.len()).find(|&i| {
            !used[i]
                && truths[i]["name"] == stem
                && (info.error.is_some() || truths[i]["active"].as_u64() == info.active_voxels)
        });
        match found {
            None if info.error.is_some() => {}
            None => verdict.wrong.push(format!("no truth for {info:?}")),
            Some(index) => {
                used[index] = true;
                compare_head(info, &truths[index], &mut verdict.wrong);
                if info.error.is_none() {
                    compare_values(info, &truths[index], &mut verdict.wrong);
                    verdict.dense = compare_dense(&path, info, &truths[index], &mut verdict.wrong);
                }
            }
        }
        verdicts.push(verdict);
    }
    if used.contains(&false) {
        verdicts[0].wrong.push("a grid of the truth is missing".to_owned());
    }
    verdicts
}

fn compare_head(info: &GridInfo, truth: &Value, wrong: &mut Vec<String>) {
    for (what, ours, theirs) in [
        ("type", &info.kind, &truth["type"]),
        ("class", &info.class, &truth["class"]),
        ("map", &info.map, &truth["map"]),
    ] {
        if theirs != ours {
            wrong.push(format!("{what} {ours} instead of {theirs}"));
        }
    }
    if truth["half"] != info.half {
        wrong.push(format!("half {}", info.half));
    }
}

/// The truth prints six digits: `0.150024` or `[1, 1, 1]`.
fn background_of(truth: &Value) -> Vec<f32> {
    let text = truth["background"].as_str().unwrap().trim_matches(['[', ']']);
    text.split(", ").map(|number| number.parse().unwrap()).collect()
}

fn differ(ours: &[f32], theirs: &[f32]) -> bool {
    let pairs = ours.iter().zip(theirs);
    ours.len() != theirs.len() || pairs.into_iter().any(|(&a, &b)| differs(a.into(), b.into(), 4e-6))
}

/// Relative difference of two printed numbers.
fn differs(ours: f64, theirs: f64, tolerance: f64) -> bool {
    (ours - theirs).abs() > tolerance * theirs.abs().max(1e-30)
}

fn compare_values(info: &GridInfo, truth: &Value, wrong: &mut Vec<String>) {
    let bbox: Vec<i32> = serde_json::from_value(truth["bbox"].clone()).unwrap();
    if info.bbox.map(|bbox| bbox.to_vec()) != Some(bbox) {
        wrong.push(format!("bbox {:?} instead of {}", info.bbox, truth["bbox"]));
    }
    let background: Vec<f32> = match info.background {
        Some(Background::Scalar(value)) => vec![value],
        Some(Background::Vector(vector)) => vector.to_vec(),
        None => Vec::new(),
    };
    if differ(&background, &background_of(truth)) {
        wrong.push(format!("background {background:?} instead of {}", truth["background"]));
    }
    // Statistics of the truth include values that are not finite.
    if info.non_finite.is_some() {
        return;
    }
    // Statistics of a vector grid are of the sum of its components; see `compare_sums`.
    if matches!(info.background, Some(Background::Vector(_))) {
        return;
    }
    // The truth prints nine digits; doubles and int64 are rounded to f32 on our side.
    for (what, ours, tolerance) in [
        ("min", info.min.map(f64::from), 1e-7),
        ("max", info.max.map(f64::from), 1e-7),
        ("mean", info.mean, 1e-7),
    ] {
        match (ours, truth[what].as_f64()) {
            (Some(ours), Some(theirs)) if !differs(ours, theirs, tolerance) => {}
            other => wrong.push(format!("{what}: {other:?}")),
        }
    }
}

/// Compares the dense grid and its transform. Returns its size, or the reason why there is none.
fn compare_dense(path: &Path, info: &GridInfo, truth: &Value, wrong: &mut Vec<String>) -> String {
    let grid = match read_vdb(path, Some(&info.name), &ReadLimits::default()) {
        Ok(grid) => grid,
        Err(error @ VolumeError::TooLarge { .. }) => return error.to_string(),
        Err(error) => {
            wrong.push(error.to_string());
            return String::new();
        }
    };
    if Some(grid.index_bbox()) != info.bbox {
        wrong.push(format!("dense bbox {:?}", grid.index_bbox()));
    }
    let map = |index: [f64; 3]| grid.world_from_index.transform_point3(index.into()).to_array();
    for (what, ours) in [("i2w0", map([0.0; 3])), ("i2w123", map([1.0, 2.0, 3.0]))] {
        let theirs: [f64; 3] = serde_json::from_value(truth[what].clone()).unwrap();
        let scale = theirs.iter().fold(1e-3_f64, |scale, n| scale.max(n.abs()));
        if ours.iter().zip(theirs).any(|(a, b)| (a - b).abs() > 1e-9 * scale) {
            wrong.push(format!("{what} {ours:?} instead of {theirs:?}"));
        }
    }
    compare_blocks(path, &grid, wrong);
    let mut result = format!("{:?}, {} negative", grid.size, grid.negative);
    if grid.repaired > 0 {
        result += &format!(", {} repaired", grid.repaired);
    } else {
        compare_sums(&grid, info, truth, wrong);
    }
    result
}

/// Reads the grid into blocks, and compares them with the array voxel by voxel.
fn compare_blocks(path: &Path, array: &VoxelGrid, wrong: &mut Vec<String>) {
    let blocks = match read_sparse_volume(path, Some(array.name.as_str()), &ReadLimits::default(), &|_| ()) {
        Ok(Volume::Blocks(blocks)) => blocks,
        Ok(Volume::Array(again)) => {
            if again.values != array.values || again.background == 0.0 && again.channels == 1 {
                wrong.push("a different array instead of blocks".to_owned());
            }
            return;
        }
        Err(error) => return wrong.push(format!("blocks: {error}")),
    };
    let filled = fill(&blocks);
    if filled != array.values {
        let differ = filled.iter().zip(&array.values).filter(|(a, b)| a != b).count();
        wrong.push(format!("{differ} of {} values differ between blocks and array", filled.len()));
    }
    let negative = blocks.negative.map_or(0, |(_, _, count)| count as usize);
    if (blocks.repaired as usize, negative) != (array.repaired, array.negative) {
        wrong.push(format!("blocks: {} repaired, {negative} negative", blocks.repaired));
    }
    let of_blocks = Volume::Blocks(blocks.clone());
    let reason = |checked: Result<(), VolumeError>| checked.err().map(|error| error.to_string());
    let reasons = [reason(of_blocks.validate_density(path)), reason(validate_density(array, path))];
    if reasons[0] != reasons[1] {
        wrong.push(format!("blocks and array as a density: {reasons:?}"));
    }
    let thickest = (of_blocks.thickest_line(), array.thickest_line());
    if (thickest.0 - thickest.1).abs() > 1e-4 * thickest.1.abs() {
        wrong.push(format!("thickest lines of blocks and array: {thickest:?}"));
    }
}

/// Expands blocks and tiles to a dense array.
fn fill(grid: &BlockGrid) -> Vec<f32> {
    let ([nx, ny, nz], channels) = (grid.size(), grid.channels);
    let mut values = vec![0.0; nx * ny * nz * channels];
    let mut set = |at: [i32; 3], voxel: &[f32]| {
        let offset = [0, 1, 2].map(|axis| i64::from(at[axis]) - i64::from(grid.bbox[0][axis]));
        let inside = offset.iter().zip([nx, ny, nz]).all(|(o, n)| (0..n as i64).contains(o));
        if inside {
            let [x, y, z] = offset.map(|o| o as usize);
            let first = (x + nx * (y + ny * z)) * channels;
            values[first..first + channels].copy_from_slice(voxel);
        } else {
            assert!(voxel.iter().all(|v| *v == 0.0), "{at:?} lies outside of the box, and is {voxel:?}");
        }
    };
    for (origin, block) in grid.origins.iter().zip(grid.values.chunks_exact(BLOCK * channels)) {
        for (i, voxel) in (0i32..).zip(block.chunks_exact(channels)) {
            set([origin[0] + i % 8, origin[1] + i / 8 % 8, origin[2] + i / 64], voxel);
        }
    }
    for tile in &grid.tiles {
        let n = tile.edge;
        for i in 0..n * n * n {
            let at = [tile.origin[0] + i % n, tile.origin[1] + i / n % n, tile.origin[2] + i / (n * n)];
            set(at, &tile.value[..channels]);
        }
    }
    values
}

/// Compares voxels by the sum of their channels, as the truth does for vectors.
fn compare_sums(grid: &VoxelGrid, info: &GridInfo, truth: &Value, wrong: &mut Vec<String>) {
    let background: Vec<f64> = match info.background {
        Some(Background::Vector(vector)) => vector.map(f64::from).to_vec(),
        Some(Background::Scalar(value)) => vec![f64::from(value)],
        None => Vec::new(),
    };
    let outside: f64 = background.iter().sum();
    let (mut sum, mut min, mut max) = (0.0, f64::MAX, f64::MIN);
    for voxel in grid.values.chunks_exact(grid.channels) {
        let voxel_sum: f64 = voxel.iter().map(|&value| f64::from(value)).sum();
        sum += voxel_sum;
        // The dense grid has no activity mask; voxels other than the background are certainly active.
        if voxel.iter().zip(&background).any(|(&value, &outside)| f64::from(value) != outside) {
            (min, max) = (min.min(voxel_sum), max.max(voxel_sum));
        }
    }
    let number = |what: &str| truth[what].as_f64().unwrap();
    let (voxels, active) = (grid.voxels() as f64, number("active"));
    let expected = number("mean") * active + outside * (voxels - active);
    let scale = number("min").abs().max(number("max").abs());
    if (sum - expected).abs() > 1e-7 * scale * voxels {
        wrong.push(format!("sum of the dense grid {sum} instead of {expected}"));
    }
    if grid.channels == 3 && (differs(min, number("min"), 1e-6) || differs(max, number("max"), 1e-6)) {
        wrong.push(format!("sums of components from {min} to {max}"));
    }
}
