//! The command line, with one subcommand per file.

mod bench;
mod check;
mod compare;
mod contributions;
mod estimators;
mod figures;
mod info;
mod keys;
mod lab;
mod options;
mod path;
mod progress;
mod render;
mod scenes;
mod source;

use clap::{Parser, Subcommand};
use std::io::{self, Write};
use std::process::ExitCode;

/// A lab for volume lighting: interactive Monte Carlo light transport in participating media.
#[derive(Parser, Debug)]
#[command(
    name = "majorant",
    version,
    args_conflicts_with_subcommands = true,
    after_help = "\
Without a subcommand the window opens with FILE, or with an embedded scene.

Examples:
  majorant                                        open the window
  majorant cloud.vdb                              open a volume in the window
  majorant scenes                                 list the embedded scenes
  majorant render first-light -o out.exr --spp 64
  majorant check                                  compare the estimators with known answers
  majorant compare cloud-backlit --seconds 20 -o report --html
                                                  rank the estimators on a scene
  majorant bench first-light --seconds 4          measure the efficiency of the estimators
  majorant path plume-spectral --pixel 64,60      replay the brightest path of a pixel, with its path weights
  majorant contributions cloud-sidelit --by order -o orders
                                                  separate the image by scattering order
  majorant figures all -o report                  reproduce the report's figures, and run its missing study
  majorant render scene.toml -o out.png --set medium.majorant.factor=2 --seconds 30

Exit codes: 0 success, 1 a file, a render or a check failed, 2 wrong usage, 3 no display for the window,
4 the relative error that limits the render is undefined: the image is black, or has no finite value."
)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    lab: lab::LabArguments,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Render a scene without a window.
    Render(render::Arguments),
    /// Compare every estimator with known answers, or the estimators with each other on your own scene.
    Check(check::Arguments),
    /// Measure the efficiency of estimators at equal time, by the error against a reference.
    Bench(bench::Arguments),
    /// Rank estimators on a scene by cost, noise, error, speed-up and bias; as a table, files or a page.
    Compare(compare::Arguments),
    /// Reproduce the figures of the report, and compare every estimator at equal time.
    Figures(figures::Arguments),
    /// Replay one path of an image and print its path weights, event by event.
    Path(path::Arguments),
    /// Separate an image into contributions: by technique, scattering order, null collisions or hero.
    #[command(visible_alias = "parts")]
    Contributions(contributions::Arguments),
    /// List the estimators.
    Estimators,
    /// Describe a volume, image or scene file.
    Info(info::Arguments),
    /// List the embedded scenes.
    Scenes,
    /// List every key of a scene file: type, range, default, meaning, effects and bias.
    Keys(keys::Arguments),
}

/// Failure of a command.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A failure whose message contains the cause and the remedy.
    Message(String),
    /// There is no display to open a window on.
    NoDisplay(String),
    /// The image was written, but has no relative error.
    NoError(&'static str),
}

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Message(error.to_string())
    }
}

/// Runs the program with the arguments of the process.
#[must_use]
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = match arguments.command {
        None => lab::run(arguments.lab),
        Some(Command::Render(a)) => render::run(&a),
        Some(Command::Bench(a)) => bench::run(&a),
        Some(Command::Check(a)) => check::run(&a),
        Some(Command::Compare(a)) => compare::run(&a),
        Some(Command::Figures(a)) => figures::run(&a),
        Some(Command::Path(a)) => path::run(&a),
        Some(Command::Contributions(a)) => contributions::run(&a),
        Some(Command::Estimators) => estimators::run(),
        Some(Command::Info(a)) => info::run(&a),
        Some(Command::Scenes) => scenes::run(),
        Some(Command::Keys(a)) => keys::run(&a),
    };
    let (code, message) = match result {
        Ok(()) => return ExitCode::SUCCESS,
        Err(Failure::Message(message)) => (1, message),
        Err(Failure::NoDisplay(message)) => (3, message),
        Err(Failure::NoError(message)) => (4, message.to_owned()),
    };
    // This fails only if the pipe is closed, and then the message cannot be read.
    let _ = writeln!(io::stderr(), "majorant: {message}");
    ExitCode::from(code)
}

/// Prints a line to standard output; a closed pipe is not an error.
pub(crate) fn print_line(text: &str) -> Result<(), Failure> {
    match writeln!(io::stdout(), "{text}") {
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}
