//! The table from errors of the core to Python exceptions.

use contact_core::Error;
use pyo3::PyErr;
use pyo3::create_exception;
use pyo3::exceptions::{
    PyKeyboardInterrupt, PyMemoryError, PyOSError, PyRuntimeError, PyValueError,
};

create_exception!(
    pyfret,
    InvalidSceneError,
    PyValueError,
    "A scene, or a scene file, has no meaning; the message names the key, the value and what is allowed."
);
create_exception!(
    pyfret,
    OffGridError,
    InvalidSceneError,
    "The contact reaches the border of the grid; the message says how wide the grid should be."
);
create_exception!(
    pyfret,
    NoConvergenceError,
    PyRuntimeError,
    "A solver stopped before its tolerance; the message gives the residual reached."
);
create_exception!(
    pyfret,
    SlidingError,
    PyRuntimeError,
    "The tangential loads are more than friction can carry; give the shift instead."
);
create_exception!(
    pyfret,
    KernelInaccurateError,
    PyRuntimeError,
    "Influence or stress coefficients missed the tolerance asked for."
);
create_exception!(
    pyfret,
    StoreError,
    PyOSError,
    "A file or a result store could not be read or written."
);

/// The Python exception that says the same as `error`.
pub(crate) fn to_python(error: Error) -> PyErr {
    let text = error.to_string();
    match error {
        Error::InvalidScene { .. } | Error::SceneFile { .. } | Error::Setting { .. } => {
            InvalidSceneError::new_err(text)
        }
        Error::OffGrid { .. } => OffGridError::new_err(text),
        Error::BeyondFriction { .. } => SlidingError::new_err(text),
        Error::NotConverged { .. } => NoConvergenceError::new_err(text),
        Error::KernelInaccurate { .. } | Error::StressInaccurate { .. } => {
            KernelInaccurateError::new_err(text)
        }
        Error::File { .. } => StoreError::new_err(text),
        Error::Interrupted { .. } => PyKeyboardInterrupt::new_err(text),
        Error::TooLarge { .. } => PyMemoryError::new_err(text),
        _ => PyRuntimeError::new_err(text),
    }
}
