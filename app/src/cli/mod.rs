//! The command line: one subcommand per file. What the window renders, `render` renders too.

mod bench;
mod check;
mod compare;
mod estimators;
mod figures;
mod info;
mod keys;
mod lab;
mod options;
mod parts;
mod path;
mod progress;
mod render;
mod scenes;
mod source;

use clap::{Parser, Subcommand};
use std::io::{self, Write};
use std::process::ExitCode;

/// A volume-lighting lab: see, touch and measure Monte Carlo light transport in participating media.
#[derive(Parser, Debug)]
#[command(
    name = "majorant",
    version,
    args_conflicts_with_subcommands = true,
    after_help = "\
Without a subcommand the lab opens, on FILE or on its embedded scene.

Examples:
  majorant                                        open the lab
  majorant cloud.vdb                              open it on your own volume
  majorant scenes                                 list the embedded scenes
  majorant render first-light -o out.exr --spp 64
  majorant check                                  hold the estimators against known answers
  majorant compare cloud-backlit --seconds 20 -o report --html
                                                  which estimator wins, and by how much
  majorant bench first-light --seconds 4          how much certainty does a second buy?
  majorant path plume-spectral --pixel 64,60      replay the brightest of a pixel's paths, with its books
  majorant parts cloud-sidelit --by order -o parts
                                                  what each scattering order adds to the image
  majorant figures all -o report                  the report's figures, and the study that it calls for
  majorant render scene.toml -o out.png --set medium.majorant.factor=2 --seconds 30

Exit codes: 0 success, 1 a file, a render or a check failed, 2 wrong usage, 3 no display for the window,
4 an error that was asked for is not defined: the picture is black, or has no finite value."
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
    /// Hold every estimator against answers that are known, or against each other on your own scene.
    Check(check::Arguments),
    /// Measure speed: equal time for every estimator, error against a reference, efficiency.
    Bench(bench::Arguments),
    /// Rank estimators on a scene: cost, noise, error, speed-up, bias; as a table, files, a page.
    Compare(compare::Arguments),
    /// Reproduce the report: its figures, and every estimator at equal time with a conclusion.
    Figures(figures::Arguments),
    /// Replay one path of an image and print its books, event by event.
    Path(path::Arguments),
    /// Take an image apart: by technique, scattering order, null collisions or hero.
    Parts(parts::Arguments),
    /// List the estimators.
    Estimators,
    /// Describe a volume, picture or scene file.
    Info(info::Arguments),
    /// List the embedded scenes.
    Scenes,
    /// List every key of a scene file: type, range, default, meaning, what it affects, when it biases.
    Keys(keys::Arguments),
}

/// What a command ends with.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Something went wrong; the message names the cause and the cure.
    Message(String),
    /// There is no display to open a window on.
    NoDisplay(String),
    /// The picture is there, and has no relative error.
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
        Some(Command::Parts(a)) => parts::run(&a),
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
    // A closed pipe is the only way for this to fail, and then nobody reads it.
    let _ = writeln!(io::stderr(), "majorant: {message}");
    ExitCode::from(code)
}

/// Prints a line to standard output; a reader that has gone away is not an error.
pub(crate) fn print_line(text: &str) -> Result<(), Failure> {
    match writeln!(io::stdout(), "{text}") {
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}
