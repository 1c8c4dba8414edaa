//! Partial slip of a sphere under a tangential force.

use contact_core::Error;
use contact_reference as core;
use contact_reference::domain::{between, positive};

use super::{Hertz, Numbers, Values, map, map_checked, pair_of};
use crate::argument::Answer;
use crate::material::{Elastic, Material};
use crate::prelude::*;

/// Partial slip of a sphere under constant normal force and a force T along x.
///
/// C. Cattaneo (1938); R. D. Mindlin, J. Appl. Mech. 16 (1949) 259; reversals after R. D. Mindlin
/// and H. Deresiewicz, J. Appl. Mech. 20 (1953) 327. Exact for similar bodies of nu = 0. For other
/// nu the slip is not quite along x, and the shift over the force is a good approximation. All
/// forces obey abs(T) <= mu W.
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
pub(crate) struct CattaneoMindlin {
    slip: core::CattaneoMindlin,
    /// Materials of body 1 and body 2.
    #[pyo3(get)]
    bodies: (Elastic, Elastic),
}

made!(CattaneoMindlin by "CattaneoMindlin": hertz, bodies, mu);

#[pymethods]
impl CattaneoMindlin {
    #[new]
    #[pyo3(signature = (hertz, *, bodies, mu: "float"))]
    fn new(
        hertz: Hertz,
        bodies: (Material, Material),
        #[pyo3(from_py_with = number)] mu: f64,
    ) -> Answer<Self> {
        let (body1, body2) = pair_of(hertz.curved(), bodies)?;
        positive("mu", mu)?;
        Ok(Self {
            slip: core::CattaneoMindlin::new(hertz.0, body1, body2, mu),
            bodies: (Elastic(body1, None), Elastic(body2, None)),
        })
    }

    /// Stick radius of the first loading to `T` [N], a (1 - T/(mu W))^(1/3) [m].
    #[pyo3(signature = (T: "PointForce"))]
    fn stick_radius(&self, #[pyo3(from_py_with = Given::point_T)] T: f64) -> PyResult<f64> {
        self.check(&[("T", T)])?;
        Ok(self.slip.stick_radius(T))
    }

    /// Stick radius after the force changed from the reversal at `T_m` to `T` [N] [m].
    ///
    /// a [1 - abs(T_m - T)/(2 mu W)]^(1/3)
    #[pyo3(signature = (T: "PointForce", *, T_m: "PointForce"))]
    fn stick_radius_reversed(
        &self,
        #[pyo3(from_py_with = Given::point_T)] T: f64,
        #[pyo3(from_py_with = Given::point_T)] T_m: f64,
    ) -> PyResult<f64> {
        self.check(&[("T", T), ("T_m", T_m)])?;
        Ok(self.slip.stick_radius_reversed(T, T_m))
    }

    /// Shear traction at distance `r` [m] in the first loading to `T` [N] [Pa].
    #[pyo3(signature = (r, *, T: "PointForce"))]
    fn q_loading<'py>(
        &self,
        r: Numbers<'py>,
        #[pyo3(from_py_with = Given::point_T)] T: f64,
    ) -> Answer<Values<'py>> {
        self.check(&[("T", T)])?;
        Ok(map(&r, |r| self.slip.q_loading(r, T)))
    }

    /// Shear traction at `T` on the way back from the first loading to `T_m` [N] [Pa].
    #[pyo3(signature = (r, *, T: "PointForce", T_m: "PointForce"))]
    fn q_unloading<'py>(
        &self,
        r: Numbers<'py>,
        #[pyo3(from_py_with = Given::point_T)] T: f64,
        #[pyo3(from_py_with = Given::point_T)] T_m: f64,
    ) -> Answer<Values<'py>> {
        self.check(&[("T", T), ("T_m", T_m)])?;
        Ok(map(&r, |r| self.slip.q_unloading(r, T, T_m)))
    }

    /// Shear traction at `T` on the way from -`T_m` back to `T_m` [N] [Pa].
    #[pyo3(signature = (r, *, T: "PointForce", T_m: "PointForce"))]
    fn q_reloading<'py>(
        &self,
        r: Numbers<'py>,
        #[pyo3(from_py_with = Given::point_T)] T: f64,
        #[pyo3(from_py_with = Given::point_T)] T_m: f64,
    ) -> Answer<Values<'py>> {
        self.check(&[("T", T), ("T_m", T_m)])?;
        Ok(map(&r, |r| self.slip.q_reloading(r, T, T_m)))
    }

    /// Shift delta_x of the first loading to `T` [N] [m].
    fn shift_loading<'py>(&self, T: Numbers<'py>) -> Answer<Values<'py>> {
        map_checked(&T, |T| self.force("T", T), |T| self.slip.shift_loading(T))
    }

    /// Shift delta_x at `T` on the way back from `T_m` [N] [m].
    #[pyo3(signature = (T, *, T_m: "PointForce"))]
    fn shift_unloading<'py>(
        &self,
        T: Numbers<'py>,
        #[pyo3(from_py_with = Given::point_T)] T_m: f64,
    ) -> Answer<Values<'py>> {
        self.check(&[("T_m", T_m)])?;
        let shift = |T| self.slip.shift_unloading(T, T_m);
        map_checked(&T, |T| self.force("T", T), shift)
    }

    /// Shift delta_x at `T` on the way from -`T_m` back to `T_m` [N] [m].
    #[pyo3(signature = (T, *, T_m: "PointForce"))]
    fn shift_reloading<'py>(
        &self,
        T: Numbers<'py>,
        #[pyo3(from_py_with = Given::point_T)] T_m: f64,
    ) -> Answer<Values<'py>> {
        self.check(&[("T_m", T_m)])?;
        let shift = |T| self.slip.shift_reloading(T, T_m);
        map_checked(&T, |T| self.force("T", T), shift)
    }

    /// Energy dissipated in one closed loop between -`T_m` and `T_m` [J].
    #[pyo3(signature = (T_m: "PointForce"))]
    fn loop_energy(&self, #[pyo3(from_py_with = Given::point_T)] T_m: f64) -> PyResult<f64> {
        self.check(&[("T_m", T_m)])?;
        Ok(self.slip.loop_energy(T_m))
    }

    /// Loop energy over 4 T_m delta_x(T_m); 0.2 where partial slip ends.
    #[pyo3(signature = (T_m: "PointForce"))]
    fn energy_ratio(&self, #[pyo3(from_py_with = Given::point_T)] T_m: f64) -> PyResult<f64> {
        self.check(&[("T_m", T_m)])?;
        Ok(self.slip.energy_ratio(T_m))
    }
}

attributes!(CattaneoMindlin, self:
    /// The normal contact.
    hertz: Hertz = Hertz(self.slip.hertz);
    /// Friction coefficient.
    mu: f64 = self.slip.mu;
    /// Tangential modulus [Pa], 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2.
    G_star: f64 = self.slip.G_star;
    /// Largest tangential force [N], mu W.
    T_limit: f64 = self.slip.T_limit();
    /// Shift at which gross sliding starts [m], 3 mu W / (16 a G*).
    shift_limit: f64 = self.slip.shift_limit();
);

impl CattaneoMindlin {
    /// Checks that friction carries the force T \[N\]; `key` names it in the error.
    fn force(&self, key: &str, T: f64) -> Result<f64, Error> {
        // Rounding of mu W is no reason to refuse the force at which sliding begins.
        let limit = self.slip.T_limit() * (1.0 + 1e-9);
        between(key, T, (-limit, limit))
    }

    /// Checks named forces \[N\].
    fn check(&self, forces: &[(&str, f64)]) -> Answer<()> {
        let mut forces = forces.iter();
        let checked = forces.try_for_each(|(key, T)| self.force(key, *T).map(drop));
        Ok(checked?)
    }
}
