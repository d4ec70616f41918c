//! Phase function tables: text with an angle and a value on each line, separated by a comma, a semicolon or
//! spaces. Empty lines, lines that begin with `#`, and a heading are skipped.

use crate::phase::MAX_POINTS;
use std::path::Path;

/// Size limit of a file in bytes.
const MAX_BYTES: u64 = 64 * MAX_POINTS as u64;

/// Reason why a table could not be read.
#[derive(Debug, thiserror::Error)]
pub enum PhaseTableError {
    /// The file could not be read.
    #[error("{file}: {source}. Check the name and the folder, or choose another file.")]
    Io {
        /// File name.
        file: String,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The file is too large for a table.
    #[error("{file}: {bytes} bytes are too many; a table has at most {MAX_POINTS} points")]
    TooLarge {
        /// File name.
        file: String,
        /// Size in bytes.
        bytes: u64,
    },
    /// A line is not a point.
    #[error("{file}:{line}: `{text}` is not a point: write an angle and a value, e.g. `0.5, 1.2`")]
    Line {
        /// File name.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// Text of the line.
        text: String,
    },
}

/// Reads a table from a file. [`crate::phase::check_table`] validates its points.
///
/// # Errors
/// When the file is missing, too large, or contains text other than pairs of numbers.
pub fn read(path: &Path) -> Result<Vec<[f32; 2]>, PhaseTableError> {
    let file = path.display().to_string();
    let failed = |source| PhaseTableError::Io { file: file.clone(), source };
    let bytes = std::fs::metadata(path).map_err(failed)?.len();
    if bytes > MAX_BYTES {
        return Err(PhaseTableError::TooLarge { file, bytes });
    }
    parse(&std::fs::read_to_string(path).map_err(failed)?, &file)
}

/// Reads a table from text; `name` is the file name in errors.
///
/// # Errors
/// When a line is not a pair of numbers.
pub fn parse(text: &str, name: &str) -> Result<Vec<[f32; 2]>, PhaseTableError> {
    let mut points = Vec::new();
    let mut heading = true;
    for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines().map(str::trim)) {
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let fields: Vec<&str> = line
            .split(|c: char| c == ',' || c == ';' || c.is_whitespace())
            .filter(|f| !f.is_empty())
            .collect();
        let numbers: Vec<Option<f32>> = fields.iter().map(|f| f.parse().ok()).collect();
        match numbers.as_slice() {
            [Some(at), Some(value)] => points.push([*at, *value]),
            _ if heading && numbers.iter().all(Option::is_none) => {}
            _ => {
                let text = line.chars().take(40).collect();
                return Err(PhaseTableError::Line { file: name.to_owned(), line: number, text });
            }
        }
        heading = false;
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read_with_any_separator() {
        let text = "# a lobe\ncos_theta, value\n-1, 0.2\n\n0;0.5\n0.5\t1.5 # not a comment here\n";
        assert!(parse(text, "a.csv").unwrap_err().to_string().starts_with("a.csv:6: "));
        let good = text.replace(" # not a comment here", "");
        assert_eq!(parse(&good, "a.csv").unwrap(), [[-1.0, 0.2], [0.0, 0.5], [0.5, 1.5]]);
        assert_eq!(parse("\u{feff}0 1\n1 2", "a").unwrap().len(), 2);
        assert!(parse("", "a").unwrap().is_empty());
        // NaN is parsed as a number here, and refused with the index of its point later.
        assert!(parse("0, nan", "a").unwrap()[0][1].is_nan());
    }

    #[test]
    fn other_text_is_refused_with_its_line() {
        for (text, line) in [("a, b\nc, d", 2), ("0, 1\nx, y", 2), ("0.5", 1), ("0, 1, 2", 1), ("0, x", 1)] {
            let message = parse(text, "t.csv").unwrap_err().to_string();
            assert!(message.starts_with(&format!("t.csv:{line}: ")), "{message}");
        }
        let missing = read(Path::new("no/such.csv")).unwrap_err().to_string();
        assert!(missing.contains("such.csv"), "{missing}");
    }
}
