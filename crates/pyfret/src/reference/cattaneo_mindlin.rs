//! Partial slip of a sphere under a tangential force.

use contact_core::reference as core;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Hertz, Numbers, map};
use crate::scene::Elastic;

/// Cattaneo and Mindlin's partial slip under constant normal force.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct CattaneoMindlin(core::CattaneoMindlin);

#[pymethods]
impl CattaneoMindlin {
    #[new]
    #[pyo3(signature = (hertz, *, bodies, mu))]
    fn new(hertz: Hertz, bodies: (Elastic, Elastic), mu: f64) -> Self {
        let (body1, body2) = bodies;
        Self(core::CattaneoMindlin::new(hertz.0, body1.0, body2.0, mu))
    }

    #[getter]
    fn hertz(&self) -> Hertz {
        Hertz(self.0.hertz)
    }

    #[getter]
    fn mu(&self) -> f64 {
        self.0.mu
    }

    #[getter]
    fn G_star(&self) -> f64 {
        self.0.G_star
    }

    #[getter]
    fn T_limit(&self) -> f64 {
        self.0.T_limit()
    }

    #[getter]
    fn shift_limit(&self) -> f64 {
        self.0.shift_limit()
    }

    #[pyo3(signature = (T))]
    fn stick_radius(&self, T: f64) -> f64 {
        self.0.stick_radius(T)
    }

    #[pyo3(signature = (T, *, T_m))]
    fn stick_radius_reversed(&self, T: f64, T_m: f64) -> f64 {
        self.0.stick_radius_reversed(T, T_m)
    }

    #[pyo3(signature = (r, *, T))]
    fn q_loading<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        T: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &r, |r| self.0.q_loading(r, T))
    }

    #[pyo3(signature = (r, *, T, T_m))]
    fn q_unloading<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        T: f64,
        T_m: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &r, |r| self.0.q_unloading(r, T, T_m))
    }

    #[pyo3(signature = (r, *, T, T_m))]
    fn q_reloading<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        T: f64,
        T_m: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &r, |r| self.0.q_reloading(r, T, T_m))
    }

    fn shift_loading<'py>(&self, py: Python<'py>, T: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &T, |T| self.0.shift_loading(T))
    }

    #[pyo3(signature = (T, *, T_m))]
    fn shift_unloading<'py>(
        &self,
        py: Python<'py>,
        T: Numbers<'py>,
        T_m: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &T, |T| self.0.shift_unloading(T, T_m))
    }

    #[pyo3(signature = (T, *, T_m))]
    fn shift_reloading<'py>(
        &self,
        py: Python<'py>,
        T: Numbers<'py>,
        T_m: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &T, |T| self.0.shift_reloading(T, T_m))
    }

    fn loop_energy(&self, T_m: f64) -> f64 {
        self.0.loop_energy(T_m)
    }

    fn energy_ratio(&self, T_m: f64) -> f64 {
        self.0.energy_ratio(T_m)
    }
}
