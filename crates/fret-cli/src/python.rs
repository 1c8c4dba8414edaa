//! Commands of the Python package: `fret study` is `python -m pyfret study`, and so on.
//!
//! Studies take functions of the user and clusters of Dask, reports and figures need libraries of
//! Python. There is one implementation, and the command line is passed on to it. The interpreter
//! looks for modules where it is installed, never in the current folder. A `numpy.py` or a
//! `sitecustomize.py` that lies there is not run. An empty part of `PYTHONPATH`, which a shell
//! makes of `PYTHONPATH=$PYTHONPATH:folder`, means that folder, and is left out.

use std::ffi::{OsStr, OsString};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;
use contact_core::Error;

use crate::Failure;

/// Names the interpreter that has pyfret, if neither that beside `fret` nor the first one on PATH
/// is it.
const INTERPRETER: &str = "FRET_PYTHON";
/// Folders in which Python looks for modules.
const PATH: &str = "PYTHONPATH";
/// Runs the package, without the current folder among those in which modules are looked for.
const PROGRAM: &str = "import sys
sys.path[:] = [place for place in sys.path if place not in ('', '.')]
try:
    import pyfret
except ModuleNotFoundError as absent:
    if str(absent.name).startswith('pyfret.'): raise
    print(f'fret: {sys.executable}: has no package {absent.name}; `fret {sys.argv[1]}` needs Python with the package \
pyfret and what it requires. Install it, or name the interpreter in FRET_PYTHON', file=sys.stderr)
    sys.exit(2)
import runpy
runpy.run_module('pyfret', run_name='__main__', alter_sys=True)";

/// The arguments after the name of the command.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub(crate) struct Options {
    /// Arguments; --help lists them
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    pub(crate) arguments: Vec<OsString>,
}

/// Passes a command on to Python and returns its exit code. On Unix the interpreter replaces this
/// process, so that signals reach it.
pub(crate) fn run(command: &str, arguments: &[OsString]) -> Result<u8, Failure> {
    let interpreter = interpreter();
    let mut python = Command::new(&interpreter);
    python
        // Processes that it starts leave the current folder out as well.
        .env("PYTHONSAFEPATH", "1")
        .env_remove(PATH)
        .envs(std::env::var_os(PATH).and_then(|path| Some((PATH, named_parts(&path)?))))
        .args(["-c", PROGRAM, command])
        .args(arguments);
    exit_code_of(&mut python).map_err(|e| {
        Failure::BadInput(Error::File {
            path: interpreter.display().to_string(),
            message: format!(
                "{e}; `fret {command}` needs Python with the package pyfret: install it, or name the interpreter \
                 in {INTERPRETER}"
            ),
        })
    })
}

/// The folders of a PYTHONPATH without empty parts, which mean the current folder; `None` if none is left.
fn named_parts(path: &OsStr) -> Option<OsString> {
    let current = |part: &PathBuf| part.as_os_str().is_empty() || part == Path::new(".");
    let parts: Vec<PathBuf> = std::env::split_paths(path)
        .filter(|part| !current(part))
        .collect();
    let joined = std::env::join_paths(&parts).ok();
    joined.filter(|_| !parts.is_empty())
}

/// Replaces this process by Python; returns only if that fails.
#[cfg(unix)]
fn exit_code_of(python: &mut Command) -> io::Result<u8> {
    use std::os::unix::process::CommandExt;
    Err(python.exec())
}

/// Runs Python and returns its exit code.
#[cfg(not(unix))]
fn exit_code_of(python: &mut Command) -> io::Result<u8> {
    let code = python.status()?.code();
    Ok(code.and_then(|code| u8::try_from(code).ok()).unwrap_or(1))
}

/// The interpreter named by the user, else the one in the folder of `fret`, else the first one on
/// PATH.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn empty_parts_of_a_path_are_left_out() {
        let kept = |path: &str| named_parts(OsStr::new(path));
        for path in ["", ":", ".", ":.:", "./:"] {
            assert_eq!(kept(path), None, "{path}");
        }
        for path in [":/a:/b", "/a::/b", "/a:/b:", "/a:.:/b"] {
            assert_eq!(kept(path), Some("/a:/b".into()), "{path}");
        }
    }
}
