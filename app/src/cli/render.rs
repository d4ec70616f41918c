//! `majorant render`: renders a scene without a window, by the same session.

use super::progress::Progress;
use super::{Failure, options, print_line, source};
use majorant_core::film::Snapshot;
use majorant_core::io::{export, scene_file};
use majorant_core::scene::{Limits, SceneDoc};
use majorant_core::session::{Ending, Job, Role, Session, Status, ViewId, ViewState};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

#[derive(clap::Args, Debug)]
#[command(after_help = "\
The limits --spp and --seconds replace all limits of the scene: render.spp, seconds, cpu_seconds and relative_error.
Limits that no longer apply are named on standard error.
--set sets any key of the scene file: --set estimator.mode=rgb, --set lights.0.scale=3,
--set 'medium.extinction=\"430:8, 540:40\"'.

--json ends with one line: estimator, mode, width, height, spp, seconds, cpu_seconds, paths, lookups,
mean [r,g,b], non_finite, threads, seed, density_grid (the name of the grid that was read), notices [choices and
repairs made when files were read], ended_by: spp, seconds, cpu_seconds, relative_error, or black or not_finite if the
image has no relative error for that reason and there is no other limit.")]
pub(super) struct Arguments {
    /// A scene file, or the name of an embedded scene.
    scene: String,
    /// Output file: .exr (linear, with standard errors) or .png (tone-mapped). Repeatable.
    #[arg(short, long, value_name = "FILE", required_unless_present = "json")]
    output: Vec<PathBuf>,
    /// Id of the estimator, as listed by `majorant estimators`.
    #[arg(long, value_name = "ID")]
    estimator: Option<String>,
    /// Samples per pixel.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    spp: Option<u64>,
    /// Stop after this many seconds, at the end of a pass; every pixel receives at least one sample.
    #[arg(long, value_name = "S")]
    seconds: Option<f32>,
    /// Image size in pixels.
    #[arg(long, value_name = "WxH", value_parser = options::parse_size)]
    size: Option<[u32; 2]>,
    /// Seed of the random numbers.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Number of worker threads; one per core by default.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Maximum number of path segments: 1 is emission only, 2 is single scattering.
    #[arg(long, value_name = "N")]
    max_depth: Option<u32>,
    /// Set any key of the scene, as listed by `majorant keys`. Repeatable.
    #[arg(long, value_name = "KEY=VALUE", num_args = 1..)]
    set: Vec<String>,
    /// Print a summary as one line of JSON.
    #[arg(long)]
    json: bool,
}

impl Arguments {
    /// Overrides by all options, as assignments of scene keys.
    fn assignments(&self) -> Vec<String> {
        options::assignments(
            &self.set,
            &[
                ("estimator.id", self.estimator.as_ref().map(|id| format!("{id:?}"))),
                ("estimator.max_depth", self.max_depth.map(|n| n.to_string())),
                ("film.width", self.size.map(|s| s[0].to_string())),
                ("film.height", self.size.map(|s| s[1].to_string())),
                ("render.seed", self.seed.map(|n| n.to_string())),
                ("render.threads", self.threads.map(|n| n.to_string())),
            ],
        )
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    for path in &arguments.output {
        writer(path)?;
    }
    let source = source::load(&arguments.scene)?;
    let mut doc = scene_file::override_keys(&source.doc, &arguments.assignments())?;
    if arguments.spp.is_some() || arguments.seconds.is_some() {
        let given = Limits { spp: arguments.spp, seconds: arguments.seconds, ..Limits::default() };
        options::replace_limits(&mut doc.render, given);
    }
    if doc.render.limits().are_none() {
        return Err(Failure::Message("the render has no limit: specify --spp or --seconds".into()));
    }
    if let Some(problem) = majorant_core::estimator::validate(&doc).first() {
        return Err(Failure::Message(problem.to_string()));
    }

    let doc = Arc::new(doc);
    let (snapshot, state) = render(Arc::clone(&doc), source.resources)?;
    let ending = state.ending;
    for path in &arguments.output {
        writer(path)?(path, &snapshot, &doc)?;
    }
    if arguments.json {
        print_line(&summary(&snapshot, &doc, &state).to_string())?;
    }
    ending.and_then(Ending::warning).map_or(Ok(()), |warning| Err(Failure::NoError(warning)))
}

type Writer = fn(&Path, &Snapshot, &SceneDoc) -> Result<(), export::ExportError>;

/// Writer of a file, by its extension; checked before rendering.
fn writer(path: &Path) -> Result<Writer, Failure> {
    match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("exr") => Ok(export::write_exr),
        Some("png") => Ok(|path, snapshot, doc| export::write_png(path, snapshot, &doc.view)),
        _ => Err(Failure::Message(format!("{}: unknown extension; use .exr or .png", path.display()))),
    }
}

/// Interval between progress updates while a file is read.
const READING: Duration = Duration::from_millis(50);

/// Renders the scene; returns the finished image and the final state of its view.
fn render(
    doc: Arc<SceneDoc>,
    library: majorant_core::io::Library,
) -> Result<(Arc<Snapshot>, ViewState), Failure> {
    let progress = Progress::new(doc.render.spp, doc.render.seconds);
    // One pending wake-up suffices, because the state is read after each.
    let (wake, woken) = mpsc::sync_channel::<()>(1);
    let session = Session::new(library, move || {
        let _ = wake.try_send(());
    })?;
    let view = ViewId(0);
    session.submit(view, Job { doc, preview: false, role: Role::View });
    loop {
        let state = session.state(view);
        if let Some(snapshot) = &state.snapshot {
            progress.show(snapshot);
        }
        if let Some(loading) = &state.loading {
            progress.read(loading);
        }
        match (state.status.clone(), state.snapshot.clone()) {
            (Status::Failed(message), _) => return Err(Failure::Message(message)),
            (Status::Finished, Some(snapshot)) => {
                progress.finish();
                options::print_notes(&state.notices);
                return Ok((snapshot, state));
            }
            // The session does not wake the caller while it reads a file.
            (Status::Building, _) => match woken.recv_timeout(READING) {
                Ok(()) | Err(RecvTimeoutError::Timeout) => {}
                Err(error @ RecvTimeoutError::Disconnected) => {
                    return Err(Failure::Message(error.to_string()));
                }
            },
            _ => woken.recv()?,
        }
    }
}

/// Names of the density grids of all media, as far as their files name them.
fn density_grids(state: &ViewState) -> impl Iterator<Item = &str> {
    let media = state.scene.iter().flat_map(|scene| scene.media.iter().flatten());
    media.map(|medium| medium.density_grid.as_str()).filter(|name| !name.is_empty())
}

fn summary(snapshot: &Snapshot, doc: &SceneDoc, state: &ViewState) -> serde_json::Value {
    serde_json::json!({
        "estimator": doc.estimator.id,
        "mode": doc.estimator.mode,
        "width": snapshot.width,
        "height": snapshot.height,
        "spp": snapshot.spp,
        "seconds": snapshot.seconds,
        "cpu_seconds": snapshot.cpu_seconds,
        "paths": snapshot.tally.paths,
        "lookups": snapshot.tally.lookups,
        "mean": snapshot.mean_colour(),
        "non_finite": snapshot.tally.non_finite,
        "threads": snapshot.threads,
        "seed": doc.render.seed,
        "density_grid": density_grids(state).next(),
        "density_grids": density_grids(state).collect::<Vec<_>>(),
        "notices": state.notices,
        "ended_by": state.ending.map(Ending::id),
    })
}
