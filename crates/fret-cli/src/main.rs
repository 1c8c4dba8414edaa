//! The binary `fret`.

#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(fret_cli::run_command(std::env::args_os()))
}
