//! Errors of values that come with a call and belong to no scene.

use contact_core::Error;
use pyo3::PyErr;

use crate::error::{self, ArgumentError};

/// The Python exception that says the same as `error`.
pub(crate) fn to_python(error: Error) -> PyErr {
    match error {
        Error::InvalidScene { .. } | Error::SceneFile { .. } | Error::Values { .. } => {
            ArgumentError::new_err(error.to_string())
        }
        error => error::to_python(error),
    }
}
