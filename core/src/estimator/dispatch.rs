//! Dispatch from a registry entry to a monomorphic path.
//!
//! Mode and medium are matched once per path; the code below is one specialised function per
//! estimator × mode × medium. A single homogeneous medium or density grid that no ray enters twice has a
//! function of its own; all other scenes share one, in which the kind of a medium is matched per segment and
//! per look-up.

use super::{AxisSet, Estimator};
use crate::math::{Sampler, SamplerKind};
use crate::medium::{AnyMedium, LocalMedia, Medium, One, PlacedMedium, Several, SharedMajorant};
use crate::scene::{EstimatorDoc, Heuristic, Mode, Scene};
use crate::spectrum::{Components, Grey, Radiance, RgbChannels, WavelengthSampling, Wavelengths};
use crate::transmittance::TransmittanceKind;
use crate::transport::{Note, PathContext, PathSettings, Trace, World};
use glam::{Vec2, Vec3};

/// Index of a path in an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathIndex {
    /// Column.
    pub x: u32,
    /// Row from the top.
    pub y: u32,
    /// Sample number within the pixel.
    pub sample: u64,
}

/// Function that traces one path. The estimate of a cancelled path is meaningless.
pub type Kernel =
    fn(scene: &Scene, settings: &Settings, at: PathIndex, context: PathContext<'_>) -> PathEstimate;

/// Settings of an estimate, besides the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Spectral or RGB.
    pub mode: Mode,
    /// Correlation of the samples of a pixel.
    pub sampler: SamplerKind,
    /// Wavelength sampling in spectral mode.
    pub wavelengths: WavelengthSampling,
    /// Settings shared by all paths.
    pub path: PathSettings,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Settings {
    /// Creates the settings from the edited document.
    #[must_use]
    pub fn new(doc: &EstimatorDoc, seed: u64) -> Self {
        let path = PathSettings {
            absorption: doc.absorption,
            distances: doc.distances,
            heuristics: doc.heuristics,
            bookkeeping: doc.bookkeeping,
            tracking: doc.tracking,
            fault: doc.fault,
            light_walk: doc.light_walk,
            lights: doc.lights,
            light_sampling: doc.light_sampling,
            transmittance: TransmittanceKind::find(&doc.transmittance)
                .unwrap_or(TransmittanceKind::ALONG_THE_PATH),
            directions: doc.directions,
            max_depth: doc.max_depth.unwrap_or(u32::MAX),
            roulette_depth: doc.roulette_depth.unwrap_or(u32::MAX),
        };
        Self { mode: doc.mode, sampler: doc.sampler, wavelengths: doc.wavelengths, path, seed }
    }

    /// Returns the settings with every axis that the estimator does not use at its default.
    #[inline]
    fn limited_to<E: Estimator>(&self) -> Self {
        Self { path: self.path.limited_to(const { AxisSet::of(E::USES) }), ..*self }
    }
}

/// One path's estimate of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathEstimate {
    /// Estimated radiance in linear sRGB.
    pub rgb: Vec3,
    /// Look-ups in the medium: of its coefficients, and of its temperature for emission.
    pub lookups: u64,
    /// Collisions at which the extinction exceeded the majorant.
    pub exceeded: u64,
}

/// Kernel of an estimator that carries a family of components: 4 wavelengths or 3 channels, or a single
/// component for all of them if the scene is achromatic.
pub(super) fn family<E: Estimator>(
    scene: &Scene,
    s: &Settings,
    at: PathIndex,
    context: PathContext<'_>,
) -> PathEstimate {
    let s = &s.limited_to::<E>();
    // The hero-only heuristic leaves components out and keeps the noise of choosing one.
    let grey = scene.achromatic && s.path.heuristics.components != Heuristic::HeroOnly;
    match (s.mode, grey) {
        (Mode::Spectral, false) => in_medium::<E, Wavelengths<4>, 4>(scene, s, at, context),
        (Mode::Rgb, false) => in_medium::<E, RgbChannels<3>, 3>(scene, s, at, context),
        (_, true) => in_grey_medium::<E>(scene, s, at, context),
    }
}

/// Kernel of an estimator that carries one component at a time.
pub(super) fn single<E: Estimator>(
    scene: &Scene,
    s: &Settings,
    at: PathIndex,
    context: PathContext<'_>,
) -> PathEstimate {
    let s = &s.limited_to::<E>();
    match s.mode {
        Mode::Spectral => in_medium::<E, Wavelengths<1>, 1>(scene, s, at, context),
        Mode::Rgb => in_medium::<E, RgbChannels<1>, 1>(scene, s, at, context),
    }
}

/// As [`family`], with one function for all media: for variants of an estimator that explain it, and whose time
/// is not compared.
pub(super) fn family_in_any_media<E: Estimator>(
    scene: &Scene,
    s: &Settings,
    at: PathIndex,
    context: PathContext<'_>,
) -> PathEstimate {
    let s = &s.limited_to::<E>();
    match s.mode {
        Mode::Spectral => path::<E, _, Wavelengths<4>, 4>(Every(scene), scene, s, at, context),
        Mode::Rgb => path::<E, _, RgbChannels<3>, 3>(Every(scene), scene, s, at, context),
    }
}

fn in_medium<E: Estimator, C: Components<N>, const N: usize>(
    scene: &Scene,
    s: &Settings,
    at: PathIndex,
    context: PathContext<'_>,
) -> PathEstimate {
    match only_medium(scene) {
        Some((AnyMedium::Homogeneous(m), placed)) => path::<E, _, C, N>((m, placed), scene, s, at, context),
        Some((AnyMedium::DensityGrid(m), placed)) => path::<E, _, C, N>((m, placed), scene, s, at, context),
        Some((AnyMedium::RgbGrids(_), _)) | None => path::<E, _, C, N>(Every(scene), scene, s, at, context),
    }
}

/// As [`in_medium`], without a kernel for several media and for RGB grids, which are never achromatic.
fn in_grey_medium<E: Estimator>(
    scene: &Scene,
    s: &Settings,
    at: PathIndex,
    context: PathContext<'_>,
) -> PathEstimate {
    match only_medium(scene) {
        Some((AnyMedium::Homogeneous(m), placed)) => {
            path::<E, _, Grey, 1>((m, placed), scene, s, at, context)
        }
        Some((AnyMedium::DensityGrid(m), placed)) => {
            path::<E, _, Grey, 1>((m, placed), scene, s, at, context)
        }
        Some((AnyMedium::RgbGrids(_), _)) | None => match s.mode {
            Mode::Spectral => in_medium::<E, Wavelengths<4>, 4>(scene, s, at, context),
            Mode::Rgb => in_medium::<E, RgbChannels<3>, 3>(scene, s, at, context),
        },
    }
}

/// The medium of a scene that has only one, if no ray enters it more than once.
fn only_medium(scene: &Scene) -> Option<(&AnyMedium, &PlacedMedium)> {
    match &*scene.media {
        [only] if only.placed.is_convex() => Some((&only.placed.medium, &only.placed)),
        _ => None,
    }
}

/// Media that are evaluated at the components of a path.
trait Media<'s> {
    /// The media at `N` components.
    type Local<const N: usize>: LocalMedia<N>;
    /// The same media, with one majorant for all components.
    type LocalShared<const N: usize>: LocalMedia<N>;

    fn local<const N: usize, C: Components<N>>(self, components: &C) -> Self::Local<N>;
    fn local_shared<const N: usize, C: Components<N>>(self, components: &C) -> Self::LocalShared<N>;
}

impl<'s, M: Medium> Media<'s> for (&'s M, &'s PlacedMedium) {
    type Local<const N: usize> = One<'s, M::Local<'s, N>>;
    type LocalShared<const N: usize> = One<'s, SharedMajorant<M::Local<'s, N>>>;

    fn local<const N: usize, C: Components<N>>(self, components: &C) -> Self::Local<N> {
        One { medium: self.0.local(components), placed: self.1 }
    }

    fn local_shared<const N: usize, C: Components<N>>(self, components: &C) -> Self::LocalShared<N> {
        One { medium: SharedMajorant(self.0.local(components)), placed: self.1 }
    }
}

/// All media of a scene, of any kind.
struct Every<'s>(&'s Scene);

impl<'s> Media<'s> for Every<'s> {
    type Local<const N: usize> = Several<'s, N>;
    type LocalShared<const N: usize> = Several<'s, N>;

    fn local<const N: usize, C: Components<N>>(self, components: &C) -> Several<'s, N> {
        Several::new(self.0.media.iter().map(|medium| &medium.placed), components, false)
    }

    fn local_shared<const N: usize, C: Components<N>>(self, components: &C) -> Several<'s, N> {
        Several::new(self.0.media.iter().map(|medium| &medium.placed), components, true)
    }
}

fn path<'s, E: Estimator, M: Media<'s>, C: Components<N>, const N: usize>(
    media: M,
    scene: &Scene,
    settings: &Settings,
    at: PathIndex,
    context: PathContext<'_>,
) -> PathEstimate {
    let pixel = u64::from(at.y) * u64::from(scene.width) + u64::from(at.x);
    let mut trace = Trace::new(Sampler::of_kind(settings.sampler, settings.seed, pixel, at.sample), context);
    let (jitter, u) = trace.sampler.camera();
    let ray = scene.camera.ray(Vec2::new(at.x as f32, at.y as f32) + jitter);
    let wavelengths = (settings.mode == Mode::Spectral).then_some(settings.wavelengths);
    let components = C::sample(u, wavelengths);
    trace.notify(move || Note::Camera { ray, jitter, u, carried: components.carried() });
    let settings = settings.path;
    let radiance = if const { E::SHARED_MAJORANT } {
        let media = media.local_shared(&components);
        E::estimate(&World { scene, media, components, settings }, ray, &mut trace)
    } else {
        let media = media.local(&components);
        E::estimate(&World { scene, media, components, settings }, ray, &mut trace)
    };
    let rgb = components.to_film(radiance);
    trace.notify(move || Note::End { sum: radiance.lanes(), film: rgb });
    PathEstimate { rgb, lookups: trace.lookups, exceeded: trace.exceeded }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::find;
    use crate::io::{Library, scene_file};
    use crate::scene::build;
    use crate::transport::CancelToken;

    /// Six by four pixels whose right half sees a light.
    fn half_lit() -> (Scene, Settings) {
        let doc = scene_file::parse(
            "majorant = 1
            [film]
            width = 6
            height = 4
            [camera]
            origin = [0.0, 0.0, 5.0]
            [medium]
            extinction = 0.0
            [estimator]
            mode = \"rgb\"
            [[lights]]
            kind = \"rectangle\"
            center = [50.0, 0.0, -1.0]
            target = [50.0, 0.0, 1.0]
            size = [100.0, 100.0]",
            "half lit",
        );
        let doc = doc.unwrap();
        (build(&doc, &mut Library::default()).unwrap(), Settings::new(&doc.estimator, 0))
    }

    #[test]
    fn a_path_starts_within_its_pixel() {
        let (scene, settings) = half_lit();
        for (x, y, sample) in (0..6).flat_map(|x| (0..4).flat_map(move |y| (0..8).map(move |s| (x, y, s)))) {
            let at = PathIndex { x, y, sample };
            let kernel = find("spectral-mis").unwrap().kernel;
            let seen = kernel(&scene, &settings, at, CancelToken::NEVER.into()).rgb.element_sum();
            assert_eq!(seen > 0.0, x >= 3, "{at:?}");
        }
    }

    #[test]
    fn every_pixel_has_random_numbers_of_its_own() {
        let (scene, settings) = half_lit();
        let kernel = find("independent").unwrap().kernel;
        // The channels that 32 paths carry distinguish the streams.
        let channels = |x, y| -> Vec<Vec3> {
            (0..32)
                .map(|sample| {
                    kernel(&scene, &settings, PathIndex { x, y, sample }, CancelToken::NEVER.into()).rgb
                })
                .collect()
        };
        let pixels: Vec<_> = (3..6).flat_map(|x| (0..4).map(move |y| channels(x, y))).collect();
        for (i, a) in pixels.iter().enumerate() {
            assert!(pixels[..i].iter().all(|b| a != b), "pixel {i} repeats another");
        }
    }
}
