//! Output of a comparison as files: images, maps, tables, curves, and an HTML page.
//!
//! ```text
//!   Experiment ──► Gathered (ranking, maps, ranges, curves) ──┬─► A-nee.png, A-nee.z.png, A-nee.exr
//!                                                             ├─► compare.exr, ranking.csv, curves.csv
//!                                                             └─► compare.json, scene.toml, index.html
//! ```
//!
//! Each format is one file of this module. All formats use the same data.

mod gather;
mod json;
mod layers;
mod page;
mod pictures;
mod plot;
mod reproduce;
mod row;
mod tables;
pub mod words;

#[cfg(test)]
pub(in crate::compare) mod fixture;

use super::Experiment;
use crate::io::export::ExportError;
use crate::io::scene_file;
use gather::Gathered;
pub(crate) use pictures::{encode as encode_png, rgb};
pub(crate) use row::of_standings;
pub use row::{Row, rows};
use std::path::{Path, PathBuf};
pub(crate) use tables::{cell, text as csv_text};

/// Reason why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The folder or a file in it could not be written.
    #[error("{path} could not be written: {reason}. Choose another folder, or free some space.")]
    Write {
        /// Folder or file.
        path: String,
        /// Error of the operating system.
        reason: String,
    },
    /// An image could not be written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// No view has an image with known noise.
    #[error(
        "the report would be empty: every view needs at least {} samples per pixel",
        super::LEAST_SAMPLES
    )]
    Nothing,
}

impl ReportError {
    pub(crate) fn write(path: &Path, reason: impl ToString) -> Self {
        Self::Write { path: path.display().to_string(), reason: reason.to_string() }
    }
}

/// Selection of output formats, and additional information for the report.
#[derive(Clone, Debug, Default)]
pub struct Formats {
    /// PNG files of every view, its maps, and the reference; EXR files of every view.
    pub pictures: bool,
    /// `compare.exr`, with all images as layers.
    pub layers: bool,
    /// `ranking.csv` and `curves.csv`.
    pub tables: bool,
    /// `compare.json`.
    pub json: bool,
    /// `index.html`.
    pub page: bool,
    /// Command line that created the comparison, if there was one.
    pub command: Option<String>,
    /// Further notes, one sentence each.
    pub notes: Vec<String>,
}

impl Formats {
    /// All formats.
    #[must_use]
    pub fn all() -> Self {
        Self { pictures: true, layers: true, tables: true, json: true, page: true, ..Self::default() }
    }
}

/// Creates the folder of a report and checks that it is writable. Called before rendering.
///
/// # Errors
/// When it cannot be created or is not writable.
pub fn make_folder(dir: &Path) -> Result<(), ReportError> {
    std::fs::create_dir_all(dir).map_err(|e| ReportError::write(dir, e))?;
    // An existing folder may be write-protected.
    let probe = dir.join(".majorant");
    std::fs::write(&probe, [])
        .and_then(|()| std::fs::remove_file(&probe))
        .map_err(|e| ReportError::write(dir, e))
}

/// Writes a report into a folder, always with `scene.toml`, which reproduces it. Returns the files.
///
/// # Errors
/// When the folder cannot be created, a file cannot be written, or no view has three samples per pixel.
pub fn write(experiment: &Experiment, dir: &Path, what: &Formats) -> Result<Vec<PathBuf>, ReportError> {
    make_folder(dir)?;
    let gathered = Gathered::of(experiment);
    if gathered.standings.is_empty() {
        return Err(ReportError::Nothing);
    }
    let mut files = Vec::new();
    let text = |files: &mut Vec<PathBuf>, name: &str, text: &str| {
        let path = dir.join(name);
        std::fs::write(&path, text).map_err(|e| ReportError::write(&path, e))?;
        files.push(path);
        Ok::<(), ReportError>(())
    };
    text(&mut files, "scene.toml", &scene_file::to_toml(&experiment.doc))?;
    if what.pictures {
        pictures::write(&gathered, dir, &mut files)?;
    }
    if what.layers {
        let path = dir.join("compare.exr");
        layers::write(&gathered, &path)?;
        files.push(path);
    }
    if what.tables {
        text(&mut files, "ranking.csv", &tables::ranking(&gathered)?)?;
        text(&mut files, "curves.csv", &tables::curves(&gathered)?)?;
    }
    if what.json {
        text(&mut files, "compare.json", &json::document(&gathered, what)?)?;
    }
    if what.page {
        text(&mut files, "index.html", &page::render(&gathered, what)?)?;
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_contains_the_requested_formats() {
        let experiment = fixture::experiment("A cloud");
        let folder = tempfile::tempdir().unwrap();
        let dir = folder.path().join("new").join("report");
        let names = |what: &Formats| -> Vec<String> {
            let files = write(&experiment, &dir, what).unwrap();
            assert!(files.iter().all(|f| f.metadata().unwrap().len() > 0));
            files.iter().map(|f| f.file_name().unwrap().to_string_lossy().into_owned()).collect()
        };
        assert_eq!(names(&Formats::default()), ["scene.toml"]);
        let all = names(&Formats::all());
        for name in [
            "A-spectral-mis.png",
            "B-nee.z.png",
            "C-uni-nee-mis.exr",
            "reference.png",
            "compare.exr",
            "ranking.csv",
            "curves.csv",
            "compare.json",
            "index.html",
        ] {
            assert!(all.iter().any(|n| n == name), "{name} is not in {all:?}");
        }
        let scene = scene_file::load(&dir.join("scene.toml")).unwrap();
        assert_eq!(scene, *experiment.doc);
    }

    #[test]
    fn an_impossible_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::write(&file, "x").unwrap();
        let error = make_folder(&file.join("report")).unwrap_err().to_string();
        assert!(error.contains("file") && error.contains("Choose another folder"), "{error}");
        let nothing = Experiment { views: Vec::new(), ..fixture::experiment("A cloud") };
        assert!(matches!(write(&nothing, folder.path(), &Formats::all()), Err(ReportError::Nothing)));
    }
}
