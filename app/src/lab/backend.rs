//! Selection of the display server.
//!
//! winit cannot try a second server in the same process, so that a stale `WAYLAND_DISPLAY` (as after `su`, or
//! over ssh) has to be detected before the event loop is built.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// A display server.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Backend {
    Wayland,
    X11,
    /// The only display server of the platform.
    Native,
}

/// Returns a reachable display server, if any. On X11 a set `DISPLAY` suffices.
pub(super) fn choose() -> Option<Backend> {
    if cfg!(not(target_os = "linux")) {
        return Some(Backend::Native);
    }
    let variable = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    decide(variable, listens)
}

fn decide(variable: impl Fn(&str) -> Option<OsString>, listens: impl Fn(&Path) -> bool) -> Option<Backend> {
    if variable("WAYLAND_SOCKET").is_some() {
        return Some(Backend::Wayland);
    }
    let socket = variable("WAYLAND_DISPLAY").and_then(|name| {
        let name = PathBuf::from(name);
        if name.is_absolute() {
            Some(name)
        } else {
            Some(PathBuf::from(variable("XDG_RUNTIME_DIR")?).join(name))
        }
    });
    if socket.is_some_and(|path| listens(&path)) {
        return Some(Backend::Wayland);
    }
    variable("DISPLAY").map(|_| Backend::X11)
}

#[cfg(unix)]
fn listens(socket: &Path) -> bool {
    std::os::unix::net::UnixStream::connect(socket).is_ok()
}

#[cfg(not(unix))]
fn listens(_: &Path) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(variables: &[(&str, &str)], alive: bool) -> Option<Backend> {
        decide(|name| variables.iter().find(|(n, _)| *n == name).map(|(_, v)| v.into()), |_| alive)
    }

    #[test]
    fn a_stale_wayland_display_does_not_hide_x11() {
        let both = [("WAYLAND_DISPLAY", "wayland-0"), ("XDG_RUNTIME_DIR", "/run/user/0"), ("DISPLAY", ":0")];
        assert_eq!(with(&both, true), Some(Backend::Wayland));
        assert_eq!(with(&both, false), Some(Backend::X11));
        assert_eq!(with(&both[..2], false), None);
        assert_eq!(with(&[("WAYLAND_DISPLAY", "wayland-0"), ("DISPLAY", ":0")], true), Some(Backend::X11));
        assert_eq!(with(&[], true), None);
    }
}
