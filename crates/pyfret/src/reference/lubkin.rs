//! Torsion of a sphere in partial slip.

use contact_core::reference as core;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Hertz, Numbers, map};
use crate::scene::Elastic;

/// Lubkin's partial slip under a torsional moment.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct Lubkin(core::Lubkin);

#[pymethods]
impl Lubkin {
    #[new]
    #[pyo3(signature = (hertz, *, bodies, mu))]
    fn new(hertz: Hertz, bodies: (Elastic, Elastic), mu: f64) -> Self {
        let (body1, body2) = bodies;
        Self(core::Lubkin::new(hertz.0, body1.0, body2.0, mu))
    }

    #[getter]
    fn M_limit(&self) -> f64 {
        self.0.M_limit()
    }

    #[getter]
    fn stiffness(&self) -> f64 {
        self.0.stiffness()
    }

    fn phi<'py>(&self, py: Python<'py>, c: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &c, |c| self.0.phi(c))
    }

    fn M_z<'py>(&self, py: Python<'py>, c: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &c, |c| self.0.M_z(c))
    }

    #[pyo3(signature = (*, M_z))]
    fn stick_radius(&self, M_z: f64) -> f64 {
        self.0.stick_radius(M_z)
    }

    #[pyo3(signature = (r, *, c))]
    fn q<'py>(&self, py: Python<'py>, r: Numbers<'py>, c: f64) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &r, |r| self.0.q(r, c))
    }
}
