//! Errors of values that come with a call and belong to no scene.

use contact_core::Error;
use pyo3::PyErr;

use crate::error::{self, ArgumentError, fails};

/// Python exception; errors of the core become it with `?`.
pub(crate) struct Failed(PyErr);

/// Answer of a function, or its exception.
pub(crate) type Answer<T> = Result<T, Failed>;

fails!(Failed: Error => to_python, error::Failed => PyErr::from);

impl From<Failed> for error::Failed {
    /// The exception of Python for a failure.
    fn from(failed: Failed) -> Self {
        PyErr::from(failed).into()
    }
}

/// Python exception with the message of `error`.
pub(crate) fn to_python(error: Error) -> PyErr {
    match error {
        Error::InvalidScene { .. } | Error::SceneFile { .. } | Error::Values { .. } => {
            ArgumentError::new_err(error.to_string())
        }
        error => error::to_python(error),
    }
}
