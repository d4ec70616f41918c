//! Renders scenes into batch means of pixel blocks.

use crate::stats::{Comparison, mean_and_error};
use majorant_core::estimator::{self, Kernel, PathIndex, Settings};
use majorant_core::io::volume::{Limits, read_volume};
use majorant_core::io::{Library, scene_file};
use majorant_core::scene::{Scene, SceneDoc, build};
use majorant_core::transport::Wanted;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Independent repeats of every render.
pub const BATCHES: usize = 32;

/// How a test scene begins that looks at the origin from outside, in 8 × 8 pixels.
pub const CAMERA: &str = "
majorant = 1
[camera]
origin = [0.4, 0.3, 2.2]
fov_deg = 30.0
[film]
width = 8
height = 8
";

/// The folder of the tests.
pub fn tests_folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Parses a scene from text.
pub fn scene(toml: &str) -> SceneDoc {
    scene_file::parse(toml, "test scene").unwrap_or_else(|e| panic!("{e}"))
}

/// Freezes a document whose files lie in `base`.
pub fn frozen(doc: &SceneDoc, base: &Path) -> Scene {
    build(doc, &mut Library::default().with_base(base)).unwrap_or_else(|e| panic!("{e}"))
}

/// Batch means of every block and channel of an image.
pub struct Blocks {
    /// `blocks × 3` series of [`BATCHES`] means.
    pub batches: Vec<Vec<f64>>,
}

impl Blocks {
    /// Renders `scene` under an estimator, `BATCHES` times `spp` samples, in `columns × rows` blocks.
    pub fn render(scene: &Scene, doc: &SceneDoc, estimator: &str, spp: u64, columns: u32, rows: u32) -> Self {
        let mut doc = doc.clone();
        doc.estimator.id = estimator.to_owned();
        let kernel = estimator::find(estimator).unwrap().kernel;
        let settings = Settings::new(&doc.estimator, doc.render.seed);
        let per_batch: Vec<Vec<f64>> = (0..BATCHES as u64)
            .into_par_iter()
            .map(|batch| block_means(scene, kernel, &settings, batch * spp..(batch + 1) * spp, columns, rows))
            .collect();
        let series = (columns * rows * 3) as usize;
        let batches = (0..series).map(|i| per_batch.iter().map(|b| b[i]).collect()).collect();
        Self { batches }
    }

    /// Against another render of the same scene.
    pub fn against(&self, other: &Self) -> Vec<Comparison> {
        self.batches
            .iter()
            .zip(&other.batches)
            .map(|(a, b)| {
                let ((ma, ea), (mb, eb)) = (mean_and_error(a), mean_and_error(b));
                Comparison { difference: ma - mb, error: ea.hypot(eb) }
            })
            .collect()
    }

    /// Against known means with known standard errors.
    pub fn against_known(&self, known: &[f64], errors: &[f64]) -> Vec<Comparison> {
        assert_eq!(self.batches.len(), known.len());
        self.batches
            .iter()
            .zip(known.iter().zip(errors))
            .map(|(a, (k, e))| {
                let (mean, error) = mean_and_error(a);
                Comparison { difference: mean - k, error: error.hypot(*e) }
            })
            .collect()
    }

    /// Against one value everywhere.
    pub fn against_constant(&self, value: f64) -> Vec<Comparison> {
        let n = self.batches.len();
        self.against_known(&vec![value; n], &vec![0.0; n])
    }

    /// Mean over everything.
    pub fn mean(&self) -> f64 {
        let all: f64 = self.batches.iter().flatten().sum();
        all / (self.batches.len() * BATCHES) as f64
    }
}

fn block_means(
    scene: &Scene,
    kernel: Kernel,
    settings: &Settings,
    samples: std::ops::Range<u64>,
    columns: u32,
    rows: u32,
) -> Vec<f64> {
    let mut sums = vec![0.0f64; (columns * rows * 3) as usize];
    let mut counts = vec![0u64; (columns * rows) as usize];
    for y in 0..scene.height {
        for x in 0..scene.width {
            let block = (y * rows / scene.height * columns + x * columns / scene.width) as usize;
            for sample in samples.clone() {
                let rgb = kernel(scene, settings, PathIndex { x, y, sample }, Wanted::ALWAYS).rgb;
                assert!(rgb.is_finite(), "pixel ({x}, {y}) sample {sample}: {rgb}");
                counts[block] += 1;
                for c in 0..3 {
                    sums[block * 3 + c] += f64::from(rgb[c]);
                }
            }
        }
    }
    sums.iter().enumerate().map(|(i, s)| s / counts[i / 3] as f64).collect()
}

/// A reference picture of an independent renderer, reduced to `columns × rows` blocks of 16 × 16.
pub struct Oracle {
    pub doc: SceneDoc,
    pub scene: Scene,
    pub mean: Vec<f64>,
    pub error: Vec<f64>,
}

/// Loads an oracle scene and reduces its 16 × 16 blocks further, to `side × side`.
pub fn oracle(name: &str, side: usize) -> Oracle {
    let folder = tests_folder().join("oracle").join(name);
    let doc = scene_file::load(&folder.join("scene.toml")).unwrap_or_else(|e| panic!("{e}"));
    let scene = frozen(&doc, &folder);
    let read = |file: &str| reduce(&table(&folder.join(file)), side);
    let mean = read("reference.npy");
    // Errors of independent blocks add in squares; `reduce` averages, so divide by √(blocks) more.
    let squares: Vec<f64> = table(&folder.join("stderr.npy")).iter().map(|e| e * e).collect();
    let merged = (16 / side).pow(2) as f64;
    let error = reduce(&squares, side).iter().map(|v| (v / merged).sqrt()).collect();
    Oracle { doc, scene, mean, error }
}

/// Reads a `(1, 16, 16, 3)` array.
pub fn table(path: &Path) -> Vec<f64> {
    let grid = read_volume(path, None, &Limits::default()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((grid.size, grid.channels), ([16, 16, 1], 3));
    grid.values.iter().map(|v| f64::from(*v)).collect()
}

/// Averages 16 × 16 blocks into `side × side`.
pub fn reduce(blocks: &[f64], side: usize) -> Vec<f64> {
    let k = 16 / side;
    let mut out = vec![0.0; side * side * 3];
    for y in 0..16 {
        for x in 0..16 {
            for c in 0..3 {
                out[(y / k * side + x / k) * 3 + c] += blocks[(y * 16 + x) * 3 + c] / (k * k) as f64;
            }
        }
    }
    out
}
