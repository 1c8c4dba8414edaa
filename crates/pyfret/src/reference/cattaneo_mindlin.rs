//! Partial slip of a sphere under a tangential force.

use contact_core::Error;
use contact_core::reference as core;
use contact_core::reference::domain::{between, positive};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Hertz, Numbers, map, map_checked, pair};
use crate::error::to_python;
use crate::scene::Elastic;

/// Cattaneo and Mindlin's partial slip under constant normal force.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct CattaneoMindlin(core::CattaneoMindlin);

#[pymethods]
impl CattaneoMindlin {
    #[new]
    #[pyo3(signature = (hertz, *, bodies, mu))]
    fn new(hertz: Hertz, bodies: (Elastic, Elastic), mu: f64) -> PyResult<Self> {
        let (body1, body2) = pair(bodies)?;
        positive("mu", mu).map_err(to_python)?;
        Ok(Self(core::CattaneoMindlin::new(hertz.0, body1, body2, mu)))
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
    fn stick_radius(&self, T: f64) -> PyResult<f64> {
        self.check(&[("T", T)])?;
        Ok(self.0.stick_radius(T))
    }

    #[pyo3(signature = (T, *, T_m))]
    fn stick_radius_reversed(&self, T: f64, T_m: f64) -> PyResult<f64> {
        self.check(&[("T", T), ("T_m", T_m)])?;
        Ok(self.0.stick_radius_reversed(T, T_m))
    }

    #[pyo3(signature = (r, *, T))]
    fn q_loading<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        T: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.check(&[("T", T)])?;
        Ok(map(py, &r, |r| self.0.q_loading(r, T)))
    }

    #[pyo3(signature = (r, *, T, T_m))]
    fn q_unloading<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        T: f64,
        T_m: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.check(&[("T", T), ("T_m", T_m)])?;
        Ok(map(py, &r, |r| self.0.q_unloading(r, T, T_m)))
    }

    #[pyo3(signature = (r, *, T, T_m))]
    fn q_reloading<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        T: f64,
        T_m: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.check(&[("T", T), ("T_m", T_m)])?;
        Ok(map(py, &r, |r| self.0.q_reloading(r, T, T_m)))
    }

    fn shift_loading<'py>(
        &self,
        py: Python<'py>,
        T: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        map_checked(py, &T, |T| self.force("T", T), |T| self.0.shift_loading(T))
    }

    #[pyo3(signature = (T, *, T_m))]
    fn shift_unloading<'py>(
        &self,
        py: Python<'py>,
        T: Numbers<'py>,
        T_m: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.check(&[("T_m", T_m)])?;
        let shift = |T| self.0.shift_unloading(T, T_m);
        map_checked(py, &T, |T| self.force("T", T), shift)
    }

    #[pyo3(signature = (T, *, T_m))]
    fn shift_reloading<'py>(
        &self,
        py: Python<'py>,
        T: Numbers<'py>,
        T_m: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.check(&[("T_m", T_m)])?;
        let shift = |T| self.0.shift_reloading(T, T_m);
        map_checked(py, &T, |T| self.force("T", T), shift)
    }

    fn loop_energy(&self, T_m: f64) -> PyResult<f64> {
        self.check(&[("T_m", T_m)])?;
        Ok(self.0.loop_energy(T_m))
    }

    fn energy_ratio(&self, T_m: f64) -> PyResult<f64> {
        self.check(&[("T_m", T_m)])?;
        Ok(self.0.energy_ratio(T_m))
    }
}

impl CattaneoMindlin {
    /// A tangential force that friction carries.
    fn force(&self, key: &str, T: f64) -> Result<f64, Error> {
        // Rounding of mu W is no reason to refuse the force at which sliding begins.
        let limit = self.0.T_limit() * (1.0 + 1e-9);
        between(key, T, (-limit, limit))
    }

    fn check(&self, forces: &[(&str, f64)]) -> PyResult<()> {
        let mut forces = forces.iter();
        let checked = forces.try_for_each(|(key, T)| self.force(key, *T).map(drop));
        checked.map_err(to_python)
    }
}
