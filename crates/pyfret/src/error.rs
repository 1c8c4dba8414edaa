//! The table from errors of the core to Python exceptions.

use contact_core::{Error, shown};
use pyo3::create_exception;
use pyo3::exceptions::{
    PyKeyboardInterrupt, PyMemoryError, PyOSError, PyRuntimeError, PyTypeError,
};

use crate::prelude::*;

create_exception!(
    pyfret.errors,
    InvalidSceneError,
    PyValueError,
    "A scene, or a scene file, has no meaning. The message has the place and what is allowed."
);
create_exception!(
    pyfret.errors,
    OffGridError,
    InvalidSceneError,
    "The contact reaches the border of the grid. The message has the width that the grid needs."
);
create_exception!(
    pyfret.errors,
    ArgumentError,
    PyValueError,
    "An argument of a function has no meaning. The message names it and what is allowed."
);
create_exception!(
    pyfret.errors,
    SolveError,
    PyRuntimeError,
    "A scene that has a meaning could not be solved; the classes below it are the reasons."
);
create_exception!(
    pyfret.errors,
    NoConvergenceError,
    SolveError,
    "A solver stopped before its tolerance. The message has the residual that it reached."
);
create_exception!(
    pyfret.errors,
    SlidingError,
    SolveError,
    "Loads that friction cannot carry, that nothing carries, or that lift a stuck contact."
);
create_exception!(
    pyfret.errors,
    KernelInaccurateError,
    SolveError,
    "Influence or stress coefficients missed the tolerance asked for."
);
create_exception!(
    pyfret.errors,
    StoreError,
    PyOSError,
    "A file or a result store could not be read or written."
);

/// Python exception; errors of the core become it with `?`.
pub(crate) struct Failed(PyErr);

/// Answer of a function, or its exception.
pub(crate) type Answer<T> = Result<T, Failed>;

/// Makes what Python raises of errors, each by its translation.
macro_rules! fails {
    ($failed:ident: $($error:ty => $translation:expr),* $(,)?) => {
        impl From<$failed> for pyo3::PyErr {
            fn from(failed: $failed) -> Self {
                failed.0
            }
        }

        impl From<pyo3::PyErr> for $failed {
            fn from(error: pyo3::PyErr) -> Self {
                Self(error)
            }
        }

        $(impl From<$error> for $failed {
            fn from(error: $error) -> Self {
                Self($translation(error))
            }
        })*
    };
}
pub(crate) use fails;
fails!(
    Failed:
    Error => to_python,
    fatigue::Error => of_criterion,
    material_table::Error => |error: material_table::Error| of_criterion(error.into()),
    ::fracture::Error => |error| to_python(contact_assess::crack::to_core_error(error)),
);

/// The exception of Python for an error of the core, with its message.
pub(crate) fn to_python(error: Error) -> PyErr {
    let text = shown(&error.to_string()).into_owned();
    match error {
        Error::InvalidScene { .. }
        | Error::SceneFile { .. }
        | Error::SceneFaults { .. }
        | Error::Values { .. }
        | Error::Setting { .. } => InvalidSceneError::new_err(text),
        Error::OffGrid { .. } | Error::WornOffGrid { .. } | Error::GridTooSmall { .. } => {
            OffGridError::new_err(text)
        }
        Error::BeyondFriction { .. } | Error::Lifted { .. } | Error::Unresisted { .. } => {
            SlidingError::new_err(text)
        }
        Error::NotConverged { .. } | Error::HeatNotShared { .. } => {
            NoConvergenceError::new_err(text)
        }
        Error::KernelInaccurate { .. }
        | Error::StressInaccurate { .. }
        | Error::TemperatureInaccurate { .. } => KernelInaccurateError::new_err(text),
        Error::Other(raised) => match raised.0.downcast_ref::<fatigue::Error>() {
            Some(error) => of_criterion(error.clone()),
            None => PyRuntimeError::new_err(text),
        },
        Error::FrictionLaw { raised } => match raised.0.downcast_ref::<PyErr>() {
            Some(own) => Python::attach(|py| own.clone_ref(py)),
            None => PyRuntimeError::new_err(text),
        },
        Error::File { .. } => StoreError::new_err(text),
        Error::Interrupted { .. } => PyKeyboardInterrupt::new_err(text),
        Error::TooLarge { .. } => PyMemoryError::new_err(text),
        _ => PyRuntimeError::new_err(text),
    }
}

/// The exception of Python for an error of the criteria, with its message.
pub(crate) fn of_criterion(error: fatigue::Error) -> PyErr {
    let text = shown(&error.to_string()).into_owned();
    match error {
        fatigue::Error::Stopped => PyKeyboardInterrupt::new_err(text),
        _ => ArgumentError::new_err(text),
    }
}

/// Ends a function with a ValueError; the message is given as to `format!`.
macro_rules! refuse {
    ($($message:tt)*) => {
        return Err(pyo3::exceptions::PyValueError::new_err(format!($($message)*)).into())
    };
}
pub(crate) use refuse;

/// The TypeError of an argument of a wrong type: what was found, and what is `wanted`, with an example. PyO3
/// puts the name of the argument before it.
pub(crate) fn must_be(value: &Bound<'_, PyAny>, wanted: &str) -> PyErr {
    let shown = value
        .repr()
        .map_or_else(|_| "?".to_owned(), |r| r.to_string());
    let shown: String = match shown.char_indices().nth(60) {
        None => shown,
        Some((end, _)) => format!("{}...", &shown[..end]),
    };
    PyTypeError::new_err(format!("{shown}: must be {wanted}"))
}

/// Takes a class as an argument; another type is refused with an example.
macro_rules! takes {
    ($class:ident, $wanted:literal) => {
        impl<'py> pyo3::FromPyObject<'_, 'py> for $class {
            type Error = pyo3::PyErr;

            const INPUT_TYPE: pyo3::inspect::PyStaticExpr = <Self as pyo3::PyTypeInfo>::TYPE_HINT;

            /// Takes an instance of the class; refuses all else with an example.
            fn extract(value: pyo3::Borrowed<'_, 'py, pyo3::PyAny>) -> pyo3::PyResult<Self> {
                match value.cast::<Self>() {
                    Ok(found) => Ok(found.get().clone()),
                    Err(_) => Err($crate::error::must_be(&value, $wanted)),
                }
            }
        }
    };
}
pub(crate) use takes;
