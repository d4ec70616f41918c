//! Embedded lessons and lessons in folders. An embedded lesson is a file in `assets/lessons` and a line in
//! [`EMBEDDED`].

use super::{Lesson, LessonError};
use std::path::Path;
use std::sync::{Arc, LazyLock};

macro_rules! embedded {
    ($($id:literal),* $(,)?) => {
        &[$(($id, include_str!(concat!("../../../assets/lessons/", $id, ".md")))),*]
    };
}

static EMBEDDED: &[(&str, &str)] = embedded![
    "1-beer-and-lambert",
    "2-free-flight",
    "3-majorants",
    "4-colour-and-the-hero",
    "5-nee-or-unidirectional",
    "6-what-mis-decides",
    "7-absorption",
    "8-when-numbers-overflow",
    "9-biased-or-noisy",
    "10-a-fireflys-autopsy",
];

/// The embedded lessons, in order.
#[must_use]
pub fn embedded() -> &'static [Arc<Lesson>] {
    static LESSONS: LazyLock<Vec<Arc<Lesson>>> = LazyLock::new(|| {
        let read = |(id, source): &(&str, &str)| Lesson::parse(id, source).ok().map(Arc::new);
        EMBEDDED.iter().filter_map(read).collect()
    });
    &LESSONS
}

/// Reads the lessons of a folder, sorted by file name; returns lessons and the errors of unreadable files.
#[must_use]
pub fn in_folder(folder: &Path) -> (Vec<Arc<Lesson>>, Vec<LessonError>) {
    let failed =
        |file: &Path, reason: String| LessonError { file: file.display().to_string(), line: 1, reason };
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => {
            return (Vec::new(), vec![failed(folder, format!("{error}; name a folder of .md files"))]);
        }
    };
    let mut files: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|path| path.extension().is_some_and(|e| e.eq_ignore_ascii_case("md")));
    files.sort();
    let (mut lessons, mut errors) = (Vec::new(), Vec::new());
    for file in files {
        let id = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        match std::fs::read_to_string(&file) {
            Ok(source) => match Lesson::parse(&id, &source) {
                Ok(lesson) => lessons.push(Arc::new(lesson)),
                Err(error) => errors.push(error),
            },
            Err(error) => errors.push(failed(&file, error.to_string())),
        }
    }
    (lessons, errors)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_embedded_lesson_can_be_read_and_predicts_sees_and_explains() {
        use crate::lessons::Stage;
        for (id, source) in EMBEDDED {
            let lesson = Lesson::parse(id, source).unwrap_or_else(|error| panic!("{error}"));
            for stage in [Stage::Predict, Stage::See, Stage::Explain] {
                assert!(lesson.steps.iter().any(|step| step.stage == stage), "{id} has no step to {stage:?}");
            }
        }
        assert_eq!(embedded().len(), EMBEDDED.len());
    }

    #[test]
    fn a_folder_gives_its_lessons_and_the_errors_of_unreadable_ones() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("good.md"), EMBEDDED[0].1).unwrap();
        std::fs::write(folder.path().join("bad.md"), "no header").unwrap();
        std::fs::write(folder.path().join("other.txt"), "").unwrap();
        let (lessons, errors) = in_folder(folder.path());
        assert_eq!((lessons.len(), errors.len()), (1, 1));
        assert!(lessons[0].id == "good" && errors[0].to_string().contains("bad.md"));
        assert_eq!(in_folder(Path::new("/nowhere")).1.len(), 1);
    }
}
