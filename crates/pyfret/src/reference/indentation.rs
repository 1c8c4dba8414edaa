//! Indentation: with friction of dissimilar bodies, and without friction of a coated body.

use contact_core::reference as core;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Numbers, map};
use crate::scene::{Coating, Elastic};

#[pyfunction]
pub(crate) fn dundurs_beta(body1: Elastic, body2: Elastic) -> f64 {
    core::dundurs_beta(body1.0, body2.0)
}

#[pyfunction]
#[pyo3(signature = (*, beta, mu))]
pub(crate) fn goodman_stick_ratio(beta: f64, mu: f64) -> f64 {
    core::goodman_stick_ratio(beta, mu)
}

/// Self-similar indentation with friction, fully coupled.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct CoupledIndentation(core::CoupledIndentation);

#[pymethods]
impl CoupledIndentation {
    #[getter]
    fn stick_ratio(&self) -> f64 {
        self.0.stick_ratio
    }

    #[getter]
    fn p0(&self) -> f64 {
        self.0.p0
    }

    #[getter]
    fn delta_z(&self) -> f64 {
        self.0.delta_z
    }

    #[getter]
    fn W(&self) -> f64 {
        self.0.W
    }
}

#[pyfunction]
#[pyo3(signature = (*, beta, mu))]
pub(crate) fn coupled_indentation(beta: f64, mu: f64) -> CoupledIndentation {
    CoupledIndentation(core::coupled_indentation(beta, mu))
}

/// Frictionless contact of a sphere with a coated body.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct CoatedIndentation(core::CoatedIndentation);

#[pymethods]
impl CoatedIndentation {
    #[getter]
    fn a(&self) -> f64 {
        self.0.a
    }

    #[getter]
    fn W(&self) -> f64 {
        self.0.W
    }

    #[getter]
    fn delta_z(&self) -> f64 {
        self.0.delta_z
    }

    fn p<'py>(&self, py: Python<'py>, r: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &r, |r| self.0.p(r))
    }
}

#[pyfunction]
#[pyo3(signature = (*, R, indenter, coating, substrate, W))]
pub(crate) fn coated_indentation(
    R: f64,
    indenter: Elastic,
    coating: Coating,
    substrate: Elastic,
    W: f64,
) -> CoatedIndentation {
    let contact = core::coated_indentation(R, indenter.0, coating.0, substrate.0, W);
    CoatedIndentation(contact)
}
