//! Errors of values that come with a call and belong to no scene.

use contact_core::Error;
use pyo3::PyErr;

use crate::error::{self, ArgumentError, fails};

/// What Python raises. Errors of the core become it with `?`.
pub(crate) struct Failed(PyErr);

/// What a function gives, or why it failed.
pub(crate) type Answer<T> = Result<T, Failed>;

fails!(Failed: Error => to_python, error::Failed => PyErr::from);

impl From<Failed> for error::Failed {
    fn from(failed: Failed) -> Self {
        PyErr::from(failed).into()
    }
}

/// The Python exception that says the same as `error`.
pub(crate) fn to_python(error: Error) -> PyErr {
    match error {
        Error::InvalidScene { .. } | Error::SceneFile { .. } | Error::Values { .. } => {
            ArgumentError::new_err(error.to_string())
        }
        error => error::to_python(error),
    }
}
