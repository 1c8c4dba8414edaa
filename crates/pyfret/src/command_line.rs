//! The command `fret`, which the Python package brings along.

use std::ffi::OsString;

use crate::prelude::*;

/// Run the command ``fret`` in this process: what its console script does.
///
/// Ctrl-C belongs to the command from here on, so that the process should end with it.
///
/// Parameters
/// ----------
/// arguments : sequence of str
///     The program's name and its arguments.
///
/// Returns
/// -------
/// int
///     Exit code: 0 done, 1 the run ended early, 2 bad scene or bad command line.
#[pyfunction]
#[pyo3(signature = (arguments: "Sequence[str]"))]
pub(crate) fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| fret_cli::run_command(arguments))
}
