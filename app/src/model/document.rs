//! Open scene: document, undo history and source.

use super::{History, WindowDoc, rebase, resolved};
use majorant_core::io::{embedded, scene_file};
use majorant_core::scene::{CompareDoc, SceneDoc};
use std::path::{Path, PathBuf};

/// Source of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// An empty new scene.
    New,
    /// An embedded scene, by its name.
    Embedded(String),
    /// A file: a scene, a volume or an image, distinguished by its extension.
    File(PathBuf),
}

impl Source {
    /// Default scene at the start of the program.
    #[must_use]
    pub fn first() -> Self {
        Self::Embedded("first-light".into())
    }

    /// Parses the name of an embedded scene or a path; an existing file takes precedence.
    #[must_use]
    pub fn from_argument(argument: &str) -> Self {
        match embedded::find(argument) {
            Some(_) if !Path::new(argument).exists() => Self::Embedded(argument.into()),
            _ => Self::File(argument.into()),
        }
    }

    fn load(&self) -> Result<SceneDoc, String> {
        match self {
            Self::New => Ok(SceneDoc::default()),
            Self::Embedded(name) => {
                let scene = embedded::find(name).ok_or_else(|| {
                    format!("There is no embedded scene `{name}`. Choose one in File › Embedded scenes.")
                })?;
                scene_file::parse(scene.toml, name).map_err(|error| error.to_string())
            }
            Self::File(path) => scene_file::load(path).map_err(|error| error.to_string()),
        }
    }
}

/// Open scene with its history and its file.
#[derive(Clone, Debug)]
pub struct Document {
    doc: SceneDoc,
    saved: SceneDoc,
    history: History<SceneDoc>,
    path: Option<PathBuf>,
    base: PathBuf,
}

impl Document {
    /// Opens a scene.
    ///
    /// # Errors
    /// A message with the name of the file and the cause.
    pub fn open(source: &Source) -> Result<Self, String> {
        let doc = source.load()?;
        if let (Err(problem), Source::File(path)) = (WindowDoc::read(&doc), source) {
            return Err(format!("{}: {problem}. Correct the key, or delete it.", path.display()));
        }
        let path = match source {
            Source::File(path) => Some(absolute(path)),
            Source::New | Source::Embedded(_) => None,
        };
        let base = path.as_deref().and_then(Path::parent).map_or_else(working_directory, Path::to_owned);
        Ok(Self { saved: doc.clone(), history: History::new(doc.clone()), doc, path, base })
    }

    /// Creates a default scene without a file.
    #[must_use]
    pub fn empty() -> Self {
        Self::new(SceneDoc::default())
    }

    /// Creates a document without a file.
    #[must_use]
    pub fn new(doc: SceneDoc) -> Self {
        Self {
            saved: doc.clone(),
            history: History::new(doc.clone()),
            doc,
            path: None,
            base: working_directory(),
        }
    }

    /// Current scene.
    #[must_use]
    pub fn doc(&self) -> &SceneDoc {
        &self.doc
    }

    /// Scene as opened or last saved; the target of "reset".
    #[must_use]
    pub fn saved(&self) -> &SceneDoc {
        &self.saved
    }

    /// Scene file, if any.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Base directory of relative file names.
    #[must_use]
    pub fn base(&self) -> &Path {
        &self.base
    }

    /// Whether there are changes to save; changes of the display arrangement do not count.
    #[must_use]
    pub fn is_modified(&self) -> bool {
        self.doc != self.saved && worth_saving(&self.doc) != worth_saving(&self.saved)
    }

    /// Scene with absolute file names, for the session.
    #[must_use]
    pub fn resolved(&self) -> SceneDoc {
        resolved(&self.doc, &self.base)
    }

    /// Replaces the scene by an edited one.
    pub fn edit(&mut self, doc: SceneDoc) {
        self.doc = doc;
    }

    /// Records the present state as an undo step if it is settled; `true` while a change is pending.
    pub fn observe(&mut self, settled: bool) -> bool {
        self.history.observe(&self.doc, settled)
    }

    /// Reverts the last edit.
    pub fn undo(&mut self) {
        if let Some(doc) = self.history.undo(&self.doc) {
            self.doc = doc;
        }
    }

    /// Restores the last reverted edit.
    pub fn redo(&mut self) {
        if let Some(doc) = self.history.redo(&self.doc) {
            self.doc = doc;
        }
    }

    /// Whether there is an edit to revert.
    #[must_use]
    pub fn can_undo(&self) -> bool {
        self.history.can_undo(&self.doc)
    }

    /// Whether there is an edit to restore.
    #[must_use]
    pub fn can_redo(&self) -> bool {
        self.history.can_redo(&self.doc)
    }

    /// Writes the scene and adapts relative file names to its new directory.
    ///
    /// # Errors
    /// A message with the name of the file and the cause.
    pub fn save(&mut self, path: &Path) -> Result<(), String> {
        let path = absolute(path);
        let base = path.parent().map_or_else(working_directory, Path::to_owned);
        let doc = rebase(&self.doc, &self.base, &base);
        scene_file::save(&path, &doc).map_err(|error| format!("The scene was not saved: {error}"))?;
        if doc != self.doc {
            self.doc = doc.clone();
            self.history = History::new(doc.clone());
        }
        (self.saved, self.path, self.base) = (doc, Some(path), base);
        Ok(())
    }
}

/// Returns the document without display state. The arrangement of views is saved with a scene, but does not
/// count as an unsaved change.
fn worth_saving(doc: &SceneDoc) -> SceneDoc {
    let mut doc = doc.clone();
    let compare =
        CompareDoc { views: doc.compare.views, reference: doc.compare.reference, ..CompareDoc::default() };
    doc.compare = compare;
    doc.window.clear();
    doc
}

fn working_directory() -> PathBuf {
    std::env::current_dir().unwrap_or_else(|_| PathBuf::from("."))
}

fn absolute(path: &Path) -> PathBuf {
    working_directory().join(path)
}
