//! Options shared by several commands.

use majorant_core::scene::{Limits, RenderDoc};

/// Parses columns and rows, as `640x480`.
pub(super) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X', '×']);
    sides
        .and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]))
        .ok_or_else(|| format!("`{text}` is not a size: write WIDTHxHEIGHT, e.g. 256x256"))
}

/// Converts the given options to assignments of scene keys.
pub(super) fn assignments(set: &[String], options: &[(&str, Option<String>)]) -> Vec<String> {
    let given = options.iter().filter_map(|(key, value)| Some(format!("{key}={}", value.as_ref()?)));
    set.iter().cloned().chain(given).collect()
}

/// Replaces all limits of a render, with a note about limits of the scene that no longer apply.
pub(super) fn replace_limits(render: &mut RenderDoc, given: Limits) {
    if let Some(note) = dropped(&render.limits(), &given) {
        print_notes(&[note]);
    }
    render.set_limits(given);
}

/// Describes the limits of a scene that are dropped without replacement.
fn dropped(scene: &Limits, given: &Limits) -> Option<String> {
    let dropped: Vec<String> = [
        ("spp", scene.spp.map(|n| n.to_string()).filter(|_| given.spp.is_none())),
        ("seconds", scene.seconds.map(|s| s.to_string()).filter(|_| given.seconds.is_none())),
        ("cpu_seconds", scene.cpu_seconds.map(|s| s.to_string()).filter(|_| given.cpu_seconds.is_none())),
        (
            "relative_error",
            scene.relative_error.map(|e| e.to_string()).filter(|_| given.relative_error.is_none()),
        ),
    ]
    .into_iter()
    .filter_map(|(key, value)| Some(format!("render.{key} = {}", value?)))
    .collect();
    (!dropped.is_empty()).then(|| {
        format!("the given limits replace those of the scene; {} no longer holds", dropped.join(", "))
    })
}

/// Prints notes to standard error; a closed pipe is not an error.
pub(super) fn print_notes(notes: &[String]) {
    use std::io::Write;
    for note in notes {
        let _ = writeln!(std::io::stderr(), "majorant: note: {note}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dropped_limits_are_named() {
        let scene =
            Limits { spp: Some(64), seconds: None, cpu_seconds: Some(30.0), relative_error: Some(0.01) };
        let note = dropped(&scene, &Limits::samples(8)).unwrap_or_default();
        assert!(
            note.contains("render.cpu_seconds = 30, render.relative_error = 0.01 no longer holds"),
            "{note}"
        );
        assert!(!note.contains("render.spp"), "{note}");
        let given = Limits { seconds: Some(2.0), ..Limits::default() };
        assert!(dropped(&scene, &given).is_some_and(|note| note.contains("render.spp = 64")));
        assert_eq!(dropped(&Limits::samples(64), &Limits::samples(8)), None);
        assert_eq!(dropped(&Limits::default(), &given), None);
        let mut render = RenderDoc { relative_error: Some(0.1), ..RenderDoc::default() };
        replace_limits(&mut render, given);
        assert_eq!(render.limits(), given);
    }
}
