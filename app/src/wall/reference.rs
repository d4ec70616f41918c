//! Reference of the comparison: rendered in the background, read from a file, or the image of a view.

use super::slot::Slot;
use majorant_core::compare::{LEAST_SAMPLES, Reference, label, reference_doc};
use majorant_core::estimator;
use majorant_core::film::Snapshot;
use majorant_core::scene::{ReferenceDoc, SceneDoc};
use majorant_core::session::{Ending, Role, Session, Status, ViewId};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Session id of the rendered reference.
const BACKGROUND: ViewId = ViewId(u32::MAX);

/// Identity of the reference: numbers from another reference are not shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ReferenceId {
    /// No reference.
    #[default]
    None,
    /// Mean of the other unbiased views.
    Pooled,
    /// Image of a view or a background render, by submission.
    Submission(u64),
    /// File, by serial number of its reading.
    File(u64),
    /// The chosen reference has no image yet.
    Awaited,
}

/// State of the reference: background render, file, and the newest image.
#[derive(Default)]
pub struct ReferenceRenders {
    rendered: Option<Slot>,
    file: Option<FileReference>,
    /// Snapshot from which the newest image was made.
    made_from: Option<Arc<Snapshot>>,
    picture: Option<Arc<Reference>>,
    /// Serial number of the last reading of a file.
    files: u64,
}

struct FileReference {
    path: PathBuf,
    /// Serial number of its reading.
    serial: u64,
    read: Option<Result<Arc<Reference>, String>>,
    /// Whether it has no metadata about its scene, so that it is assumed to show this one.
    trusted: bool,
}

/// Status of the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceState {
    /// Short description.
    pub text: String,
    /// Problem with the reference.
    pub problem: Option<String>,
    /// Progress of the render, from 0 to 1, while it is rendered.
    pub progress: Option<f32>,
}

impl ReferenceRenders {
    /// Updates the reference for a document. Returns a file that has to be read.
    pub fn submit(
        &mut self,
        doc: &SceneDoc,
        base: &Path,
        resolved: impl Fn(&SceneDoc) -> SceneDoc,
        (session, paused): (&Session, bool),
    ) -> Option<PathBuf> {
        match reference_doc(doc) {
            Some(wanted) => {
                let slot = self.rendered.get_or_insert_with(|| Slot::paused(BACKGROUND, session, paused));
                slot.submit(&wanted, resolved, Role::Background, session);
            }
            None => {
                if self.rendered.take().is_some() {
                    session.remove(BACKGROUND);
                }
            }
        }
        let ReferenceDoc::File { file } = &doc.compare.reference else {
            self.file = None;
            return None;
        };
        let path = base.join(file);
        if self.file.as_ref().is_some_and(|known| known.path == path) {
            return None;
        }
        self.file = Some(FileReference { path: path.clone(), serial: 0, read: None, trusted: false });
        Some(path)
    }

    /// Restarts render and file at the next submission.
    pub fn forget(&mut self) {
        if let Some(slot) = &mut self.rendered {
            slot.forget();
        }
        self.file = None;
    }

    /// Reads the file again at the next submission.
    pub fn forget_file(&mut self) {
        self.file = None;
    }

    /// Session id of the rendered reference, if there is one.
    #[must_use]
    pub fn id(&self) -> Option<ViewId> {
        self.rendered.as_ref().map(|slot| slot.id)
    }

    /// Stores the result of reading a file.
    pub fn finish_reading(&mut self, path: &Path, read: Result<Reference, String>) {
        if let Some(file) = self.file.as_mut().filter(|f| f.path == path) {
            self.files += 1;
            (file.serial, file.read) = (self.files, Some(read.map(Arc::new)));
        }
    }

    /// Slot of the rendered reference, if there is one.
    #[must_use]
    pub fn rendered(&self) -> Option<&Slot> {
        self.rendered.as_ref()
    }

    /// Identity of the current reference.
    #[must_use]
    pub fn identity(&self, doc: &SceneDoc) -> ReferenceId {
        match (&doc.compare.reference, &self.picture) {
            (ReferenceDoc::None, _) => ReferenceId::None,
            (ReferenceDoc::Pooled, _) => ReferenceId::Pooled,
            (_, None) => ReferenceId::Awaited,
            (ReferenceDoc::File { .. }, Some(_)) => {
                ReferenceId::File(self.file.as_ref().map_or(0, |f| f.serial))
            }
            (_, Some(picture)) => ReferenceId::Submission(picture.snapshot().map_or(0, |s| s.generation)),
        }
    }

    /// Updates the image from views and session; `target` identifies the image of view A.
    pub fn update(&mut self, doc: &SceneDoc, views: &[Slot], target: Option<&str>, session: &Session) {
        if let Some(slot) = &mut self.rendered {
            slot.update(session);
        }
        self.trust(target);
        let live = match &doc.compare.reference {
            ReferenceDoc::View { view } => views.get(*view).map(|s| (s, format!("view {}", label(*view)))),
            ReferenceDoc::Render { estimator, .. } => self.rendered.as_ref().map(|s| (s, name(estimator))),
            ReferenceDoc::None | ReferenceDoc::Pooled | ReferenceDoc::File { .. } => None,
        };
        match live {
            Some((slot, origin)) => {
                let usable = slot.picture().cloned().filter(|s| s.spp >= LEAST_SAMPLES && s.coarse.is_none());
                let same = self.made_from.as_ref().map(Arc::as_ptr) == usable.as_ref().map(Arc::as_ptr);
                let named =
                    self.picture.as_ref().is_none_or(|known| known.origin.starts_with(&format!("{origin},")));
                if !(same && named) {
                    // Views with the reference's seed are excluded, even if the document changes meanwhile.
                    let seed = slot.rendered.render.seed;
                    self.picture = usable.as_ref().map(|s| {
                        let origin = format!("{origin}, {} spp", s.spp);
                        Arc::new(Reference::of(s, origin).with_seed(seed))
                    });
                    self.made_from = usable;
                }
            }
            None => {
                self.made_from = None;
                self.picture = self.file.as_ref().and_then(|f| f.read.as_ref()?.as_ref().ok().cloned());
            }
        }
    }

    /// Assumes that a file without metadata shows the current scene.
    fn trust(&mut self, target: Option<&str>) {
        let (Some(file), Some(target)) = (&mut self.file, target) else { return };
        if let Some(Ok(read)) = &mut file.read
            && read.target.is_none()
        {
            Arc::make_mut(read).target = Some(target.to_owned());
            self.files += 1;
            (file.trusted, file.serial) = (true, self.files);
        }
    }

    /// Newest image of the reference.
    #[must_use]
    pub fn picture(&self) -> Option<&Arc<Reference>> {
        self.picture.as_ref()
    }

    /// Whether an image is one of the current reference, possibly with fewer samples.
    #[must_use]
    pub fn is_source_of(&self, shown: Option<&Arc<Reference>>) -> bool {
        let Some((now, shown)) = self.picture.as_ref().zip(shown) else { return false };
        let submission = |r: &Reference| r.snapshot().map(|s| s.generation);
        Arc::ptr_eq(now, shown) || (submission(now).is_some() && submission(now) == submission(shown))
    }

    /// Status of the reference.
    #[must_use]
    pub fn state(&self, doc: &SceneDoc, target: Option<&str>) -> ReferenceState {
        let plain = |text: &str| ReferenceState { text: text.into(), problem: None, progress: None };
        match &doc.compare.reference {
            ReferenceDoc::None => plain("none"),
            ReferenceDoc::Pooled => plain("mean of the other unbiased views"),
            ReferenceDoc::View { view } => plain(&match &self.picture {
                Some(picture) => picture.origin.clone(),
                None => format!("view {}, awaited", label(*view)),
            }),
            ReferenceDoc::Render { estimator, .. } => {
                let awaited = format!("{}, awaited", name(estimator));
                let mut state = plain(self.picture.as_ref().map_or(&awaited, |picture| &picture.origin));
                let Some(slot) = &self.rendered else { return state };
                match &slot.state.status {
                    Status::Failed(problem) => state.problem = Some(problem.clone()),
                    Status::Finished => {
                        state.problem = slot.state.ending.and_then(Ending::warning).map(str::to_owned);
                    }
                    _ => state.progress = Some(slot.stats.progress.unwrap_or(0.0)),
                }
                state
            }
            ReferenceDoc::File { file } => {
                let name = Path::new(file).file_name().map_or(file.into(), |n| n.to_string_lossy());
                let mut state = plain(&name);
                let read = self.file.as_ref().and_then(|f| f.read.as_ref());
                match read {
                    None => state.text += " (reading)",
                    Some(Err(problem)) => state.problem = Some(problem.clone()),
                    Some(Ok(picture)) => {
                        let stale = target.is_some_and(|t| !picture.fits(t));
                        let (film, size) = (&doc.film, (picture.width, picture.height));
                        if size != (film.width as usize, film.height as usize) {
                            state.problem = Some(format!(
                                "It has {} × {} pixels, but the scene {} × {}: it is not used. Load an image of \
                                 this size.",
                                size.0, size.1, film.width, film.height
                            ));
                        } else if stale {
                            state.problem = Some(
                                "The scene has changed since this image was made: it is not used. Load or \
                                 render another, or undo the change."
                                    .into(),
                            );
                        } else if self.file.as_ref().is_some_and(|f| f.trusted) {
                            state.text += " (assumed to show this scene)";
                        }
                    }
                }
                state
            }
        }
    }
}

fn name(id: &str) -> String {
    estimator::find(id).map_or(id, |e| e.name).to_owned()
}
