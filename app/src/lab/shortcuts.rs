//! Keyboard and mouse: one table of keys, which the help dialog and the menus use as well.

use super::Command;
use crate::model::Arrangement;
use crate::model::Purpose;
use crate::model::WallEdit;
use egui::{Context, Event, Key, KeyboardShortcut, Modifiers};

/// A keyboard shortcut and its command.
pub struct Shortcut {
    /// Key combination.
    pub keys: KeyboardShortcut,
    /// Description for the help dialog.
    pub text: &'static str,
    command: fn() -> Command,
}

const fn key(modifiers: Modifiers, key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(modifiers, key)
}

const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// All keyboard shortcuts.
pub const KEYS: &[Shortcut] = &[
    Shortcut {
        keys: key(CTRL, Key::N),
        text: "New scene",
        command: || Command::Open(crate::model::Source::New),
    },
    Shortcut { keys: key(CTRL, Key::O), text: "Open scene", command: || Command::Ask(Purpose::OpenScene) },
    Shortcut {
        keys: key(CTRL_SHIFT, Key::O),
        text: "Open volume",
        command: || Command::Ask(Purpose::OpenVolume),
    },
    Shortcut { keys: key(CTRL, Key::S), text: "Save scene", command: || Command::Save },
    Shortcut {
        keys: key(CTRL_SHIFT, Key::S),
        text: "Save scene as",
        command: || Command::Ask(Purpose::SaveScene),
    },
    Shortcut { keys: key(CTRL, Key::E), text: "Export EXR", command: || Command::Ask(Purpose::ExportExr) },
    Shortcut {
        keys: key(CTRL_SHIFT, Key::E),
        text: "Export PNG",
        command: || Command::Ask(Purpose::ExportPng),
    },
    Shortcut { keys: key(CTRL, Key::Z), text: "Undo", command: || Command::Undo },
    Shortcut { keys: key(CTRL_SHIFT, Key::Z), text: "Redo", command: || Command::Redo },
    Shortcut { keys: key(CTRL, Key::Y), text: "Redo", command: || Command::Redo },
    Shortcut {
        keys: key(Modifiers::NONE, Key::W),
        text: "Wipe two views",
        command: || Command::Arrange(Arrangement::Wipe),
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::D),
        text: "Difference of two views",
        command: || Command::Arrange(Arrangement::Difference),
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::G),
        text: "Views side by side",
        command: || Command::Wall(WallEdit::Arrange(Arrangement::Grid)),
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::B),
        text: "Draw the region for statistics",
        command: || Command::ToggleBoxTool,
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::N),
        text: "Show or hide statistics",
        command: || Command::ToggleDock,
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::I),
        text: "Replay the paths of a pixel",
        command: || Command::ShowTab("path"),
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::M),
        text: "Show or hide the majorant's cells",
        command: || Command::ToggleMajorants,
    },
    Shortcut {
        keys: key(CTRL, Key::L),
        text: "Large text, for projectors",
        command: || Command::ToggleLargeType,
    },
    Shortcut { keys: key(CTRL, Key::Q), text: "Quit", command: || Command::Quit },
    Shortcut {
        keys: key(Modifiers::NONE, Key::P),
        text: "Pause or resume",
        command: || Command::TogglePause,
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::Period),
        text: "Step, while paused",
        command: || Command::Step,
    },
    Shortcut { keys: key(Modifiers::NONE, Key::R), text: "Restart", command: || Command::Restart },
    Shortcut {
        keys: key(Modifiers::NONE, Key::E),
        text: "Half a stop brighter",
        command: || Command::Expose(0.5),
    },
    Shortcut {
        keys: key(Modifiers::SHIFT, Key::E),
        text: "Half a stop darker",
        command: || Command::Expose(-0.5),
    },
    Shortcut { keys: key(Modifiers::NONE, Key::F), text: "Fit the image", command: || Command::Fit },
    Shortcut {
        keys: key(Modifiers::NONE, Key::Num1),
        text: "Image at 100 %",
        command: || Command::Zoom(1.0),
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::F2),
        text: "Left column",
        command: || Command::ToggleSceneColumn,
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::F3),
        text: "Right column",
        command: || Command::ToggleMethodColumn,
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::F1),
        text: "This list  (also ?)",
        command: || Command::ToggleShortcuts,
    },
];

/// Gestures on the image and in panels, for the help dialog.
pub const GESTURES: &[(&str, &str)] = &[
    ("Left drag", "Orbit the camera"),
    ("Right drag, Shift + drag", "Pan the camera"),
    ("Ctrl or Alt + wheel", "Dolly the camera"),
    ("Wheel", "Zoom the image at the pointer"),
    ("Middle drag, Space + drag", "Pan the image"),
    ("Double click", "Fit the image"),
    ("Drag a number", "Change its value; Shift for fine steps"),
    ("Click a number", "Type a value, with or without its unit"),
    ("Right click a number", "Reset to the opened value or the default"),
    ("Double click a plot", "Add a control point"),
    ("Right click a point, Delete", "Remove it"),
    ("Page up, Page down", "Turn the pages of a lesson"),
    ("[ and ]", "Step through the events of a path"),
    ("Tab, over the views", "Flip to the next view"),
    ("Ctrl + plus, minus, 0", "Size of the interface"),
];

/// Text of the keys of a command for menus; empty if it has none.
#[must_use]
pub fn keys_of(ctx: &Context, command: &Command) -> String {
    KEYS.iter()
        .find(|shortcut| (shortcut.command)() == *command)
        .map_or_else(String::new, |shortcut| name(ctx, &shortcut.keys))
}

/// Readable name of a key combination.
#[must_use]
pub fn name(ctx: &Context, keys: &KeyboardShortcut) -> String {
    // egui spells out the names of punctuation keys.
    let text = ctx.format_shortcut(keys);
    text.replace("Period", ".")
}

/// Returns the commands of the keys pressed since the last frame.
#[must_use]
pub fn pressed(ctx: &Context) -> Vec<Command> {
    let typing = ctx.text_edit_focused();
    ctx.input_mut(|input| {
        let mut commands = Vec::new();
        input.events.retain(|event| {
            let command = command_of(event, typing);
            let keep = command.is_none();
            commands.extend(command);
            keep
        });
        commands
    })
}

fn command_of(event: &Event, typing: bool) -> Option<Command> {
    match event {
        // The modifiers of the event are used, because the keys may be released by the end of the frame.
        Event::Key { key, pressed: true, modifiers, .. } => KEYS
            .iter()
            .find(|s| s.keys.logical_key == *key && modifiers.matches_exact(s.keys.modifiers))
            // Text fields receive letters, and have their own undo while they are edited.
            .filter(|s| !typing || (s.keys.modifiers.command && !matches!(key, Key::Z | Key::Y)))
            .map(|s| (s.command)()),
        Event::Text(text) if text == "?" && !typing => Some(Command::ToggleShortcuts),
        _ => None,
    }
}

/// Whether Tab was pressed. The event is consumed, so that egui does not move the focus.
#[must_use]
pub fn tab_pressed(ctx: &Context) -> bool {
    if ctx.text_edit_focused() {
        return false;
    }
    let pressed = ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Tab));
    if pressed {
        ctx.memory_mut(|memory| memory.move_focus(egui::FocusDirection::None));
    }
    pressed
}
