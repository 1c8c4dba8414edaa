//! Partial slip of a sphere under a tangential force.

use contact_core::reference as core;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Hertz, Numbers, map};
use crate::scene::Material;

/// Partial slip of a sphere under constant normal force and a force T along x.
///
/// C. Cattaneo (1938); R. D. Mindlin, J. Appl. Mech. 16 (1949) 259; reversals after R. D. Mindlin
/// and H. Deresiewicz, J. Appl. Mech. 20 (1953) 327. Exact for similar bodies of nu = 0; for other
/// nu the slip is not quite along x and the shift over the force stays a good approximation.
/// All forces obey abs(T) <= mu W.
///
/// Parameters
/// ----------
/// hertz : Hertz
///     The normal contact.
/// bodies : tuple of Elastic
///     Materials of body 1 and body 2.
/// mu : float
///     Friction coefficient.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct CattaneoMindlin(core::CattaneoMindlin);

#[pymethods]
impl CattaneoMindlin {
    #[new]
    #[pyo3(signature = (hertz, *, bodies, mu))]
    fn new(hertz: Hertz, bodies: (Material, Material), mu: f64) -> Self {
        let (body1, body2) = bodies;
        Self(core::CattaneoMindlin::new(hertz.0, body1.0, body2.0, mu))
    }

    /// The normal contact.
    #[getter]
    fn hertz(&self) -> Hertz {
        Hertz(self.0.hertz)
    }

    /// Friction coefficient.
    #[getter]
    fn mu(&self) -> f64 {
        self.0.mu
    }

    /// Tangential modulus [Pa], 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2.
    #[getter]
    fn G_star(&self) -> f64 {
        self.0.G_star
    }

    /// Largest tangential force [N], mu W.
    #[getter]
    fn T_limit(&self) -> f64 {
        self.0.T_limit()
    }

    /// Shift at which gross sliding starts [m], 3 mu W / (16 a G*).
    #[getter]
    fn shift_limit(&self) -> f64 {
        self.0.shift_limit()
    }

    /// Stick radius of the first loading to `T` [N], a (1 - T/(mu W))^(1/3) [m].
    #[pyo3(signature = (T))]
    fn stick_radius(&self, T: f64) -> f64 {
        self.0.stick_radius(T)
    }

    /// Stick radius after the force changed from the reversal at `T_m` to `T` [N] [m].
    ///
    /// a [1 - abs(T_m - T)/(2 mu W)]^(1/3)
    #[pyo3(signature = (T, *, T_m))]
    fn stick_radius_reversed(&self, T: f64, T_m: f64) -> f64 {
        self.0.stick_radius_reversed(T, T_m)
    }

    /// Shear traction at distance `r` [m] in the first loading to `T` [N] [Pa].
    #[pyo3(signature = (r, *, T))]
    fn q_loading<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        T: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &r, |r| self.0.q_loading(r, T))
    }

    /// Shear traction at `T` on the way back from the first loading to `T_m` [N] [Pa].
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

    /// Shear traction at `T` on the way from -`T_m` back to `T_m` [N] [Pa].
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

    /// Shift delta_x of the first loading to `T` [N] [m].
    fn shift_loading<'py>(&self, py: Python<'py>, T: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &T, |T| self.0.shift_loading(T))
    }

    /// Shift delta_x at `T` on the way back from `T_m` [N] [m].
    #[pyo3(signature = (T, *, T_m))]
    fn shift_unloading<'py>(
        &self,
        py: Python<'py>,
        T: Numbers<'py>,
        T_m: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &T, |T| self.0.shift_unloading(T, T_m))
    }

    /// Shift delta_x at `T` on the way from -`T_m` back to `T_m` [N] [m].
    #[pyo3(signature = (T, *, T_m))]
    fn shift_reloading<'py>(
        &self,
        py: Python<'py>,
        T: Numbers<'py>,
        T_m: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &T, |T| self.0.shift_reloading(T, T_m))
    }

    /// Energy dissipated in one closed loop between -`T_m` and `T_m` [J].
    fn loop_energy(&self, T_m: f64) -> f64 {
        self.0.loop_energy(T_m)
    }

    /// Loop energy over 4 T_m delta_x(T_m); 0.2 where partial slip ends.
    fn energy_ratio(&self, T_m: f64) -> f64 {
        self.0.energy_ratio(T_m)
    }
}
