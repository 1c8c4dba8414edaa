//! Torsion of a sphere in partial slip.

use contact_core::Error;
use contact_reference as core;
use contact_reference::domain::{between, positive};

use super::{Hertz, Numbers, Values, map, map_checked, pair_of};
use crate::argument::Answer;
use crate::material::{Elastic, Material};
use crate::prelude::*;

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
    ) -> Answer<Self> {
        let (body1, body2) = pair_of(hertz.curved(), bodies)?;
        positive("mu", mu)?;
        Ok(Self {
            torsion: core::Lubkin::new(hertz.0, body1, body2, mu),
            bodies: (Elastic(body1, None), Elastic(body2, None)),
        })
    }

    /// Rotation phi_z at the stick radius `c` [m] [rad].
    fn phi<'py>(&self, c: Numbers<'py>) -> Answer<Values<'py>> {
        let radius = |c| positive("c", c).and(self.radius(c));
        map_checked(&c, radius, |c| self.torsion.phi(c))
    }

    /// Moment M_z at the stick radius `c` [m] [N m].
    fn M_z<'py>(&self, c: Numbers<'py>) -> Answer<Values<'py>> {
        map_checked(&c, |c| self.radius(c), |c| self.torsion.M_z(c))
    }

    /// Stick radius under the moment `M_z` [N m] [m].
    #[pyo3(signature = (*, M_z: "Moment"))]
    fn stick_radius(&self, #[pyo3(from_py_with = Given::M_z)] M_z: f64) -> Answer<f64> {
        let limit = self.torsion.M_limit() * (1.0 + 1e-9);
        between("M_z", M_z, (0.0, limit))?;
        Ok(self.torsion.stick_radius(M_z))
    }

    /// Circumferential traction at `r` for the stick radius `c` [m] [Pa].
    #[pyo3(signature = (r, *, c: "Length"))]
    fn q<'py>(
        &self,
        r: Numbers<'py>,
        #[pyo3(from_py_with = Given::radius)] c: f64,
    ) -> Answer<Values<'py>> {
        self.radius(c)?;
        Ok(map(&r, |r| self.torsion.q(r, c)))
    }
}

attributes!(Lubkin, self:
    /// The normal contact.
    hertz: Hertz = Hertz(self.torsion.hertz);
    /// Friction coefficient.
    mu: f64 = self.torsion.mu;
    /// Moment of full slip [N m], (3 pi/16) mu W a.
    M_limit: f64 = self.torsion.M_limit();
    /// Torsional stiffness without slip [N m/rad], 16 G a^3/3.
    stiffness: f64 = self.torsion.stiffness();
);

impl Lubkin {
    /// Checks that c \[m\] is the radius of a stick zone in the contact.
    fn radius(&self, c: f64) -> Result<f64, Error> {
        between("c", c, (0.0, self.torsion.hertz.a))
    }
}
