//! Execution of a benchmark plan.

use super::{Candidate, Plan, ReferencePlan, Row, Subject, Trial};
use crate::compare::{Reference, unfit_document};
use crate::estimator::{self, Entry};
use crate::film::Images;
use crate::math::SamplerKind;
use crate::measure::{self, MeasureError, Picture, Region};
use crate::scene::{EstimatorDoc, Scene, SceneDoc, SceneError, build};
use crate::session::{Batch, Budget, Probe, render};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::Arc;

/// Reason why a benchmark failed.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// A scene could not be built.
    #[error("{scene}: {source}")]
    Scene {
        /// Name of the scene.
        scene: String,
        /// Cause.
        source: SceneError,
    },
    /// Every candidate is biased, so that its error does not fall with time.
    #[error("{scene}: {reason}; its error does not fall with time. Disable this setting to measure speed.")]
    Biased {
        /// Name of the scene.
        scene: String,
        /// Source of the bias.
        reason: &'static str,
    },
    /// The reference shares random numbers with a trial; the correlation would look like accuracy.
    #[error(
        "{scene}: the reference was rendered with seed {seed}, which a trial uses as well: set render.seed to {free} or more"
    )]
    SameSeed {
        /// Name of the scene.
        scene: String,
        /// Seed of the reference.
        seed: u64,
        /// Smallest scene seed for which no trial uses the seed of the reference.
        free: u64,
    },
    /// The reference is biased, or its noise is not known.
    #[error("{scene}: the reference cannot be used: {reason}")]
    UnfitReference {
        /// Name of the scene.
        scene: String,
        /// Reason why it is unsuitable.
        reason: &'static str,
    },
    /// The reference has a different size.
    #[error("{scene}: {source}")]
    Reference {
        /// Name of the scene.
        scene: String,
        /// Mismatch.
        source: MeasureError,
    },
    /// Fewer than two runs have no scatter.
    #[error("{0} repeats have no scatter: run at least 2")]
    TooFew(u32),
    /// The operating system refused threads.
    #[error("{threads} worker threads could not be started: {reason}. Ask for fewer with --threads.")]
    Threads {
        /// Number of threads.
        threads: usize,
        /// Error of the operating system.
        reason: String,
    },
}

/// Progress of a benchmark.
#[derive(Clone, Debug)]
pub struct Progress<'a> {
    /// Completed runs, references included.
    pub done: usize,
    /// Total number of runs.
    pub of: usize,
    /// Description of the next run.
    pub next: String,
    /// Rows of the scene that has just been completed.
    pub rows: &'a [Row],
}

/// Runs the candidates of every scene. Returns the rows scene by scene.
///
/// # Errors
/// When a scene cannot be built, when every candidate is biased, or when a reference does not fit.
pub fn run(plan: &Plan, mut progress: impl FnMut(&Progress)) -> Result<Vec<Row>, BenchError> {
    if plan.repeats < 2 {
        return Err(BenchError::TooFew(plan.repeats));
    }
    let threads = plan
        .threads
        .unwrap_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get));
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| BenchError::Threads { threads, reason: e.to_string() })?;
    let of = plan.subjects.iter().map(|s| 1 + plan.repeats as usize * s.candidates.len()).sum();
    let mut rows = Vec::new();
    let mut done = 0;
    for subject in &plan.subjects {
        // A candidate that is biased on a scene has no efficiency there: its error does not fall with time.
        let unbiased = subject.candidates.iter().filter(|candidate| candidate.bias(&subject.doc).is_none());
        let candidates: Vec<&Candidate> = unbiased.collect();
        let runner = Runner::new(subject, &candidates, &pool)?;
        let mut report = |next: String, rows: &[Row]| {
            progress(&Progress { done, of, next, rows });
            done += 1;
        };
        report(format!("{}  reference", subject.name), &[]);
        let reference = runner.reference(plan.repeats)?;
        let mut trials = vec![Vec::new(); candidates.len()];
        for repeat in 0..plan.repeats {
            for (candidate, trials) in candidates.iter().zip(&mut trials) {
                report(format!("{}  {} {}/{}", subject.name, candidate.name, repeat + 1, plan.repeats), &[]);
                trials.push(runner.trial(candidate, u64::from(repeat), plan.budget, &reference)?);
            }
        }
        let first = rows.len();
        rows.extend(candidates.iter().zip(&trials).map(|(candidate, own)| {
            let about = (threads, reference.origin.clone());
            Row::new(subject.name.clone(), candidate.name.clone(), own, &trials[0], about)
        }));
        progress(&Progress { done, of, next: String::new(), rows: &rows[first..] });
    }
    Ok(rows)
}

struct Runner<'a> {
    subject: &'a Subject,
    scene: Arc<Scene>,
    pool: &'a ThreadPool,
}

impl<'a> Runner<'a> {
    fn new(subject: &'a Subject, unbiased: &[&Candidate], pool: &'a ThreadPool) -> Result<Self, BenchError> {
        let scene = subject.name.clone();
        let biased = subject.candidates.first().and_then(|candidate| candidate.bias(&subject.doc));
        match biased.filter(|_| unbiased.is_empty()) {
            Some(reason) => Err(BenchError::Biased { scene, reason }),
            None => Ok(Self { subject, scene: Self::frozen(subject, &subject.doc, pool)?, pool }),
        }
    }

    fn frozen(subject: &Subject, doc: &SceneDoc, pool: &ThreadPool) -> Result<Arc<Scene>, BenchError> {
        let mut library = subject.library.clone();
        let frozen = pool.install(|| build(doc, &mut library));
        frozen.map(Arc::new).map_err(|source| BenchError::Scene { scene: subject.name.clone(), source })
    }

    /// One run with the given seed.
    fn batch(&self, entry: &Entry, settings: &EstimatorDoc, seed: u64, budget: Budget) -> Batch {
        let settings = estimator::Settings::new(settings, seed);
        let probe = Probe::new(Arc::clone(&self.scene), entry.kernel, settings);
        render(&probe, self.pool, budget)
    }

    /// Checks an existing reference: it must be unbiased and have a seed that no trial uses.
    fn given(&self, reference: &Reference, repeats: u32) -> Result<Reference, BenchError> {
        let (scene, first) = (self.subject.name.clone(), self.subject.doc.render.seed);
        if let Some(reason) = reference.unfit {
            return Err(BenchError::UnfitReference { scene, reason });
        }
        match reference.seed {
            Some(seed) if seed.wrapping_sub(first) < u64::from(repeats) => {
                Err(BenchError::SameSeed { scene, seed, free: seed.wrapping_add(1) })
            }
            _ => Ok(reference.clone()),
        }
    }

    fn reference(&self, repeats: u32) -> Result<Reference, BenchError> {
        match &self.subject.reference {
            ReferencePlan::Given(reference) => self.given(reference, repeats),
            ReferencePlan::Own { estimator, seconds } => {
                let seed = self.subject.doc.render.seed.wrapping_sub(1);
                let doc = reference_doc(&self.subject.doc, estimator);
                if let Some(reason) = unfit_document(&doc) {
                    return Err(BenchError::UnfitReference { scene: self.subject.name.clone(), reason });
                }
                let batch = if doc.scene_part() == self.subject.doc.scene_part() {
                    self.batch(estimator, &doc.estimator, seed, Budget::Seconds(*seconds))
                } else {
                    let scene = Self::frozen(self.subject, &doc, self.pool)?;
                    let runner = Runner { subject: self.subject, scene, pool: self.pool };
                    runner.batch(estimator, &doc.estimator, seed, Budget::Seconds(*seconds))
                };
                let images = self.pool.install(|| Images::of(&batch.film));
                let origin = format!("own run of {}, {} samples per pixel", estimator.name, batch.spp);
                let Batch { film, .. } = batch;
                Ok(Reference::own((film.width, film.height), images.mean, images.standard_error, origin))
            }
        }
    }

    fn trial(
        &self,
        candidate: &Candidate,
        repeat: u64,
        budget: Budget,
        reference: &Reference,
    ) -> Result<Trial, BenchError> {
        let seed = self.subject.doc.render.seed.wrapping_add(repeat);
        let batch = self.batch(candidate.entry, &candidate.settings, seed, budget);
        let images = self.pool.install(|| Images::of(&batch.film));
        let (width, height) = (batch.film.width, batch.film.height);
        let picture = Picture { width, height, pixels: &images.mean };
        let measured = relmse(&picture, reference)
            .map_err(|source| BenchError::Reference { scene: self.subject.name.clone(), source })?;
        Ok(Trial {
            spp: batch.spp,
            wall_seconds: batch.wall_seconds,
            cpu_seconds: batch.cpu_seconds,
            paths: batch.tally.paths,
            lookups: batch.tally.lookups,
            non_finite: batch.tally.non_finite,
            relmse: measured,
        })
    }
}

/// Document that a separate reference run renders: without biased settings, and with independent samples so
/// that the standard error is exact.
fn reference_doc(doc: &SceneDoc, estimator: &Entry) -> SceneDoc {
    let mut doc = doc.unbiased();
    estimator.id.clone_into(&mut doc.estimator.id);
    doc.estimator.sampler = SamplerKind::Independent;
    doc
}

/// relMSE without the contribution of the reference noise.
fn relmse(picture: &Picture, reference: &Reference) -> Result<f64, MeasureError> {
    let against = measure::ReferencePicture {
        picture: Picture { width: reference.width, height: reference.height, pixels: reference.mean() },
        standard_error: reference.standard_error(),
    };
    let whole = Region::whole(picture.width, picture.height);
    let measure = measure::find("relmse").map(|m| m.measure);
    measure.map_or(Ok(f64::NAN), |measure| {
        measure(picture, &against, whole).map(|m| m.value - m.reference_share)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::{Library, scene_file};
    use crate::scene::{Bookkeeping, Fault, WhenExceeded};

    fn subject(reference: ReferencePlan) -> Subject {
        let text = "majorant = 1\nfilm = { width = 4, height = 3 }\nrender = { seed = 5 }\nestimator = { id = \"nee\" }";
        let doc = scene_file::parse(text, "bench").unwrap();
        let candidates = vec![Candidate::of(estimator::find("nee").unwrap(), &doc)];
        Subject { name: "bench".into(), doc, library: Library::default(), candidates, reference }
    }

    fn refused(seed: Option<u64>, unfit: Option<&'static str>) -> Option<String> {
        let pixels = vec![[1.0; 3]; 12];
        let mut reference = Reference::own((4, 3), pixels.clone(), pixels, "theirs".into());
        (reference.seed, reference.unfit) = (seed, unfit);
        let subjects = vec![subject(ReferencePlan::Given(Box::new(reference)))];
        let plan = Plan { subjects, budget: Budget::Samples(2), repeats: 3, threads: Some(1) };
        run(&plan, |_| {}).err().map(|e| e.to_string())
    }

    #[test]
    fn a_reference_with_random_numbers_of_a_trial_is_refused() {
        for seed in [5, 6, 7] {
            let message = refused(Some(seed), None).unwrap();
            assert!(message.contains(&format!("render.seed to {}", seed + 1)), "{message}");
        }
        for seed in [None, Some(4), Some(8)] {
            assert_eq!(refused(seed, None), None);
        }
        assert!(refused(None, Some("it is wrong")).unwrap().contains("it is wrong"));
    }

    #[test]
    fn nothing_biases_a_reference_of_its_own() {
        let entry = estimator::find("uni-nee-mis").unwrap();
        let mut doc = SceneDoc::default();
        let plain = reference_doc(&doc, entry);
        doc.estimator.fault = Fault::PhaseInBoth;
        doc.estimator.bookkeeping = Bookkeeping::ApartF32;
        doc.estimator.transmittance = "marching".into();
        doc.medium_mut().majorant.when_exceeded = WhenExceeded::Clamp;
        doc.medium_mut().majorant.factor = 0.5;
        assert_eq!(reference_doc(&doc, entry), plain);
        assert_eq!(unfit_document(&plain), None);
    }
}
