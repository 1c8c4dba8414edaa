//! Indentation: with friction of dissimilar bodies, and without friction of a coated body.

use contact_core::reference as core;
use contact_core::reference::domain::{between, positive};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Numbers, map, pair};
use crate::error::to_python;
use crate::scene::{Coating, Elastic};

#[pyfunction]
pub(crate) fn dundurs_beta(body1: Elastic, body2: Elastic) -> PyResult<f64> {
    let (body1, body2) = pair((body1, body2))?;
    Ok(core::dundurs_beta(body1, body2))
}

#[pyfunction]
#[pyo3(signature = (*, beta, mu))]
pub(crate) fn goodman_stick_ratio(beta: f64, mu: f64) -> PyResult<f64> {
    check(beta, mu)?;
    Ok(core::goodman_stick_ratio(beta, mu))
}

/// Dundurs' parameter of a pair, and a coefficient of friction.
fn check(beta: f64, mu: f64) -> PyResult<()> {
    let beta = between("beta", beta, (-0.5, 0.5));
    beta.and(positive("mu", mu)).map(drop).map_err(to_python)
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
pub(crate) fn coupled_indentation(beta: f64, mu: f64) -> PyResult<CoupledIndentation> {
    check(beta, mu)?;
    Ok(CoupledIndentation(core::coupled_indentation(beta, mu)))
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
) -> PyResult<CoatedIndentation> {
    positive("R", R).and(positive("W", W)).map_err(to_python)?;
    pair((indenter, Elastic(coating.0.material)))?;
    pair((Elastic(coating.0.material), substrate))?;
    let (indenter, coating, substrate) = (indenter.0, coating.0, substrate.0);
    positive("coating.thickness", coating.thickness).map_err(to_python)?;
    core::coated_indentation(R, indenter, coating, substrate, W)
        .map(CoatedIndentation)
        .map_err(to_python)
}
