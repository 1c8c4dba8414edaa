//! Numbers of increments.

use contact_core::scene as core;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// As many increments as the change needs if the whole range takes this many.
#[pyclass(frozen, eq, hash, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct PerRange(usize);

#[pymethods]
impl PerRange {
    #[new]
    fn new(increments: usize) -> Self {
        Self(increments)
    }

    #[getter]
    fn increments(&self) -> usize {
        self.0
    }

    fn __repr__(&self) -> String {
        format!("PerRange({})", self.0)
    }
}

/// Increments of a branch: a number, or "auto" for as many as the path tolerance asks for.
pub(super) struct Count(pub(super) Option<usize>);

impl<'py> FromPyObject<'_, 'py> for Count {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if value.extract::<&str>().is_ok_and(|word| word == "auto") {
            return Ok(Self(None));
        }
        let wrong = |_| PyValueError::new_err("increments: a whole number >= 1, or \"auto\"");
        value.extract().map(|n| Self(Some(n))).map_err(wrong)
    }
}

/// Increments between two waypoints.
#[derive(FromPyObject)]
pub(super) enum AnyIncrements {
    Each(usize),
    PerRange(PerRange),
}

impl From<AnyIncrements> for core::Increments {
    fn from(increments: AnyIncrements) -> Self {
        match increments {
            AnyIncrements::Each(n) => Self::Each(n),
            AnyIncrements::PerRange(PerRange(n)) => Self::PerRange(n),
        }
    }
}
