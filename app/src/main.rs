//! Entry point of the `majorant` program: subcommands, and the window if there is none.

use majorant::cli;
use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
