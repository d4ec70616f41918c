//! Damaged files: an error or a grid, never a panic, a long run time or excessive memory.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test may panic, and prints its tables"
)]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use majorant_core::io::volume::{
    ReadLimits, info, info_bytes, read_sparse_volume_bytes, read_volume, read_volume_bytes,
};
use majorant_tests::volumes::{self, mutate};

const TRUNCATIONS: usize = 200;
const BYTE_FLIPS: usize = 500;
/// Maximum time for one damaged file, for description and reading together.
const MAX_TIME: Duration = Duration::from_secs(30);

/// Limits small enough that a violation is visible in the memory of the process.
const LIMITS: ReadLimits = ReadLimits {
    max_file_bytes: 1 << 22,
    max_tree_bytes: 1 << 26,
    max_dense_values: 1 << 24,
    max_blocks: 1 << 22,
};

/// Results for the damaged copies of one file.
#[derive(Default, Debug)]
struct Tally {
    errors: usize,
    read: usize,
    slowest: Duration,
}

/// Reads and describes one damaged copy. A panic fails the test by itself.
fn attempt(bytes: &[u8], label: &str, tally: &mut Tally) {
    let start = Instant::now();
    let read = read_volume_bytes(bytes, label, None, &LIMITS);
    let mut messages = Vec::from_iter(read.as_ref().err().map(ToString::to_string));
    if label.ends_with(".vdb") {
        let sparse = read_sparse_volume_bytes(bytes, label, None, &LIMITS, &|_| ());
        messages.extend(sparse.err().map(|error| error.to_string()));
        match info_bytes(bytes, label, &LIMITS) {
            Ok(grids) => messages.extend(grids.into_iter().filter_map(|grid| grid.error)),
            Err(error) => messages.push(error.to_string()),
        }
    }
    tally.slowest = tally.slowest.max(start.elapsed());
    *if read.is_ok() { &mut tally.read } else { &mut tally.errors } += 1;
    for message in messages {
        assert!(message.starts_with(label), "no file name: {message}");
        assert!(!message.contains("panicked"), "caught a panic of vdb-rs: {message}");
    }
}

fn damage(path: &Path) {
    let bytes = std::fs::read(path).unwrap();
    let label = path.file_name().unwrap().to_str().unwrap();
    let (mut cut, mut flipped) = (Tally::default(), Tally::default());
    for copy in mutate::truncations(&bytes, TRUNCATIONS, 1) {
        attempt(&copy, label, &mut cut);
    }
    for copy in mutate::byte_flips(&bytes, BYTE_FLIPS, 2) {
        attempt(&copy, label, &mut flipped);
    }
    for copy in mutate::blosc_flips(&bytes, BYTE_FLIPS, 3) {
        attempt(&copy, label, &mut flipped);
    }
    println!("{label:32} truncated: {cut:?}\n{:32} flipped: {flipped:?}", "");
    assert_eq!(cut.read, 0, "{label}: a truncated file was read");
    assert!(cut.slowest.max(flipped.slowest) < MAX_TIME, "{label} took too long");
}

/// Peak memory of this process, in bytes.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? << 10)
}

/// Checks the peak memory of the process, in which all tests of this file use [`LIMITS`].
fn assert_little_memory() {
    if let Some(peak) = peak_memory() {
        println!("peak memory: {} MB", peak >> 20);
        assert!(peak < 512 << 20, "{peak} bytes");
    }
}

#[test]
fn damaged_fixtures_do_no_harm() {
    let small = |path: &PathBuf| path.metadata().unwrap().len() < 40_000;
    let fixtures = volumes::files(&volumes::fixtures());
    for path in fixtures.iter().filter(|path| path.extension().is_some_and(|e| e == "vdb")) {
        if small(path) && !path.ends_with("nogrids.vdb") {
            damage(path);
        }
    }
    assert_little_memory();
}

#[test]
fn damaged_volumes_do_no_harm() {
    let Some(folder) = volumes::volumes() else {
        return;
    };
    for name in [
        "arnold_torus01.vdb",
        "gaffer_sphere.vdb",
        "usd_densityAndHeat.vdb",
        "oiio_sphere.vdb",
        "nan_inf.vdb",
        "instanced.vdb",
        "stream_nooffsets.vdb",
        "half_zipmask.vdb",
        "tiles_half_bloscmask.vdb",
        "rw_half_mask_v224_zip.vdb",
        "rw_half_none_v220_zip.vdb",
    ] {
        damage(&volumes::find(&folder, name).unwrap());
    }
    damage(&folder.join("mitsuba_albedo.vol"));
    assert_little_memory();
}

#[test]
fn hostile_volumes_are_errors() {
    let Some(folder) = volumes::volumes() else {
        return;
    };
    let files = volumes::files(&folder.join("hostile"));
    assert!(files.len() >= 5);
    for path in files {
        let error = read_volume(&path, None, &LIMITS).unwrap_err();
        println!("{error}");
        assert!(info(&path).map_or(true, |grids| grids.iter().all(|grid| grid.error.is_some())));
    }
}
