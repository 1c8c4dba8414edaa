//! Hertz: circular and elliptical contacts.

use contact_reference as core;
use contact_reference::domain::{between, positive};

use super::{Curved, Numbers, Values, map, pair_of};
use crate::argument::Answer;
use crate::material::Material;
use crate::prelude::*;

/// Frictionless contact of two paraboloids of revolution.
///
/// K. L. Johnson, Contact Mechanics (1985), eq. (4.22)-(4.24). :func:`hertz` makes it.
///
/// Parameters
/// ----------
/// W : float
///     Normal force [N].
/// E_star : float
///     Contact modulus [Pa].
/// a : float
///     Contact radius [m].
/// p0 : float
///     Peak pressure [Pa].
/// delta_z : float
///     Approach [m].
#[pyclass(frozen, from_py_object, module = "pyfret.reference")]
#[derive(Clone, Copy)]
pub(crate) struct Hertz(pub(crate) core::Hertz);

made!(Hertz by "Hertz": W, E_star, a, p0, delta_z);

#[pymethods]
impl Hertz {
    #[new]
    #[pyo3(signature = (*, W: "PointForce", E_star: "ContactModulus", a: "Length", p0: "PeakPressure", delta_z: "Length"))]
    fn new(
        #[pyo3(from_py_with = Given::point_W)] W: f64,
        #[pyo3(from_py_with = Given::E_star)] E_star: f64,
        #[pyo3(from_py_with = Given::radius)] a: f64,
        #[pyo3(from_py_with = Given::p0)] p0: f64,
        #[pyo3(from_py_with = Given::delta_z)] delta_z: f64,
    ) -> Answer<Self> {
        let parts = [
            ("W", W),
            ("E_star", E_star),
            ("a", a),
            ("p0", p0),
            ("delta_z", delta_z),
        ];
        for (key, value) in parts {
            positive(key, value)?;
        }
        Ok(Self(core::Hertz {
            W,
            E_star,
            a,
            p0,
            delta_z,
        }))
    }

    /// Pressure at distance `r` [m] from the middle [Pa], p0 sqrt(1 - r^2/a^2).
    fn p<'py>(&self, r: Numbers<'py>) -> Values<'py> {
        map(&r, |r| self.0.p(r))
    }
}

attributes!(Hertz, self:
    /// Normal force [N].
    W: f64 = self.0.W;
    /// Contact modulus [Pa], 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    E_star: f64 = self.0.E_star;
    /// Contact radius [m], a^3 = 3 W R / (4 E*).
    a: f64 = self.0.a;
    /// Peak pressure [Pa], 3 W / (2 pi a^2).
    p0: f64 = self.0.p0;
    /// Peak pressure [Pa], by the name that it has in results.
    p_H: f64 = self.0.p0;
    /// Approach [m], a^2 / R.
    delta_z: f64 = self.0.delta_z;
);

impl Hertz {
    /// The relative radius that the contact has, a^2/delta_z.
    pub(super) fn curved(&self) -> Curved {
        Curved::Sphere(self.0.a * self.0.a / self.0.delta_z)
    }
}

/// Hertz contact of a sphere of relative radius `R` [m] under the force `W` [N].
#[pyfunction]
#[pyo3(signature = (*, R: "Radius", bodies, W: "PointForce"))]
pub(crate) fn hertz(
    #[pyo3(from_py_with = Given::R)] R: f64,
    bodies: (Material, Material),
    #[pyo3(from_py_with = Given::point_W)] W: f64,
) -> Answer<Hertz> {
    positive("R", R).and(positive("W", W))?;
    let (body1, body2) = pair_of(Curved::Sphere(R), bodies)?;
    Ok(Hertz(core::hertz(R, body1, body2, W)))
}

/// Elliptical Hertz contact, K. L. Johnson, Contact Mechanics (1985), sec. 4.2.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct HertzEllipse {
    ellipse: core::HertzEllipse,
    /// Relative principal radius along x [m].
    #[pyo3(get)]
    R_x: f64,
    /// Relative principal radius along y [m].
    #[pyo3(get)]
    R_y: f64,
}

made!(HertzEllipse by "hertz_ellipse": R_x, R_y, E_star, W);

attributes!(HertzEllipse, self:
    /// Normal force [N].
    W: f64 = self.ellipse.W;
    /// Contact modulus [Pa].
    E_star: f64 = self.ellipse.E_star;
    /// Semi-axis of the contact along x [m].
    a_x: f64 = self.ellipse.a_x;
    /// Semi-axis of the contact along y [m].
    a_y: f64 = self.ellipse.a_y;
    /// Peak pressure [Pa], 3 W / (2 pi a_x a_y).
    p0: f64 = self.ellipse.p0;
    /// Peak pressure [Pa], by the name that it has in results.
    p_H: f64 = self.ellipse.p0;
    /// Approach [m].
    delta_z: f64 = self.ellipse.delta_z;
);

/// Hertz contact of relative principal radii `R_x`, `R_y` [m] along the axes.
///
/// 1/R_x is the sum of both bodies' curvatures along x; `E_star` [Pa], `W` [N].
#[pyfunction]
#[pyo3(signature = (*, R_x: "Radius", R_y: "Radius", E_star: "ContactModulus", W: "PointForce"))]
pub(crate) fn hertz_ellipse(
    #[pyo3(from_py_with = Given::R_x)] R_x: f64,
    #[pyo3(from_py_with = Given::R_y)] R_y: f64,
    #[pyo3(from_py_with = Given::E_star)] E_star: f64,
    #[pyo3(from_py_with = Given::point_W)] W: f64,
) -> Answer<HertzEllipse> {
    for (key, value) in [("R_x", R_x), ("R_y", R_y), ("E_star", E_star), ("W", W)] {
        positive(key, value)?;
    }
    let ratio = R_x.max(R_y) / R_x.min(R_y);
    between("R_x/R_y or R_y/R_x", ratio, (1.0, 1e12))?;
    Ok(HertzEllipse {
        ellipse: core::hertz_ellipse(R_x, R_y, E_star, W),
        R_x,
        R_y,
    })
}
