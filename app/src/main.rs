//! Majorant: the window without arguments, a command line with them.

use majorant::cli;
use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
