//! Torsion of a sphere in partial slip.

use contact_core::Error;
use contact_reference as core;
use contact_reference::domain::{between, positive};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{Hertz, Numbers, map, map_checked, pair};
use crate::argument::to_python;
use crate::arguments::number;
use crate::material::{Elastic, Material};
use crate::parts::made;
use crate::quantity::Given;

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
pub(crate) struct Lubkin {
    torsion: core::Lubkin,
    /// Materials of body 1 and body 2.
    #[pyo3(get)]
    bodies: (Elastic, Elastic),
}

made!(Lubkin by "Lubkin": hertz, bodies, mu);

#[pymethods]
impl Lubkin {
    #[new]
    #[pyo3(signature = (hertz, *, bodies, mu: "float"))]
    fn new(
        hertz: Hertz,
        bodies: (Material, Material),
        #[pyo3(from_py_with = number)] mu: f64,
    ) -> PyResult<Self> {
        let (body1, body2) = pair(bodies)?;
        positive("mu", mu).map_err(to_python)?;
        Ok(Self {
            torsion: core::Lubkin::new(hertz.0, body1, body2, mu),
            bodies: (Elastic(body1, None), Elastic(body2, None)),
        })
    }

    /// The normal contact.
    #[getter]
    fn hertz(&self) -> Hertz {
        Hertz(self.torsion.hertz)
    }

    /// Friction coefficient.
    #[getter]
    fn mu(&self) -> f64 {
        self.torsion.mu
    }

    /// Moment of full slip [N m], (3 pi/16) mu W a.
    #[getter]
    fn M_limit(&self) -> f64 {
        self.torsion.M_limit()
    }

    /// Torsional stiffness without slip [N m/rad], 16 G a^3/3.
    #[getter]
    fn stiffness(&self) -> f64 {
        self.torsion.stiffness()
    }

    /// Rotation phi_z at the stick radius `c` [m] [rad].
    #[pyo3(signature = (c) -> "NDArray[np.float64]")]
    fn phi<'py>(&self, py: Python<'py>, c: Numbers<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let radius = |c| positive("c", c).and(self.radius(c));
        map_checked(py, &c, radius, |c| self.torsion.phi(c))
    }

    /// Moment M_z at the stick radius `c` [m] [N m].
    #[pyo3(signature = (c) -> "NDArray[np.float64]")]
    fn M_z<'py>(&self, py: Python<'py>, c: Numbers<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        map_checked(py, &c, |c| self.radius(c), |c| self.torsion.M_z(c))
    }

    /// Stick radius under the moment `M_z` [N m] [m].
    #[pyo3(signature = (*, M_z: "Quantity"))]
    fn stick_radius(&self, #[pyo3(from_py_with = Given::M_z)] M_z: f64) -> PyResult<f64> {
        let limit = self.torsion.M_limit() * (1.0 + 1e-9);
        between("M_z", M_z, (0.0, limit)).map_err(to_python)?;
        Ok(self.torsion.stick_radius(M_z))
    }

    /// Circumferential traction at `r` for the stick radius `c` [m] [Pa].
    #[pyo3(signature = (r, *, c: "float") -> "NDArray[np.float64]")]
    fn q<'py>(
        &self,
        py: Python<'py>,
        r: Numbers<'py>,
        #[pyo3(from_py_with = number)] c: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.radius(c).map_err(to_python)?;
        Ok(map(py, &r, |r| self.torsion.q(r, c)))
    }
}

impl Lubkin {
    /// A stick radius in the contact.
    fn radius(&self, c: f64) -> Result<f64, Error> {
        between("c", c, (0.0, self.torsion.hertz.a))
    }
}
