//! Transmittance estimators along a single ray: known quantities, look-ups and estimates.
//!
//! The running estimate at a distance t is the estimate of the ray clipped at t, with the same random
//! numbers. For estimators that step from collision to collision it is the product so far; for the others it
//! is the estimate of the shorter ray.

use crate::math::{Ray, Sampler};
use crate::medium::{LocalMedia, Several, Traversal};
use crate::scene::{Mode, Scene};
use crate::spectrum::{Components, RgbChannels, Sampled, Wavelengths};
use crate::transmittance::{Analytic, InMedium, Piece, Profile, Shape, TransmittanceKind};
use crate::transport::CancelToken;
use std::cell::RefCell;

/// Extinction profile along the ray.
#[derive(Clone, Copy, Debug)]
pub enum Along<'a> {
    /// Medium of a scene, at one wavelength (nm) or one channel of the film.
    Medium {
        /// The frozen scene.
        scene: &'a Scene,
        /// Ray in world space.
        ray: Ray,
        /// Spectral or RGB mode, in which the component is a wavelength or a channel.
        mode: Mode,
        /// Wavelength in nanometres, or channel 0, 1, 2.
        component: f32,
    },
    /// Analytic profile with a transmittance in closed form.
    Shape {
        /// Profile.
        shape: Shape,
        /// Maximum extinction, for a ray of length one.
        extinction: f32,
        /// Number of cells with separate majorants.
        cells: u32,
        /// Factor on the least upper bound of each cell.
        majorant_factor: f32,
    },
}

/// Parameters of the experiment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BenchPlan {
    /// Transmittance estimator.
    pub kind: TransmittanceKind,
    /// Number of estimates.
    pub estimates: u64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Index of the estimate that is shown step by step.
    pub example: u64,
}

/// Evaluation of the extinction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Distance along the ray, from the entry into the medium.
    pub t: f32,
    /// Extinction.
    pub extinction: f32,
}

/// Estimates of the transmittance along a ray.
#[derive(Clone, Debug, PartialEq)]
pub struct RayBench {
    /// Distance from the ray's origin to the entry into the medium.
    pub start: f32,
    /// Length of the ray inside the medium.
    pub length: f32,
    /// Extinction at equal steps: (t, μ).
    pub extinction: Vec<[f32; 2]>,
    /// Majorants: start, end, μ̄.
    pub majorants: Vec<[f32; 3]>,
    /// Transmittance from the entry: (t, T), by quadrature or in closed form.
    pub transmittance: Vec<[f32; 2]>,
    /// Evaluations by the example, in its own order.
    pub looks: Vec<Look>,
    /// Running estimate of the example: (t, T).
    pub running: Vec<[f32; 2]>,
    /// All estimates.
    pub estimates: Vec<f32>,
    /// Mean of the estimates, and its standard error.
    pub mean: [f64; 2],
    /// Mean number of look-ups per estimate.
    pub lookups: f64,
}

/// Number of steps of the curves.
const STEPS: u32 = 512;
/// Number of quadrature steps per step of a curve.
const FINE: u32 = 8;
/// Optical depth up to which a medium without a boundary is shown.
const UNBOUNDED_DEPTH: f32 = 6.0;
/// Number of points of the running estimate.
const CUTS: u32 = 192;

/// A profile clipped at `end` that records its evaluations.
struct Watched<'p, P> {
    profile: &'p P,
    end: f32,
    looks: RefCell<Vec<Look>>,
}

impl<P: Profile<1>> Profile<1> for Watched<'_, P> {
    type Pieces<'a>
        = Cut<P::Pieces<'a>>
    where
        Self: 'a;

    fn pieces(&self) -> Self::Pieces<'_> {
        Cut { pieces: self.profile.pieces(), end: self.end }
    }

    fn extinction(&self, t: f32, piece: &Piece<1>) -> Sampled<1> {
        let extinction = self.profile.extinction(t, piece);
        self.looks.borrow_mut().push(Look { t, extinction: extinction.hero() });
        extinction
    }
}

/// Iterator over pieces, clipped at `end`.
struct Cut<I> {
    pieces: I,
    end: f32,
}

impl<I: Iterator<Item = Piece<1>>> Iterator for Cut<I> {
    type Item = Piece<1>;

    fn next(&mut self) -> Option<Piece<1>> {
        let mut piece = self.pieces.next()?;
        if piece.segment.t0 >= self.end {
            return None;
        }
        piece.segment.t1 = piece.segment.t1.min(self.end);
        Some(piece)
    }
}

impl RayBench {
    /// Evaluates an estimator along a ray; `None` if the ray misses the medium, or after cancellation.
    #[must_use]
    pub fn new(along: &Along<'_>, plan: &BenchPlan, cancel: CancelToken<'_>) -> Option<Self> {
        match *along {
            Along::Shape { shape, extinction, cells, majorant_factor } => {
                let profile = Analytic { majorant_factor, ..Analytic::new(shape, [extinction], cells) };
                let exact = |t: f32| (-f64::from(extinction) * shape.integral(f64::from(t))).exp();
                Self::of(&profile, 1.0, plan, Some(&exact), cancel)
            }
            Along::Medium { scene, ray, mode: Mode::Spectral, component } => {
                let components = Wavelengths::<1> { lambda_nm: [component], density_per_nm: [1.0] };
                Self::in_medium(scene, &ray, &components, plan, cancel)
            }
            Along::Medium { scene, ray, mode: Mode::Rgb, component } => {
                let components = RgbChannels::<1> { channel: [(component as usize).min(2)] };
                Self::in_medium(scene, &ray, &components, plan, cancel)
            }
        }
    }

    fn in_medium<C: Components<1>>(
        scene: &Scene,
        ray: &Ray,
        components: &C,
        plan: &BenchPlan,
        cancel: CancelToken<'_>,
    ) -> Option<Self> {
        let media = Several::new(scene.media.iter().map(|medium| &medium.placed), components, false);
        // A medium without a boundary is shown up to the next surface, or over a few mean free paths.
        let surface = scene.nearest_surface(ray, f32::INFINITY, true).t();
        let (start, traversal) = media.traverse(ray, surface)?;
        let (start, traversal) = if traversal.t_end().is_finite() {
            (start, traversal)
        } else {
            media.traverse(ray, start + UNBOUNDED_DEPTH / traversal.extinction_prior(0.0).mean.hero())?
        };
        let length = traversal.t_end();
        let bench = Self::of(&InMedium::new(traversal), length, plan, None, cancel)?;
        Some(Self { start, ..bench })
    }

    fn of<P: Profile<1>>(
        profile: &P,
        length: f32,
        plan: &BenchPlan,
        exact: Option<&dyn Fn(f32) -> f64>,
        cancel: CancelToken<'_>,
    ) -> Option<Self> {
        let pieces: Vec<Piece<1>> = profile.pieces().collect();
        let extinction_at = |t: f32| {
            let piece = pieces.iter().find(|p| p.segment.t0 <= t && t <= p.segment.t1);
            piece.map_or(0.0, |piece| profile.extinction(t, piece).hero())
        };
        let at = |i: u32| length * i as f32 / STEPS as f32;
        let extinction: Vec<[f32; 2]> = (0..=STEPS).map(|i| [at(i), extinction_at(at(i))]).collect();
        let width = f64::from(length) / f64::from(STEPS * FINE);
        let mut depth = 0.0f64;
        let mut transmittance = vec![[0.0, 1.0]];
        for i in 0..STEPS {
            for k in 0..FINE {
                let t = at(i) + (f64::from(k) + 0.5) as f32 * width as f32;
                depth += f64::from(extinction_at(t)) * width;
            }
            let value = exact.map_or_else(|| (-depth).exp(), |exact| exact(at(i + 1)));
            transmittance.push([at(i + 1), value as f32]);
        }

        let watched = |end: f32| Watched { profile, end, looks: RefCell::default() };
        let numbers = |which: u64| Sampler::new(plan.seed, which, 0);
        let example = watched(f32::INFINITY);
        let _ = plan.kind.estimate(&example, &mut numbers(plan.example));
        let running = (0..=CUTS).map(|i| {
            let end = length * i as f32 / CUTS as f32;
            let estimate = plan.kind.estimate(&watched(end), &mut numbers(plan.example));
            [end, estimate.weight.hero()]
        });
        let running = running.collect();

        let (mut estimates, mut lookups) = (Vec::with_capacity(plan.estimates as usize), 0u64);
        for which in 0..plan.estimates {
            let estimate = plan.kind.estimate(profile, &mut numbers(which));
            estimates.push(estimate.weight.hero());
            lookups += u64::from(estimate.lookups);
            if !cancel.is_active() {
                return None;
            }
        }
        let n = (estimates.len() as f64).max(1.0);
        let mean = estimates.iter().map(|e| f64::from(*e)).sum::<f64>() / n;
        let variance =
            estimates.iter().map(|e| (f64::from(*e) - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
        Some(Self {
            start: 0.0,
            length,
            extinction,
            majorants: pieces
                .iter()
                .map(|p| [p.segment.t0, p.segment.t1, p.segment.majorant.hero()])
                .collect(),
            transmittance,
            looks: example.looks.into_inner(),
            running,
            estimates,
            mean: [mean, (variance / n).sqrt()],
            lookups: lookups as f64 / n,
        })
    }

    /// Transmittance of the whole ray.
    #[must_use]
    pub fn truth(&self) -> f64 {
        self.transmittance.last().map_or(1.0, |[_, value]| f64::from(*value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::{Library, embedded, scene_file};
    use crate::scene::build;
    use glam::Vec2;

    fn plan(kind: TransmittanceKind) -> BenchPlan {
        BenchPlan { kind, estimates: 20_000, seed: 5, example: 3 }
    }

    #[test]
    fn every_unbiased_estimator_finds_the_truth_in_shapes_and_scenes() {
        let text = embedded::find("plume-spectral").unwrap().toml;
        let doc = scene_file::parse(text, "plume").unwrap();
        let scene = build(&doc, &mut Library::default()).unwrap();
        let pixel = Vec2::new(scene.width as f32, scene.height as f32) * 0.5;
        let medium = Along::Medium {
            scene: &scene,
            ray: scene.camera.ray(pixel),
            mode: Mode::Spectral,
            component: 500.0,
        };
        let shapes =
            Shape::ALL.map(|shape| Along::Shape { shape, extinction: 2.0, cells: 4, majorant_factor: 1.0 });
        for along in shapes.iter().chain([&medium]) {
            for kind in TransmittanceKind::all().into_iter().filter(|kind| kind.entry().unbiased) {
                let bench = RayBench::new(along, &plan(kind), CancelToken::NEVER).unwrap();
                let [mean, error] = bench.mean;
                let off = (mean - bench.truth()).abs();
                assert!(off < 4.5 * error + 2e-4, "{along:?} {}: {mean} {}", kind.entry().id, bench.truth());
                // The running estimate belongs to one of the estimates, and ends at its value.
                let (last, whole) = (bench.running.last().unwrap()[1], bench.estimates[3]);
                assert!(
                    (last - whole).abs() < 1e-4 * (1.0 + whole.abs()),
                    "{}: {last} {whole}",
                    kind.entry().id
                );
                assert!((bench.transmittance[0][1], bench.running[0][1]) == (1.0, 1.0));
            }
        }
    }

    #[test]
    fn an_estimator_by_collisions_goes_down_in_steps_where_it_has_looked() {
        let along = Along::Shape { shape: Shape::Cosine, extinction: 6.0, cells: 1, majorant_factor: 1.5 };
        let ratio = TransmittanceKind::find("ratio").unwrap();
        let bench = RayBench::new(&along, &plan(ratio), CancelToken::NEVER).unwrap();
        let mut expected = 1.0;
        for look in &bench.looks {
            expected *= 1.0 - look.extinction / 9.0;
            let after = bench.running.iter().find(|[t, _]| *t > look.t).unwrap()[1];
            let next = bench.looks.iter().find(|other| other.t > look.t).map_or(1.0, |other| other.t);
            // Unless the next evaluation is too close to resolve the step between them.
            if next - look.t > 2.0 / CUTS as f32 {
                assert!((after - expected).abs() < 1e-5, "{after} {expected}");
            }
        }
        assert!(bench.looks.len() > 2 && (bench.lookups - 9.0).abs() < 0.2, "{}", bench.lookups);
        let miss = Ray { origin: glam::Vec3::splat(99.0), direction: glam::Vec3::X };
        let scene = build(&crate::scene::SceneDoc::default(), &mut Library::default()).unwrap();
        let along = Along::Medium { scene: &scene, ray: miss, mode: Mode::Rgb, component: 0.0 };
        assert!(RayBench::new(&along, &plan(ratio), CancelToken::NEVER).is_none());
    }
}
