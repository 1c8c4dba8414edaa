//! Torsion of a sphere in partial slip.

use contact_core::reference as core;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Hertz, Numbers, map};
use crate::scene::Material;

/// Partial slip of a sphere under constant normal force and a torsional moment.
///
/// J. L. Lubkin, J. Appl. Mech. 18 (1951) 183; exact for every nu.
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
pub(crate) struct Lubkin(core::Lubkin);

#[pymethods]
impl Lubkin {
    #[new]
    #[pyo3(signature = (hertz, *, bodies, mu))]
    fn new(hertz: Hertz, bodies: (Material, Material), mu: f64) -> Self {
        let (body1, body2) = bodies;
        Self(core::Lubkin::new(hertz.0, body1.0, body2.0, mu))
    }

    /// Moment of full slip [N m], (3 pi/16) mu W a.
    #[getter]
    fn M_limit(&self) -> f64 {
        self.0.M_limit()
    }

    /// Torsional stiffness without slip [N m/rad], 16 G a^3/3.
    #[getter]
    fn stiffness(&self) -> f64 {
        self.0.stiffness()
    }

    /// Rotation phi_z at the stick radius `c` [m] [rad].
    fn phi<'py>(&self, py: Python<'py>, c: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &c, |c| self.0.phi(c))
    }

    /// Moment M_z at the stick radius `c` [m] [N m].
    fn M_z<'py>(&self, py: Python<'py>, c: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &c, |c| self.0.M_z(c))
    }

    /// Stick radius under the moment `M_z` [N m] [m].
    #[pyo3(signature = (*, M_z))]
    fn stick_radius(&self, M_z: f64) -> f64 {
        self.0.stick_radius(M_z)
    }

    /// Circumferential traction at `r` for the stick radius `c` [m] [Pa].
    #[pyo3(signature = (r, *, c))]
    fn q<'py>(&self, py: Python<'py>, r: Numbers<'py>, c: f64) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &r, |r| self.0.q(r, c))
    }
}
