//! `majorant [FILE]`: opens the window.

use super::Failure;
use crate::lab::{self, LabError, LabOptions};
use crate::model::Source;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
pub(super) struct LabArguments {
    /// Scene, volume or image to open, or the name of an embedded scene.
    file: Option<String>,
    /// Write a screenshot of the window to this PNG file, then exit.
    #[arg(long, value_name = "OUT.png")]
    screenshot: Option<PathBuf>,
    /// Delay of the screenshot after the start.
    #[arg(long, value_name = "SECONDS", default_value_t = 4.0)]
    after: f32,
    /// Inner size of the window in points.
    #[arg(long, value_name = "WxH", value_parser = parse_window)]
    window: Option<[f32; 2]>,
    /// Folder with further lessons (.md).
    #[arg(long, value_name = "DIR")]
    lessons: Option<PathBuf>,
    /// Open this lesson, optionally at a page: 2-free-flight:3.
    #[arg(long, value_name = "ID")]
    lesson: Option<String>,
    /// Theme of the window.
    #[arg(long, value_enum)]
    theme: Option<Theme>,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Theme {
    Dark,
    Light,
}

fn parse_window(text: &str) -> Result<[f32; 2], String> {
    let side = |s: &str| s.trim().parse().ok().filter(|n: &f32| (100.0..=16_000.0).contains(n));
    text.split_once(['x', 'X', '×'])
        .and_then(|(w, h)| Some([side(w)?, side(h)?]))
        .ok_or_else(|| format!("`{text}` is not a window size: write WIDTHxHEIGHT, e.g. 1280x720"))
}

pub(super) fn run(arguments: LabArguments) -> Result<(), Failure> {
    let options = LabOptions {
        open: arguments.file.as_deref().map(Source::from_argument),
        screenshot: arguments.screenshot,
        after_seconds: arguments.after,
        window: arguments.window,
        lessons: arguments.lessons,
        lesson: arguments.lesson,
        theme: arguments.theme.map(|theme| match theme {
            Theme::Dark => egui::Theme::Dark,
            Theme::Light => egui::Theme::Light,
        }),
        ..LabOptions::default()
    };
    lab::run(options).map_err(|error| match error {
        LabError::NoDisplay => Failure::NoDisplay(
            "there is no display to open a window on; `majorant render first-light -o out.png --spp 32` \
             renders without one (see `majorant --help`)"
                .into(),
        ),
        LabError::Window(reason) => Failure::Message(format!(
            "the window could not be opened ({reason}); `majorant render first-light -o out.png --spp 32` \
             renders without one"
        )),
    })
}
