//! Hertz: circular and elliptical contacts.

use contact_core::reference as core;
use contact_core::reference::domain::{between, positive};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Numbers, map, pair};
use crate::error::to_python;
use crate::scene::Elastic;

/// Hertz contact of two paraboloids of revolution.
#[pyclass(frozen, from_py_object, module = "pyfret.reference")]
#[derive(Clone, Copy)]
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
        map(py, &r, |r| self.0.p(r))
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
pub(crate) fn hertz(R: f64, bodies: (Elastic, Elastic), W: f64) -> PyResult<Hertz> {
    let (body1, body2) = pair(bodies)?;
    positive("R", R).and(positive("W", W)).map_err(to_python)?;
    Ok(Hertz(core::hertz(R, body1, body2, W)))
}

/// Elliptical Hertz contact.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct HertzEllipse(core::HertzEllipse);

#[pymethods]
impl HertzEllipse {
    #[getter]
    fn W(&self) -> f64 {
        self.0.W
    }

    #[getter]
    fn E_star(&self) -> f64 {
        self.0.E_star
    }

    #[getter]
    fn a_x(&self) -> f64 {
        self.0.a_x
    }

    #[getter]
    fn a_y(&self) -> f64 {
        self.0.a_y
    }

    #[getter]
    fn p0(&self) -> f64 {
        self.0.p0
    }

    #[getter]
    fn delta_z(&self) -> f64 {
        self.0.delta_z
    }
}

#[pyfunction]
#[pyo3(signature = (*, R_x, R_y, E_star, W))]
pub(crate) fn hertz_ellipse(R_x: f64, R_y: f64, E_star: f64, W: f64) -> PyResult<HertzEllipse> {
    for (key, value) in [("R_x", R_x), ("R_y", R_y), ("E_star", E_star), ("W", W)] {
        positive(key, value).map_err(to_python)?;
    }
    let ratio = R_x.max(R_y) / R_x.min(R_y);
    between("R_x/R_y or R_y/R_x", ratio, (1.0, 1e12)).map_err(to_python)?;
    Ok(HertzEllipse(core::hertz_ellipse(R_x, R_y, E_star, W)))
}
