//! Keyboard and mouse: one table for the keys, which the help window and the menus read too.

use super::Command;
use crate::model::Arrangement;
use crate::model::Purpose;
use crate::model::WallEdit;
use egui::{Context, Event, Key, KeyboardShortcut, Modifiers};

/// A key and what it does.
pub struct Shortcut {
    /// The keys.
    pub keys: KeyboardShortcut,
    /// What it does, for the help window.
    pub text: &'static str,
    command: fn() -> Command,
}

const fn key(modifiers: Modifiers, key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(modifiers, key)
}

const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// Every key.
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
        text: "Draw the box that numbers are about",
        command: || Command::ToggleBoxTool,
    },
    Shortcut {
        keys: key(Modifiers::NONE, Key::N),
        text: "Show or hide numbers",
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
        text: "Large type, for projectors",
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
    Shortcut { keys: key(Modifiers::NONE, Key::F), text: "Fit the picture", command: || Command::Fit },
    Shortcut {
        keys: key(Modifiers::NONE, Key::Num1),
        text: "Picture at 100 %",
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

/// Gestures on the picture and in panels, for the help window.
pub const GESTURES: &[(&str, &str)] = &[
    ("Left drag", "Orbit the camera"),
    ("Right drag, Shift + drag", "Move the camera sideways"),
    ("Ctrl or Alt + wheel", "Camera closer or away"),
    ("Wheel", "Zoom the picture at the pointer"),
    ("Middle drag, Space + drag", "Move the picture"),
    ("Double click", "Fit the picture"),
    ("Drag a number", "Change it; Shift is finer"),
    ("Click a number", "Type it, with or without its unit"),
    ("Right click a number", "As opened, or its default"),
    ("Double click a plot", "Add a control point"),
    ("Right click a point, Delete", "Remove it"),
    ("Page up, Page down", "Turn the pages of a lesson"),
    ("[ and ]", "Go through the events of a path"),
    ("Tab, over the pictures", "Flip to the next view"),
    ("Ctrl + plus, minus, 0", "Size of the interface"),
];

/// The keys of a command, as menus show them.
#[must_use]
pub fn keys_of(ctx: &Context, command: &Command) -> String {
    KEYS.iter()
        .find(|shortcut| (shortcut.command)() == *command)
        .map_or_else(String::new, |shortcut| name(ctx, &shortcut.keys))
}

/// The keys of a shortcut as people name them.
#[must_use]
pub fn name(ctx: &Context, keys: &KeyboardShortcut) -> String {
    // egui spells out the names of keys that are signs.
    let text = ctx.format_shortcut(keys);
    text.replace("Period", ".")
}

/// The commands of the keys that were pressed since the last frame.
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
        // The event's own modifiers count: the keys may be up again by the end of the frame.
        Event::Key { key, pressed: true, modifiers, .. } => KEYS
            .iter()
            .find(|s| s.keys.logical_key == *key && modifiers.matches_exact(s.keys.modifiers))
            // Fields take the letters, and have an undo of their own while they are edited.
            .filter(|s| !typing || (s.keys.modifiers.command && !matches!(key, Key::Z | Key::Y)))
            .map(|s| (s.command)()),
        Event::Text(text) if text == "?" && !typing => Some(Command::ToggleShortcuts),
        _ => None,
    }
}

/// Whether Tab was pressed. It is taken from egui, which would move the focus.
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
