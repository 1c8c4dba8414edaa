//! Line contact of cylinders, in partial slip, under a bulk stress, in rolling.

use contact_core::reference as core;
use numpy::{PyArrayDyn, ToPyArray};
use pyo3::prelude::*;

use super::{Numbers, map};
use crate::scene::Elastic;

/// Hertz, Cattaneo, Carter and McEwen in plane strain.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct LineContact {
    line: core::LineContact,
    #[pyo3(get)]
    E_star: f64,
}

#[pyfunction]
#[pyo3(signature = (*, R, bodies, W))]
pub(crate) fn line_contact(R: f64, bodies: (Elastic, Elastic), W: f64) -> LineContact {
    let E_star = core::hertz(R, bodies.0.0, bodies.1.0, 1.0).E_star;
    LineContact {
        line: core::line_contact(R, E_star, W),
        E_star,
    }
}

#[pymethods]
impl LineContact {
    #[getter]
    fn W(&self) -> f64 {
        self.line.W
    }

    #[getter]
    fn a(&self) -> f64 {
        self.line.a
    }

    #[getter]
    fn p0(&self) -> f64 {
        self.line.p0
    }

    fn p<'py>(&self, py: Python<'py>, x: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &x, |x| self.line.p(x))
    }

    #[pyo3(signature = (*, T, mu))]
    fn stick_half_width(&self, T: f64, mu: f64) -> f64 {
        self.line.stick_half_width(T, mu)
    }

    #[pyo3(signature = (*, eps_x, mu))]
    fn stick_middle(&self, eps_x: f64, mu: f64) -> f64 {
        self.line.stick_middle(eps_x, self.E_star, mu)
    }

    #[pyo3(signature = (x, *, T, mu, middle = 0.0))]
    fn q<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        T: f64,
        mu: f64,
        middle: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &x, |x| self.line.q_shifted(x, middle, T, mu))
    }

    #[pyo3(signature = (x, z, *, T, mu))]
    fn stress<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        z: f64,
        T: f64,
        mu: f64,
    ) -> [Bound<'py, PyArrayDyn<f64>>; 3] {
        let x = x.as_array();
        let of = |x: f64| self.line.partial_slip_stress((x, z), T, mu);
        [0, 1, 2].map(|row| x.mapv(|x| of(x)[row]).to_pyarray(py))
    }
}
