//! Closed forms of `contact_core::reference`.

use contact_core::reference as core;
use numpy::{AllowTypeChange, PyArrayDyn, PyArrayLikeDyn, ToPyArray};
use pyo3::prelude::*;

use crate::scene::Elastic;

/// A number, a sequence or an array of any shape.
type Numbers<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// Hertz contact of two paraboloids of revolution.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct Hertz(pub(crate) core::Hertz);

#[pymethods]
impl Hertz {
    #[getter]
    fn W(&self) -> f64 {
        self.0.W
    }

    #[getter]
    fn E_star(&self) -> f64 {
        self.0.E_star
    }

    #[getter]
    fn a(&self) -> f64 {
        self.0.a
    }

    #[getter]
    fn p0(&self) -> f64 {
        self.0.p0
    }

    #[getter]
    fn delta_z(&self) -> f64 {
        self.0.delta_z
    }

    fn p<'py>(&self, py: Python<'py>, r: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        r.as_array().mapv(|r| self.0.p(r)).to_pyarray(py)
    }

    fn __repr__(&self) -> String {
        let core::Hertz {
            W,
            E_star,
            a,
            p0,
            delta_z,
        } = self.0;
        format!("Hertz(W={W:?}, E_star={E_star:?}, a={a:?}, p0={p0:?}, delta_z={delta_z:?})")
    }
}

#[pyfunction]
#[pyo3(signature = (*, R, bodies, W))]
pub(crate) fn hertz(R: f64, bodies: (Elastic, Elastic), W: f64) -> Hertz {
    Hertz(core::hertz(R, bodies.0.0, bodies.1.0, W))
}
