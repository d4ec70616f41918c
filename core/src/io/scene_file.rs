//! Scene files: the complete editable document as TOML.
//!
//! Errors state line and column. Keys include their units (`fov_deg`, `lambda_nm`), so that a wrong unit is
//! an unknown key or a value out of range.

use crate::estimator::validate;
use crate::scene::{FORMAT_VERSION, SceneDoc};
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// Reason why a scene could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum SceneFileError {
    /// The file could not be read or written.
    #[error("{file}: {source}. Check the name and the folder, or choose another file.")]
    Io {
        /// File name.
        file: String,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The text is not a scene.
    #[error("{file}:{line}:{column}: {message}")]
    Invalid {
        /// File name.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// Column number, from 1.
        column: usize,
        /// Fault and remedy.
        message: String,
    },
    /// A `KEY=VALUE` override does not apply to the scene.
    #[error("`{assignment}`: {message}")]
    Override {
        /// Text of the override.
        assignment: String,
        /// Fault.
        message: String,
    },
}

/// Reads a scene file.
///
/// # Errors
/// When the file cannot be read, or is not a valid scene.
pub fn load(path: &Path) -> Result<SceneDoc, SceneFileError> {
    let file = path.display().to_string();
    let text =
        std::fs::read_to_string(path).map_err(|source| SceneFileError::Io { file: file.clone(), source })?;
    parse(&text, &file)
}

/// Reads a scene from text; `name` is the file name in errors.
///
/// # Errors
/// When the text is not a valid scene: syntax, unknown keys, wrong types, values out of range.
pub fn parse(text: &str, name: &str) -> Result<SceneDoc, SceneFileError> {
    let invalid = |offset: usize, message: String| {
        let (line, column) = line_and_column(text, offset);
        SceneFileError::Invalid { file: name.to_owned(), line, column, message }
    };
    let doc: SceneDoc = toml::from_str(text).map_err(|e| {
        let offset = locate_error(text, &e);
        invalid(offset, e.message().to_owned())
    })?;
    if !(1..=FORMAT_VERSION).contains(&doc.majorant) {
        let message = format!(
            "this is scene format {}, but this program reads formats 1 to {FORMAT_VERSION}: set `majorant = {FORMAT_VERSION}` if the keys fit",
            doc.majorant
        );
        return Err(invalid(offset_of(text, "majorant").unwrap_or(0), message));
    }
    let doc = doc.upgraded();
    match validate(&doc).into_iter().next() {
        None => Ok(doc),
        Some(problem) => Err(invalid(offset_of(text, &problem.path).unwrap_or(0), problem.to_string())),
    }
}

/// Text of a document, which parses to the same document.
#[must_use]
pub fn to_toml(doc: &SceneDoc) -> String {
    toml::to_string(doc).unwrap_or_else(|e| format!("# not representable: {e}\n"))
}

/// Writes a scene file.
///
/// # Errors
/// When the file cannot be written.
pub fn save(path: &Path, doc: &SceneDoc) -> Result<(), SceneFileError> {
    // Written under a temporary name and then renamed, so that a full disk does not destroy the existing
    // scene.
    let beside = path.with_extension("toml.part");
    std::fs::write(&beside, to_toml(doc))
        .and_then(|()| std::fs::rename(&beside, path))
        .map_err(|source| SceneFileError::Io { file: path.display().to_string(), source })
}

/// Applies `KEY=VALUE` overrides such as `medium.majorant.factor=2` or `lights.0.scale=3`. `medium.KEY`
/// addresses the only medium, `media.NAME.KEY` one of several. Values use the syntax of scene files; a value
/// that is not valid TOML is taken as text.
///
/// # Errors
/// When a key does not exist, a value has the wrong type, or the resulting scene is invalid; the error names
/// the override responsible.
pub fn override_keys(doc: &SceneDoc, assignments: &[String]) -> Result<SceneDoc, SceneFileError> {
    let mut doc = doc.clone();
    for assignment in assignments {
        let failed = |message: String| SceneFileError::Override { assignment: assignment.clone(), message };
        let (path, value) = assignment
            .split_once('=')
            .ok_or_else(|| failed("write KEY=VALUE, e.g. medium.majorant.factor=2".into()))?;
        let mut tree = toml::Value::try_from(&doc).map_err(|e| failed(e.to_string()))?;
        set(&mut tree, path.trim(), read_value(value.trim())).map_err(failed)?;
        doc = tree.try_into().map_err(|e: toml::de::Error| failed(e.message().to_owned()))?;
        doc = doc.upgraded();
    }
    // Only the combination is validated: a width may require the height that follows it.
    match validate(&doc).into_iter().next() {
        None => Ok(doc),
        Some(problem) => {
            let touches = |a: &&String| a.starts_with(&problem.path) || problem.path.starts_with(key_of(a));
            let culprit = assignments.iter().rev().find(touches).or(assignments.last());
            Err(SceneFileError::Override {
                assignment: culprit.cloned().unwrap_or_default(),
                message: problem.to_string(),
            })
        }
    }
}

fn key_of(assignment: &str) -> &str {
    assignment.split_once('=').map_or(assignment, |(key, _)| key.trim())
}

fn read_value(text: &str) -> toml::Value {
    toml::from_str::<toml::Table>(&format!("v = {text}"))
        .ok()
        .and_then(|mut table| table.remove("v"))
        .unwrap_or_else(|| toml::Value::String(text.to_owned()))
}

fn set(tree: &mut toml::Value, path: &str, value: toml::Value) -> Result<(), String> {
    let mut at = tree;
    let mut keys: Vec<&str> = path.split('.').collect();
    let last = keys.pop().filter(|k| !k.is_empty()).ok_or("the key is empty")?;
    let mut keys = keys.into_iter().peekable();
    if let Some(section @ ("medium" | "media")) = keys.peek().copied() {
        keys.next();
        let media =
            child(at, "media").and_then(toml::Value::as_array_mut).ok_or("the scene has no medium")?;
        let name = if section == "media" { keys.next().or(Some(last)) } else { None };
        let index = keys.peek().and_then(|key| key.parse::<usize>().ok()).filter(|_| section == "medium");
        at = match index {
            Some(index) => {
                keys.next();
                media.get_mut(index).ok_or_else(|| format!("`{path}`: there is no element {index}"))?
            }
            None => addressed(media, name)?,
        };
    }
    for key in keys {
        at = child(at, key).ok_or_else(|| format!("there is no `{key}` on the way to `{path}`"))?;
    }
    match at {
        toml::Value::Table(table) => {
            table.insert(last.to_owned(), value);
            Ok(())
        }
        toml::Value::Array(_) => {
            let slot = child(at, last).ok_or_else(|| format!("`{path}`: there is no element {last}"))?;
            *slot = value;
            Ok(())
        }
        _ => Err(format!("`{path}` leads into a plain value")),
    }
}

/// The medium with a name, or the only medium.
fn addressed<'a>(media: &'a mut [toml::Value], name: Option<&str>) -> Result<&'a mut toml::Value, String> {
    let name_of = |medium: &toml::Value| medium.get("name").and_then(toml::Value::as_str).map(str::to_owned);
    let names: Vec<_> = media.iter().filter_map(name_of).collect();
    let several = || format!("write media.NAME.KEY with one of the names {}", names.join(", "));
    let index = match name {
        Some(name) => names
            .iter()
            .position(|known| known == name)
            .ok_or_else(|| format!("no medium is named `{name}`: {}", several()))?,
        None if media.len() > 1 => return Err(format!("the scene has {} media: {}", media.len(), several())),
        None => 0,
    };
    media.get_mut(index).ok_or_else(|| "the scene has no medium".to_owned())
}

fn child<'a>(tree: &'a mut toml::Value, key: &str) -> Option<&'a mut toml::Value> {
    match tree {
        toml::Value::Table(table) => {
            // Tables with default values only are omitted from the text; an override may still refer to them.
            Some(table.entry(key).or_insert_with(|| toml::Value::Table(toml::Table::new())))
        }
        toml::Value::Array(items) => items.get_mut(key.parse::<usize>().ok()?),
        _ => None,
    }
}

fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
    (line, column)
}

/// Offset of an error. Inside tagged tables the parser knows only where the table begins; the key quoted in
/// the message is then searched for, up to the header of the next table.
fn locate_error(text: &str, error: &toml::de::Error) -> usize {
    let start = error.span().map_or(0, |span| span.start);
    let Some(key) = error.message().split('`').nth(1).filter(|q| !q.is_empty()) else { return start };
    let mut offset = start;
    for (number, line) in text.get(start..).unwrap_or_default().split_inclusive('\n').enumerate() {
        let trimmed = line.trim_start();
        if number > 0 && trimmed.starts_with('[') {
            break;
        }
        if trimmed.strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with('=')) {
            return offset + line.len() - trimmed.len();
        }
        offset += line.len();
    }
    start
}

/// Offset of the value of a key such as `lights[1].size`, or of its innermost parent in the text.
fn offset_of(text: &str, path: &str) -> Option<usize> {
    let document = DeTable::parse(text).ok()?;
    let mut parts = path.split(['.', '[', ']']).filter(|part| !part.is_empty());
    let first = parts.next()?;
    let media = || document.get_ref().get("media").filter(|_| first == "medium");
    let mut found = document.get_ref().get(first).or_else(media)?;
    for part in parts {
        // The keys of the only medium have no index.
        if let (DeValue::Array(elements), Err(_)) = (found.get_ref(), part.parse::<usize>())
            && elements.len() == 1
            && let Some(only) = elements.first()
        {
            found = only;
        }
        let next = match (found.get_ref(), part.parse::<usize>()) {
            (DeValue::Array(elements), Ok(index)) => elements.get(index),
            (DeValue::Table(table), _) => table.get(part),
            _ => None,
        };
        let Some(next) = next else { break };
        found = next;
    }
    Some(found.span().start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_located_by_their_keys_down_to_list_elements() {
        let text = "majorant = 1
[medium.majorant]
factor = 2
[[lights]]
size = [1, 2]
[[lights]]
size = [3, 4]
  [lights.spectrum]
  peak = 5
";
        for (path, value) in [
            ("majorant", "1"),
            ("medium.majorant.factor", "2"),
            ("medium.majorant.missing", "[medium.majorant]"),
            ("lights[0].size[1]", "2"),
            ("lights[1].size[0]", "3"),
            ("lights[1].spectrum.peak", "5"),
            ("lights[1].missing", "[[lights]]\nsize = [3"),
        ] {
            let found = offset_of(text, path).and_then(|offset| text.get(offset..));
            assert!(found.is_some_and(|rest| rest.starts_with(value)), "{path}: {found:?}");
        }
        assert_eq!(offset_of(text, "film.width"), None);
        let media = "[[media]]\nscale = 1\n[[media]]\nscale = 2\n";
        let found = offset_of(media, "medium[1].scale").and_then(|offset| media.get(offset..));
        assert_eq!(found, Some("2\n"));
    }
}
