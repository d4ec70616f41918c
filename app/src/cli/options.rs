//! What several commands read alike.

/// `640x480` as columns and rows.
pub(super) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X', '×']);
    sides
        .and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]))
        .ok_or_else(|| format!("`{text}` is not a size: write WIDTHxHEIGHT, e.g. 256x256"))
}

/// Assignments to keys of the scene for options that were given.
pub(super) fn assignments(set: &[String], options: &[(&str, Option<String>)]) -> Vec<String> {
    let given = options.iter().filter_map(|(key, value)| Some(format!("{key}={}", value.as_ref()?)));
    set.iter().cloned().chain(given).collect()
}

/// Notes go to standard error; nobody reading them is not an error.
pub(super) fn print_notes(notes: &[String]) {
    use std::io::Write;
    for note in notes {
        let _ = writeln!(std::io::stderr(), "majorant: note: {note}");
    }
}
