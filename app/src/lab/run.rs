//! Event loop of the window, from start to close.

use super::LabApp;
use super::backend::{self, Backend};
use crate::model::Source;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

/// Start options of the window.
#[derive(Clone, Debug)]
pub struct LabOptions {
    /// Source to open; the first scene if absent.
    pub open: Option<Source>,
    /// PNG file for a screenshot of the window, after which the program ends.
    pub screenshot: Option<PathBuf>,
    /// Delay of the screenshot after the start, in seconds.
    pub after_seconds: f32,
    /// Inner size of the window in points; restored from the last run if absent.
    pub window: Option<[f32; 2]>,
    /// Theme; restored from the last run if absent.
    pub theme: Option<egui::Theme>,
    /// Folder of lessons in addition to the embedded ones.
    pub lessons: Option<PathBuf>,
    /// Id of a lesson to open, optionally with a page: `id:3`.
    pub lesson: Option<String>,
    /// Whether to use the desktop's file dialogs in addition to typed paths.
    pub native_dialogs: bool,
}

impl Default for LabOptions {
    fn default() -> Self {
        Self {
            open: None,
            screenshot: None,
            after_seconds: 4.0,
            window: None,
            theme: None,
            lessons: None,
            lesson: None,
            native_dialogs: true,
        }
    }
}

/// Error that prevents the window from opening.
#[derive(Debug, thiserror::Error)]
pub enum LabError {
    /// No display server is reachable.
    #[error("there is no display to open a window on")]
    NoDisplay,
    /// A display exists, but a window cannot be opened on it.
    #[error("the window cannot be opened: {0}")]
    Window(String),
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`LabError::NoDisplay`] where there is nothing to open a window on, e.g. over ssh.
pub fn run(options: LabOptions) -> Result<(), LabError> {
    let backend = backend::choose().ok_or(LabError::NoDisplay)?;
    let native = native_options(&options, backend);
    let create: eframe::AppCreator<'static> = Box::new(move |cc| Ok(Box::new(LabApp::new(cc, &options)?)));
    // A missing libxkbcommon is reported by a panic inside winit.
    let outcome = catch_unwind(AssertUnwindSafe(|| eframe::run_native("majorant", native, create)));
    match outcome {
        Ok(Ok(())) => Ok(()),
        Ok(Err(eframe::Error::WinitEventLoop(_))) => Err(LabError::NoDisplay),
        Ok(Err(error)) => Err(LabError::Window(error.to_string())),
        Err(panic) => Err(LabError::Window(panic_text(panic.as_ref()))),
    }
}

fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("unknown reason").to_owned()
}

fn native_options(options: &LabOptions, backend: Backend) -> eframe::NativeOptions {
    let mut viewport = egui::ViewportBuilder::default()
        .with_app_id("majorant")
        .with_title("Majorant")
        .with_min_inner_size([800.0, 500.0])
        .with_drag_and_drop(true)
        .with_icon(super::icon::icon());
    viewport = viewport.with_inner_size(options.window.unwrap_or([1440.0, 860.0]));
    // A screenshot must not depend on the last run.
    let fresh = options.screenshot.is_some();
    eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Glow,
        dithering: false,
        persist_window: options.window.is_none() && !fresh,
        persistence_path: fresh
            .then(|| std::env::temp_dir().join(format!("majorant-{}.ron", std::process::id()))),
        event_loop_builder: Some(Box::new(move |builder| force(builder, backend))),
        ..eframe::NativeOptions::default()
    }
}

#[cfg(target_os = "linux")]
fn force(builder: &mut eframe::EventLoopBuilder<eframe::UserEvent>, backend: Backend) {
    use winit::platform::wayland::EventLoopBuilderExtWayland;
    use winit::platform::x11::EventLoopBuilderExtX11;
    match backend {
        Backend::Wayland => {
            builder.with_wayland();
        }
        Backend::X11 => {
            builder.with_x11();
        }
        Backend::Native => {}
    }
}

#[cfg(not(target_os = "linux"))]
fn force(_: &mut eframe::EventLoopBuilder<eframe::UserEvent>, _: Backend) {}
