//! What the tabs about single paths hold from frame to frame.

use crate::background::BackgroundQuery;
use majorant_core::estimator::Entry;
use majorant_core::inspect::{BenchPlan, Evidence, Ledger, RayBench, Recording, Split, Strategies};
use majorant_core::scene::CameraDoc;
use majorant_core::transmittance::{Shape, TransmittanceKind};
use std::sync::Arc;

/// A path that is replayed.
#[derive(Clone, Debug, PartialEq)]
pub struct PathQuestion {
    /// Which submission of which view, and how often its majorants were raised.
    pub of: (usize, u64, usize),
    /// The pixel.
    pub pixel: [usize; 2],
    /// The sample.
    pub sample: u64,
    /// By which estimator.
    pub estimator: &'static str,
}

/// A path with its books.
pub struct Replayed {
    /// What was traced.
    pub recording: Recording,
    /// What comes of it.
    pub ledger: Ledger,
}

/// What the ray of a path's event leads through.
pub struct Segment {
    /// Of which path.
    pub of: Arc<Replayed>,
    /// The note that has begun the ray.
    pub began: usize,
    /// Extinction and majorants; none where the ray misses the medium.
    pub bench: Option<RayBench>,
}

/// See `dock/path`.
#[derive(Default)]
pub struct PathState {
    /// The path's recording.
    pub query: BackgroundQuery<PathQuestion, Replayed>,
    /// The sample that was chosen; the brightest if none was.
    pub sample: Option<u64>,
    /// Another estimator that is given the same random numbers.
    pub under: Option<&'static Entry>,
    /// The row of the ledger that is looked at.
    pub step: usize,
    /// Whether the ledger has to show that row.
    pub scroll: bool,
    /// Where the path is looked at from; as the scene's camera stands at first.
    pub eye: Option<CameraDoc>,
    /// What the chosen event's ray leads through.
    pub segment: Option<Segment>,
    /// The pixel that all this is about.
    pub pixel: Option<[usize; 2]>,
}

impl PathState {
    /// Turns to one sample of a pixel, at its first event.
    pub fn choose(&mut self, pixel: [usize; 2], sample: u64) {
        (self.pixel, self.sample, self.step, self.scroll) = (Some(pixel), Some(sample), 0, true);
    }
}

/// An image that is taken apart.
#[derive(Clone, Debug, PartialEq)]
pub struct PartsQuestion {
    /// Which submission of which view, and how often its majorants were raised.
    pub of: (usize, u64, usize),
    /// By what.
    pub split: Split,
    /// Samples per pixel.
    pub spp: u64,
}

/// See `dock/parts`.
#[derive(Default)]
pub struct PartsState {
    /// The parts.
    pub query: BackgroundQuery<PartsQuestion, Strategies>,
    /// By what.
    pub split: Split,
    /// Samples per pixel, if they were chosen.
    pub spp: Option<u64>,
    /// Textures of the parts, and which answer they are of.
    pub uploaded: Vec<egui::TextureHandle>,
    /// The answer that hangs.
    pub hung_of: Option<Arc<Strategies>>,
    /// The exposure that it hangs in.
    pub exposure: f32,
    /// Whether each pixel shows its share of the light instead of light.
    pub as_shares: bool,
    /// Whether it hangs so.
    pub hung_as_shares: bool,
    /// Since when the parts are shown one after another, in egui's time; none while they stand.
    pub playing: Option<f64>,
}

impl PartsState {
    /// Samples per pixel that are taken apart.
    #[must_use]
    pub fn spp(&self) -> u64 {
        self.spp.unwrap_or(4)
    }
}

/// What the ray on the bench leads through.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Through {
    /// The scene's medium, along the picked pixel's ray.
    #[default]
    Pixel,
    /// A shape of the textbooks.
    Shape(Shape),
}

/// A ray that is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct RayQuestion {
    /// Which submission of which view, if it is a pixel's.
    pub of: Option<(usize, u64)>,
    /// The pixel, if it is one's.
    pub pixel: Option<[usize; 2]>,
    /// What it leads through.
    pub through: Through,
    /// The component; or extinction, cells and factor of a shape.
    pub numbers: [f32; 3],
    /// By what.
    pub plan: BenchPlan,
}

/// See `dock/ray`.
pub struct RayState {
    /// The ray.
    pub query: BackgroundQuery<RayQuestion, RayBench>,
    /// What it leads through.
    pub through: Through,
    /// The estimator, if one was chosen.
    pub kind: Option<TransmittanceKind>,
    /// Wavelength of a ray in spectral mode.
    pub lambda_nm: f32,
    /// Channel of one in RGB mode.
    pub channel: usize,
    /// Largest extinction of a shape.
    pub extinction: f32,
    /// Cells of its majorant.
    pub cells: u32,
    /// Its majorant over the least bound.
    pub factor: f32,
    /// Which estimate is shown step by step.
    pub example: u64,
}

impl Default for RayState {
    fn default() -> Self {
        Self {
            query: BackgroundQuery::default(),
            through: Through::Pixel,
            kind: None,
            lambda_nm: 550.0,
            channel: 1,
            extinction: 3.0,
            cells: 4,
            factor: 1.0,
            example: 0,
        }
    }
}

impl RayState {
    /// The estimator.
    #[must_use]
    pub fn kind(&self) -> TransmittanceKind {
        self.kind.unwrap_or(TransmittanceKind::ALONG_THE_PATH)
    }
}

/// A region whose noise is explained.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseQuestion {
    /// Which submission of which view, and how often its majorants were raised.
    pub of: (usize, u64, usize),
    /// The box, if one is drawn.
    pub region: Option<[u32; 4]>,
}

/// What the tabs hold.
#[derive(Default)]
pub struct Inspector {
    /// One path.
    pub path: PathState,
    /// A ray on the bench.
    pub ray: RayState,
    /// An image taken apart.
    pub parts: PartsState,
    /// What is known about the noise. See `dock/noise`.
    pub noise: BackgroundQuery<NoiseQuestion, Evidence>,
}
