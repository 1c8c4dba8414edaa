//! Commands that the Python package does: `fret study` is `python -m pyfret study`, and so on.
//!
//! Studies take functions of the user and clusters of Dask, reports and figures libraries of Python:
//! there is one implementation, and this hands the command line over to it.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;
use contact_core::Error;

use crate::Failure;

/// Names the interpreter that has pyfret, if neither that beside `fret` nor the first one on PATH is it.
const INTERPRETER: &str = "FRET_PYTHON";

/// All that follows the name of the command.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub(crate) struct Options {
    /// Arguments; --help lists them
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<OsString>,
}

/// Hands a command over to Python and ends as it ends.
pub(crate) fn run(command: &str, options: &Options) -> Result<u8, Failure> {
    let interpreter = interpreter();
    let mut python = Command::new(&interpreter);
    python
        .args(["-m", "pyfret", command])
        .args(&options.arguments);
    let without_package = |why: &str| {
        Failure::BadInput(Error::File {
            path: interpreter.display().to_string(),
            message: format!(
                "{why}; `fret {command}` needs Python with the package pyfret: install it, or name the \
                 interpreter in {INTERPRETER}"
            ),
        })
    };
    let ended = python
        .status()
        .map_err(|e| without_package(&e.to_string()))?;
    if !ended.success() && !has_package(&interpreter) {
        return Err(without_package("has no package pyfret"));
    }
    let code = ended.code().and_then(|code| u8::try_from(code).ok());
    Ok(code.unwrap_or(1))
}

/// Whether the package is installed for the interpreter.
fn has_package(interpreter: &Path) -> bool {
    let look = "import importlib.util, sys; sys.exit(importlib.util.find_spec('pyfret') is None)";
    let looked = Command::new(interpreter).args(["-c", look]).status();
    looked.is_ok_and(|status| status.success())
}

/// The interpreter named by the user, that in the folder of `fret`, or the first one on PATH.
fn interpreter() -> PathBuf {
    if let Some(named) = std::env::var_os(INTERPRETER) {
        return named.into();
    }
    let name = if cfg!(windows) {
        "python.exe"
    } else {
        "python3"
    };
    let beside = std::env::current_exe()
        .ok()
        .map(|fret| fret.with_file_name(name));
    beside
        .filter(|python| python.is_file())
        .unwrap_or_else(|| name.into())
}
