//! The open scene: document, undo, where it came from.

use super::{History, WindowDoc, rebase, resolved};
use majorant_core::io::{embedded, scene_file};
use majorant_core::scene::{CompareDoc, SceneDoc};
use std::path::{Path, PathBuf};

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// An empty new scene.
    New,
    /// A scene that is part of the program, by its name.
    Embedded(String),
    /// A file: a scene, a volume or an environment map, told apart by its extension.
    File(PathBuf),
}

impl Source {
    /// The scene that opens when nothing else was asked for.
    #[must_use]
    pub fn first() -> Self {
        Self::Embedded("first-light".into())
    }

    /// Takes the name of an embedded scene or else a path.
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
                    format!("There is no embedded scene `{name}`: choose one in File › Embedded scenes.")
                })?;
                scene_file::parse(scene.toml, name).map_err(|error| error.to_string())
            }
            Self::File(path) => scene_file::load(path).map_err(|error| error.to_string()),
        }
    }
}

/// The open scene.
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
    /// A sentence that names the file and what is wrong with it.
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

    /// A new scene, when not even the first one could be opened.
    #[must_use]
    pub fn empty() -> Self {
        Self::new(SceneDoc::default())
    }

    /// A scene that has no file yet.
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

    /// The scene as it is now.
    #[must_use]
    pub fn doc(&self) -> &SceneDoc {
        &self.doc
    }

    /// The scene as it was opened or last saved: what "reset" goes back to.
    #[must_use]
    pub fn saved(&self) -> &SceneDoc {
        &self.saved
    }

    /// The scene file, if it has one.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The directory that relative file names start from.
    #[must_use]
    pub fn base(&self) -> &Path {
        &self.base
    }

    /// Whether there is something to save.
    #[must_use]
    pub fn is_modified(&self) -> bool {
        self.doc != self.saved && worth_saving(&self.doc) != worth_saving(&self.saved)
    }

    /// The scene with absolute file names, as the session gets it.
    #[must_use]
    pub fn resolved(&self) -> SceneDoc {
        resolved(&self.doc, &self.base)
    }

    /// Replaces the scene by an edited one.
    pub fn edit(&mut self, doc: SceneDoc) {
        self.doc = doc;
    }

    /// Makes the present state an undo step if it is settled; `true` while one is waiting.
    pub fn observe(&mut self, settled: bool) -> bool {
        self.history.observe(&self.doc, settled)
    }

    /// Takes the last edit back.
    pub fn undo(&mut self) {
        if let Some(doc) = self.history.undo(&self.doc) {
            self.doc = doc;
        }
    }

    /// Does it again.
    pub fn redo(&mut self) {
        if let Some(doc) = self.history.redo(&self.doc) {
            self.doc = doc;
        }
    }

    /// Whether there is an edit to take back.
    #[must_use]
    pub fn can_undo(&self) -> bool {
        self.history.can_undo(&self.doc)
    }

    /// Whether there is one to do again.
    #[must_use]
    pub fn can_redo(&self) -> bool {
        self.history.can_redo(&self.doc)
    }

    /// Writes the scene; file names follow it to its new directory.
    ///
    /// # Errors
    /// A sentence that names the file and what is wrong with it.
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

/// The document without what is only looked at: how views are arranged is saved with a scene, but nobody has
/// to be asked about it.
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
