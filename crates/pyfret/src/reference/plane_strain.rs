//! Line contact of cylinders, in partial slip, under a bulk stress, in rolling.

use contact_reference as core;
use contact_reference::domain::{between, positive};
use ndarray::Zip;
use numpy::PyArrayDyn;

use super::{Curved, Numbers, Values, checked, map, pair_of, rows, together};
use crate::argument::Answer;
use crate::material::{Elastic, Material};
use crate::prelude::*;

/// Farthest place over the half-width.
const FAR: f64 = 1e30;

/// Cylinders in plane strain: Hertz, Cattaneo, Carter, McEwen; from `line_contact`.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct LineContact {
    line: core::LineContact,
    /// Contact modulus [Pa].
    #[pyo3(get)]
    E_star: f64,
    /// Relative radius [m].
    #[pyo3(get)]
    R: f64,
    /// Materials of body 1 and body 2.
    #[pyo3(get)]
    bodies: (Elastic, Elastic),
}

made!(LineContact by "line_contact": R, bodies, W);

/// Line contact of cylinders of relative radius `R` [m] under `W` [N/m].
#[pyfunction]
#[pyo3(signature = (*, R: "Radius", bodies, W: "LineForce"))]
pub(crate) fn line_contact(
    #[pyo3(from_py_with = Given::R)] R: f64,
    bodies: (Material, Material),
    #[pyo3(from_py_with = Given::line_W)] W: f64,
) -> Answer<LineContact> {
    positive("R", R).and(positive("W", W))?;
    let (body1, body2) = pair_of(Curved::Cylinder(R), bodies)?;
    let E_star = core::hertz(R, body1, body2, 1.0).E_star;
    Ok(LineContact {
        line: core::line_contact(R, E_star, W),
        E_star,
        R,
        bodies: (Elastic(body1, None), Elastic(body2, None)),
    })
}

#[pymethods]
impl LineContact {
    /// Pressure at `x` [m] [Pa].
    fn p<'py>(&self, x: Numbers<'py>) -> Values<'py> {
        map(&x, |x| self.line.p(x))
    }

    /// Half-width of the stick zone under `T` [N/m] [m].
    #[pyo3(signature = (*, T: "LineForce", mu: "float"))]
    fn stick_half_width(
        &self,
        #[pyo3(from_py_with = Given::line_T)] T: f64,
        #[pyo3(from_py_with = number)] mu: f64,
    ) -> PyResult<f64> {
        self.check(T, mu)?;
        Ok(self.line.stick_half_width(T, mu))
    }

    /// Middle of the stick zone [m] under the bulk strain `eps_x` of body 2.
    ///
    /// The strain is brought up together with T > 0.
    #[pyo3(signature = (*, eps_x: "float", mu: "float"))]
    fn stick_middle(
        &self,
        #[pyo3(from_py_with = number)] eps_x: f64,
        #[pyo3(from_py_with = number)] mu: f64,
    ) -> Answer<f64> {
        let strain = between("eps_x", eps_x, (-1.0, 1.0));
        strain.and(positive("mu", mu))?;
        Ok(self.line.stick_middle(eps_x, self.E_star, mu))
    }

    /// Shear at `x` [m] under `T` [N/m] with the stick zone around `middle` [m] [Pa].
    ///
    /// Cattaneo's with the middle at 0, Carter's with it at a - c towards the leading edge.
    #[pyo3(signature = (x, *, T: "LineForce", mu: "float", middle: "Length" = 0.0))]
    fn q<'py>(
        &self,
        x: Numbers<'py>,
        #[pyo3(from_py_with = Given::line_T)] T: f64,
        #[pyo3(from_py_with = number)] mu: f64,
        #[pyo3(from_py_with = Given::middle)] middle: f64,
    ) -> Answer<Values<'py>> {
        self.check_middle(T, mu, middle)?;
        Ok(map(&x, |x| self.line.q_shifted(x, middle, T, mu)))
    }

    /// Stress s_xx, s_zz, s_xz at (`x`, `z`) [m] in partial slip [Pa]; arrays are put together.
    ///
    /// The shear is :meth:`q`, with the stick zone around `middle`. A bulk stress adds to s_xx.
    #[pyo3(signature = (x, z, *, T: "LineForce", mu: "float", middle: "Length" = 0.0) -> "list[NDArray[np.float64]]")]
    fn stress<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        z: Numbers<'py>,
        #[pyo3(from_py_with = Given::line_T)] T: f64,
        #[pyo3(from_py_with = number)] mu: f64,
        #[pyo3(from_py_with = Given::middle)] middle: f64,
    ) -> Answer<[Bound<'py, PyArrayDyn<f64>>; 3]> {
        self.check_middle(T, mu, middle)?;
        let far = FAR * self.line.a;
        checked(&z, |z| between("z", z, (0.0, far)))?;
        checked(&x, |x| between("x", x, (-far, far)))?;
        let [x, z] = together([("x", &x), ("z", &z)])?;
        let stress =
            |&x: &f64, &z: &f64| self.line.partial_slip_stress_shifted((x, z), middle, T, mu);
        Ok(rows(py, &Zip::from(&x).and(&z).map_collect(stress)))
    }
}

attributes!(LineContact, self:
    /// Normal force per length [N/m].
    W: f64 = self.line.W;
    /// Half-width [m], a^2 = 4 W R/(pi E*).
    a: f64 = self.line.a;
    /// Peak pressure [Pa].
    p0: f64 = self.line.p0;
    /// Peak pressure [Pa], by the name that it has in results.
    p_H: f64 = self.line.p0;
);

impl LineContact {
    /// Checks that friction carries the force T \[N/m\], to rounding.
    fn check(&self, T: f64, mu: f64) -> Answer<()> {
        let mu = positive("mu", mu)?;
        let limit = mu * self.line.W * (1.0 + 1e-9);
        Ok(between("T", T, (-limit, limit)).map(drop)?)
    }

    /// Checks that the stick zone around `middle` \[m\] lies in the contact.
    fn check_middle(&self, T: f64, mu: f64, middle: f64) -> Answer<()> {
        self.check(T, mu)?;
        between("middle", middle, (-self.line.a, self.line.a))?;
        Ok(())
    }
}
