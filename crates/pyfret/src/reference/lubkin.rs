//! Torsion of a sphere in partial slip.

use contact_core::Error;
use contact_core::reference as core;
use contact_core::reference::domain::{between, positive};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Hertz, Numbers, map, map_checked, pair};
use crate::error::to_python;
use crate::material::Material;

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
    fn new(hertz: Hertz, bodies: (Material, Material), mu: f64) -> PyResult<Self> {
        let (body1, body2) = pair(bodies)?;
        positive("mu", mu).map_err(to_python)?;
        Ok(Self(core::Lubkin::new(hertz.0, body1, body2, mu)))
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
    fn phi<'py>(&self, py: Python<'py>, c: Numbers<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let radius = |c| positive("c", c).and(self.radius(c));
        map_checked(py, &c, radius, |c| self.0.phi(c))
    }

    /// Moment M_z at the stick radius `c` [m] [N m].
    fn M_z<'py>(&self, py: Python<'py>, c: Numbers<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        map_checked(py, &c, |c| self.radius(c), |c| self.0.M_z(c))
    }

    /// Stick radius under the moment `M_z` [N m] [m].
    #[pyo3(signature = (*, M_z))]
    fn stick_radius(&self, M_z: f64) -> PyResult<f64> {
        let limit = self.0.M_limit() * (1.0 + 1e-9);
        between("M_z", M_z, (0.0, limit)).map_err(to_python)?;
        Ok(self.0.stick_radius(M_z))
    }

    /// Circumferential traction at `r` for the stick radius `c` [m] [Pa].
    #[pyo3(signature = (r, *, c))]
    fn q<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        c: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.radius(c).map_err(to_python)?;
        Ok(map(py, &r, |r| self.0.q(r, c)))
    }
}

impl Lubkin {
    /// A stick radius in the contact.
    fn radius(&self, c: f64) -> Result<f64, Error> {
        between("c", c, (0.0, self.0.hertz.a))
    }
}
