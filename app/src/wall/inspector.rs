//! State of the tabs for paths, rays, contributions and noise that persists between frames.

use crate::background_query::BackgroundQuery;
use majorant_core::estimator::Entry;
use majorant_core::inspect::{BenchPlan, Evidence, Ledger, RayBench, Recording, Split, Strategies};
use majorant_core::scene::CameraDoc;
use majorant_core::transmittance::{Shape, TransmittanceKind};
use std::sync::Arc;

/// Input of the replay of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathQuestion {
    /// View, its submission, and how often its majorants were raised.
    pub of: (usize, u64, usize),
    /// Pixel, column and row.
    pub pixel: [usize; 2],
    /// Index of the sample.
    pub sample: u64,
    /// Id of the estimator.
    pub estimator: &'static str,
}

/// A replayed path with its path weights.
pub struct Replayed {
    /// Recorded events.
    pub recording: Recording,
    /// Path weights after every event.
    pub ledger: Ledger,
}

/// Medium along the ray of an event.
pub struct Segment {
    /// The path.
    pub of: Arc<Replayed>,
    /// Index of the note at which the ray begins.
    pub began: usize,
    /// Extinction and majorants; `None` if the ray misses the medium.
    pub bench: Option<RayBench>,
}

/// State of the *Path* tab, see `dock/path`.
#[derive(Default)]
pub struct PathState {
    /// Background replay.
    pub query: BackgroundQuery<PathQuestion, Replayed>,
    /// Chosen sample; `None` for the brightest.
    pub sample: Option<u64>,
    /// Estimator that is replayed with the same random numbers, instead of the view's.
    pub under: Option<&'static Entry>,
    /// Index of the selected event.
    pub step: usize,
    /// Whether the table has to scroll to the selected event.
    pub scroll: bool,
    /// Camera of the 3D view; `None` until it is initialized from the scene's camera.
    pub eye: Option<CameraDoc>,
    /// Medium along the ray of the selected event.
    pub segment: Option<Segment>,
    /// Pixel to which the other fields belong.
    pub pixel: Option<[usize; 2]>,
}

impl PathState {
    /// Selects a sample of a pixel, at its first event.
    pub fn choose(&mut self, pixel: [usize; 2], sample: u64) {
        (self.pixel, self.sample, self.step, self.scroll) = (Some(pixel), Some(sample), 0, true);
    }
}

/// Input of a decomposition of an image into contributions.
#[derive(Clone, Debug, PartialEq)]
pub struct PartsQuestion {
    /// View, its submission, and how often its majorants were raised.
    pub of: (usize, u64, usize),
    /// Property by which contributions are separated.
    pub split: Split,
    /// Samples per pixel.
    pub spp: u64,
}

/// State of the *Contributions* tab, see `dock/parts`.
#[derive(Default)]
pub struct PartsState {
    /// Background tracing of the contributions.
    pub query: BackgroundQuery<PartsQuestion, Strategies>,
    /// Property by which contributions are separated.
    pub split: Split,
    /// Chosen samples per pixel; `None` for the default.
    pub spp: Option<u64>,
    /// Textures of the contributions.
    pub uploaded: Vec<egui::TextureHandle>,
    /// Contributions shown by the textures.
    pub hung_of: Option<Arc<Strategies>>,
    /// Exposure of the textures, in stops.
    pub exposure: f32,
    /// Whether to show shares of the pixel's radiance instead of radiance.
    pub as_shares: bool,
    /// Whether the textures show shares.
    pub hung_as_shares: bool,
    /// Start of the playback, in egui's time in seconds; `None` if it is stopped.
    pub playing: Option<f64>,
}

impl PartsState {
    /// Samples per pixel, 4 by default.
    #[must_use]
    pub fn spp(&self) -> u64 {
        self.spp.unwrap_or(4)
    }
}

/// Medium of the *Ray* tab.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Through {
    /// The scene's medium, along the ray of the picked pixel.
    #[default]
    Pixel,
    /// An analytic shape.
    Shape(Shape),
}

/// Input of a measurement of transmittance.
#[derive(Clone, Debug, PartialEq)]
pub struct RayQuestion {
    /// View and its submission, for the ray of a pixel.
    pub of: Option<(usize, u64)>,
    /// Pixel, for the ray of a pixel.
    pub pixel: Option<[usize; 2]>,
    /// Medium.
    pub through: Through,
    /// Wavelength or channel for the ray of a pixel; extinction, cells and factor for a shape.
    pub numbers: [f32; 3],
    /// Estimator, number of estimates and seed.
    pub plan: BenchPlan,
}

/// State of the *Ray* tab, see `dock/ray`.
pub struct RayState {
    /// Background measurement.
    pub query: BackgroundQuery<RayQuestion, RayBench>,
    /// Medium.
    pub through: Through,
    /// Chosen estimator; `None` for the default.
    pub kind: Option<TransmittanceKind>,
    /// Wavelength in spectral mode, in nm.
    pub lambda_nm: f32,
    /// Channel in RGB mode.
    pub channel: usize,
    /// Maximum extinction of a shape, per unit of length.
    pub extinction: f32,
    /// Number of cells of the shape's majorant.
    pub cells: u32,
    /// Majorant divided by the tight bound.
    pub factor: f32,
    /// Index of the estimate whose steps are shown.
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
    /// Estimator, that of the paths by default.
    #[must_use]
    pub fn kind(&self) -> TransmittanceKind {
        self.kind.unwrap_or(TransmittanceKind::ALONG_THE_PATH)
    }
}

/// Input of a noise analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseQuestion {
    /// View, its submission, and how often its majorants were raised.
    pub of: (usize, u64, usize),
    /// Box to which the analysis is restricted.
    pub region: Option<[u32; 4]>,
}

/// State of the tabs.
#[derive(Default)]
pub struct Inspector {
    /// *Path* tab.
    pub path: PathState,
    /// *Ray* tab.
    pub ray: RayState,
    /// *Contributions* tab.
    pub parts: PartsState,
    /// *Noise* tab, see `dock/noise`.
    pub noise: BackgroundQuery<NoiseQuestion, Evidence>,
}
