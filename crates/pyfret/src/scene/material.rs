//! Elastic materials.

use contact_core::scene as core;
use pyo3::prelude::*;

use crate::error::to_python;

/// A homogeneous isotropic elastic material.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Elastic(pub(crate) core::Elastic);

impl Elastic {
    pub(crate) const RIGID: Self = Self(core::Elastic::RIGID);
}

#[pymethods]
impl Elastic {
    #[new]
    #[pyo3(signature = (*, E, nu))]
    fn new(E: f64, nu: f64) -> PyResult<Self> {
        core::Elastic::new(E, nu).map(Self).map_err(to_python)
    }

    #[getter]
    fn E(&self) -> f64 {
        self.0.E
    }

    #[getter]
    fn nu(&self) -> f64 {
        self.0.nu
    }

    #[getter]
    fn G(&self) -> f64 {
        self.0.G()
    }

    pub(crate) fn __repr__(&self) -> String {
        if self.0.is_rigid() {
            "RIGID".into()
        } else {
            format!("Elastic(E={:?}, nu={:?})", self.0.E, self.0.nu)
        }
    }
}
