//! The thread that owns the films and decides which view gets the next pass.

use super::mailbox::{Command, Mailbox};
use super::pass::Work;
use super::{Job, Status, ViewId, preview};
use crate::estimator::{self, Kernel, Settings};
use crate::film::{Film, Snapshot, Tally};
use crate::io::Library;
use crate::scene::{Scene, SceneDoc, build};
use crate::transport::Wanted;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::time::Instant;

/// A pass lasts about this long, so that pausing and stepping answer soon.
const PASS_SECONDS: f64 = 0.15;
/// The first coarse picture has about this many paths, one per block of pixels.
const COARSE_PATHS: usize = 8192;
/// A finer preview is worth it only if a whole pass would take longer than this.
const FINE_PREVIEW_SECONDS: f64 = 0.2;

/// A view that renders.
struct Active {
    generation: u64,
    current: Arc<AtomicU64>,
    scene: Arc<Scene>,
    kernel: Kernel,
    settings: Settings,
    pool: Arc<ThreadPool>,
    film: Film,
    spp: u32,
    limits: (Option<u32>, Option<f32>),
    paused: bool,
    steps: u32,
    last_pass: u32,
    seconds: f64,
    cpu_seconds: f64,
    tally: Tally,
}

impl Active {
    fn finished(&self) -> bool {
        self.limits.0.is_some_and(|spp| self.spp >= spp)
            || self.limits.1.is_some_and(|seconds| self.seconds >= f64::from(seconds))
    }

    fn runnable(&self) -> bool {
        !self.finished() && (!self.paused || self.steps > 0)
    }

    fn status(&self) -> Status {
        if self.finished() {
            Status::Finished
        } else if self.paused && self.steps == 0 {
            Status::Paused
        } else {
            Status::Rendering
        }
    }

    fn work(&self) -> Work<'_> {
        Work {
            scene: &self.scene,
            kernel: self.kernel,
            settings: &self.settings,
            wanted: Wanted::new(&self.current, self.generation),
        }
    }

    /// Samples of the next pass: as many as fit its time, at most twice the last, never past a limit.
    fn next_samples(&self) -> u32 {
        if self.paused || self.spp == 0 {
            return 1;
        }
        let per_sample = self.seconds / f64::from(self.spp);
        let left = self.limits.1.map_or(f64::INFINITY, |s| f64::from(s) - self.seconds);
        let fitting = (PASS_SECONDS.min(left) / per_sample).clamp(1.0, 4096.0) as u32;
        let count = fitting.min(self.last_pass * 2).max(1);
        self.limits.0.map_or(count, |spp| count.min(spp - self.spp))
    }

    fn snapshot(&self) -> Snapshot {
        let (mean, standard_error) = self.pool.install(|| Snapshot::images(&self.film));
        self.with_images(mean, standard_error, None)
    }

    fn with_images(
        &self,
        mean: Vec<[f32; 3]>,
        standard_error: Vec<[f32; 3]>,
        coarse: Option<u32>,
    ) -> Snapshot {
        Snapshot {
            generation: self.generation,
            width: self.film.width,
            height: self.film.height,
            mean,
            standard_error,
            spp: self.spp,
            coarse,
            seconds: self.seconds,
            cpu_seconds: self.cpu_seconds,
            tally: self.tally.clone(),
            threads: self.pool.current_num_threads(),
        }
    }
}

/// What the coordinator keeps between jobs.
struct Keeper {
    library: Library,
    pools: BTreeMap<usize, Arc<ThreadPool>>,
    /// The newest frozen scene with the document that it came from.
    frozen: Option<(SceneDoc, Arc<Scene>)>,
}

impl Keeper {
    /// Freezes a document, or finds it frozen already.
    fn scene(&mut self, doc: &SceneDoc) -> Result<Arc<Scene>, String> {
        let key = doc.scene_part();
        if let Some((known, scene)) = &self.frozen
            && *known == key
        {
            return Ok(Arc::clone(scene));
        }
        let scene = Arc::new(build(doc, &mut self.library).map_err(|e| e.to_string())?);
        self.frozen = Some((key, Arc::clone(&scene)));
        Ok(scene)
    }

    fn pool(&mut self, threads: Option<usize>) -> Result<Arc<ThreadPool>, String> {
        let threads =
            threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get));
        if let Some(pool) = self.pools.get(&threads) {
            return Ok(Arc::clone(pool));
        }
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|i| format!("majorant-worker-{i}"))
            .build()
            .map_err(|e| format!("{threads} worker threads could not be started: {e}"))?;
        let pool = Arc::new(pool);
        self.pools.insert(threads, Arc::clone(&pool));
        Ok(pool)
    }

    fn activate(&mut self, generation: u64, job: &Job, current: Arc<AtomicU64>) -> Result<Active, String> {
        let doc = &job.doc;
        let scene = self.scene(doc)?;
        let entry = estimator::find(&doc.estimator.id)
            .ok_or_else(|| format!("`{}` is not an estimator", doc.estimator.id))?;
        Ok(Active {
            generation,
            current,
            kernel: entry.kernel,
            settings: Settings::new(&doc.estimator, doc.render.seed),
            pool: self.pool(doc.render.threads)?,
            film: Film::new(scene.width as usize, scene.height as usize),
            scene,
            spp: 0,
            limits: (doc.render.spp, doc.render.seconds),
            paused: false,
            steps: 0,
            last_pass: 1,
            seconds: 0.0,
            cpu_seconds: 0.0,
            tally: Tally::default(),
        })
    }
}

pub(super) fn run(mailbox: &Mailbox, library: Library) {
    let mut keeper = Keeper { library, pools: BTreeMap::new(), frozen: None };
    let mut views: BTreeMap<ViewId, Active> = BTreeMap::new();
    loop {
        let idle = !views.values().any(Active::runnable);
        let Some(commands) = mailbox.take(idle) else { return };
        for command in commands {
            obey(command, mailbox, &mut keeper, &mut views);
        }
        // The view that has had the least time goes next.
        let next = views
            .iter_mut()
            .filter(|(_, v)| v.runnable())
            .min_by(|(_, a), (_, b)| a.cpu_seconds.total_cmp(&b.cpu_seconds));
        let Some((id, view)) = next else { continue };
        let id = *id;
        // A panicking worker must not take the session with it.
        match catch_unwind(AssertUnwindSafe(|| advance(view))) {
            Ok(true) => mailbox.publish_snapshot(id, view.snapshot(), view.status()),
            Ok(false) => {
                views.remove(&id);
            }
            Err(panic) => fail(mailbox, &mut views, id, &panic_message(&*panic)),
        }
    }
}

fn fail(mailbox: &Mailbox, views: &mut BTreeMap<ViewId, Active>, id: ViewId, message: &str) {
    if let Some(view) = views.remove(&id) {
        let text =
            format!("The renderer stopped on an internal error: {message}. Edit the scene to start again.");
        mailbox.publish_status(id, view.generation, Status::Failed(text));
    }
}

fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    panic
        .downcast_ref::<&str>()
        .map(|s| (*s).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".into())
}

fn obey(command: Command, mailbox: &Mailbox, keeper: &mut Keeper, views: &mut BTreeMap<ViewId, Active>) {
    match command {
        Command::Start { view: id, generation, job } => start(id, generation, &job, mailbox, keeper, views),
        Command::Remove { view } => {
            views.remove(&view);
        }
        Command::Limits { view: id, spp, seconds } => {
            change(id, mailbox, views, |v| v.limits = (spp, seconds))
        }
        Command::Pause { view: id, paused } => change(id, mailbox, views, |v| {
            v.paused = paused;
            v.steps = 0;
        }),
        Command::Step { view: id } => change(id, mailbox, views, |v| v.steps += 1),
    }
}

fn change(id: ViewId, mailbox: &Mailbox, views: &mut BTreeMap<ViewId, Active>, f: impl FnOnce(&mut Active)) {
    if let Some(view) = views.get_mut(&id) {
        f(view);
        mailbox.publish_status(id, view.generation, view.status());
    }
}

fn start(
    id: ViewId,
    generation: u64,
    job: &Job,
    mailbox: &Mailbox,
    keeper: &mut Keeper,
    views: &mut BTreeMap<ViewId, Active>,
) {
    let paused = views.remove(&id).is_some_and(|old| old.paused);
    let current = mailbox.current(id);
    let built = catch_unwind(AssertUnwindSafe(|| keeper.activate(generation, job, current)))
        .unwrap_or_else(|panic| Err(format!("internal error: {}", panic_message(&*panic))));
    let mut view = match built {
        Ok(view) => view,
        Err(message) => {
            mailbox.publish_status(id, generation, Status::Failed(message));
            return;
        }
    };
    view.paused = paused;
    mailbox.publish_built(id, generation, &view.scene, view.status());
    if job.preview {
        let shown = catch_unwind(AssertUnwindSafe(|| show_preview(id, &view, mailbox)));
        if let Err(panic) = shown {
            let message = format!("internal error: {}", panic_message(&*panic));
            mailbox.publish_status(id, generation, Status::Failed(message));
            return;
        }
    }
    views.insert(id, view);
}

/// Publishes a coarse picture at once, and a finer one if the first whole pass is still far off.
fn show_preview(id: ViewId, view: &Active, mailbox: &Mailbox) {
    let blocks = view.film.pixels.len().div_ceil(COARSE_PATHS);
    let mut stride = blocks.isqrt().max(4).next_power_of_two();
    loop {
        let began = Instant::now();
        let image = view.pool.install(|| preview::render(&view.work(), stride));
        let Some(image) = image else { return };
        let unknown = vec![[f32::INFINITY; 3]; image.len()];
        let snapshot = view.with_images(image, unknown, Some(stride as u32));
        mailbox.publish_snapshot(id, snapshot, view.status());
        let whole_pass = began.elapsed().as_secs_f64() * (stride * stride) as f64;
        if stride <= 2 || whole_pass < FINE_PREVIEW_SECONDS {
            return;
        }
        stride /= 2;
    }
}

/// Runs one pass; false if it was cancelled.
fn advance(view: &mut Active) -> bool {
    let count = view.next_samples();
    let began = Instant::now();
    let first = u64::from(view.spp);
    let samples = first..first + u64::from(count);
    // The film is lent to the pass; a cancelled one is not worth having back.
    let mut film = std::mem::replace(&mut view.film, Film::new(0, 0));
    let cost = view.pool.install(|| view.work().add_samples(&mut film, &samples));
    view.film = film;
    let Some(cost) = cost else { return false };
    view.spp += count;
    view.last_pass = count;
    view.steps = view.steps.saturating_sub(1);
    view.seconds += began.elapsed().as_secs_f64();
    view.cpu_seconds += cost.cpu_seconds;
    view.tally.merge(&cost.tally);
    true
}
