//! The load path, one increment at a time.

use contact_core::march as core;
use numpy::ToPyArray;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::to_python;
use crate::scene::Scene;

/// A load path being run through; iterating solves one increment after the other.
#[pyclass(module = "pyfret")]
pub(crate) struct March {
    inner: core::March,
}

#[pymethods]
impl March {
    #[new]
    fn new(py: Python<'_>, scene: Scene) -> PyResult<Self> {
        let inner = py.detach(|| core::March::new(&scene.0)).map_err(to_python)?;
        Ok(Self { inner })
    }

    /// Increments solved so far.
    #[getter]
    fn done(&self) -> usize {
        self.inner.state().increments
    }

    /// What is skipped in this scene and why.
    #[getter]
    fn plan(&self) -> Vec<String> {
        self.inner.plan().lines.iter().map(|line| format!("{line:?}")).collect()
    }

    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __next__<'py>(&mut self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        py.check_signals()?;
        match py.detach(|| self.inner.advance()) {
            None => Ok(None),
            Some(Err(error)) => Err(to_python(error)),
            Some(Ok(increment)) => {
                let scalars = PyDict::new(py);
                scalars.set_item("increment", increment.index)?;
                Ok(Some(scalars))
            }
        }
    }
}
