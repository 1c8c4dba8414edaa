//! Stress below a sphere that presses and slides.

use contact_reference as core;
use contact_reference::domain::{between, positive};
use ndarray::{ArrayD, Zip};
use numpy::PyArrayDyn;

use super::{Numbers, checked, rows, together};
use crate::argument::Answer;
use crate::prelude::*;

/// Farthest place over the radius of the loaded circle.
const FAR: f64 = 1e30;

/// A half-space under sqrt(1 - r^2/a^2) of unit peak on r < a: Hamilton's stresses.
///
/// Parameters
/// ----------
/// a : float
///     Radius of the loaded circle [m].
/// nu : float
///     Poisson's ratio.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct HertzStress(core::HertzStress);

made!(HertzStress by "HertzStress": a, nu);

#[pymethods]
impl HertzStress {
    #[new]
    #[pyo3(signature = (*, a: "Length", nu: "float"))]
    fn new(
        #[pyo3(from_py_with = Given::radius)] a: f64,
        #[pyo3(from_py_with = number)] nu: f64,
    ) -> Answer<Self> {
        positive("a", a).and(between("nu", nu, (-1.0, 0.5)))?;
        Ok(Self(core::HertzStress { a, nu }))
    }

    /// Stress s_xx, s_yy, s_zz, s_xy, s_xz, s_yz at (`x`, `y`, `z`) [m] under a pressure.
    ///
    /// Numbers, or arrays that are put together as numpy does.
    #[pyo3(signature = (x, y, z) -> "list[NDArray[np.float64]]")]
    fn pressure<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        y: Numbers<'py>,
        z: Numbers<'py>,
    ) -> Answer<[Bound<'py, PyArrayDyn<f64>>; 6]> {
        let pressure = |&x: &f64, &y: &f64, &z: &f64| self.0.pressure(x, y, z);
        let [x, y, z] = self.places(&x, &y, &z)?;
        Ok(rows(
            py,
            &Zip::from(&x).and(&y).and(&z).map_collect(pressure),
        ))
    }

    /// Stress under a shear traction that acts on the body along +x.
    #[pyo3(signature = (x, y, z) -> "list[NDArray[np.float64]]")]
    fn shear<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        y: Numbers<'py>,
        z: Numbers<'py>,
    ) -> Answer<[Bound<'py, PyArrayDyn<f64>>; 6]> {
        let shear = |&x: &f64, &y: &f64, &z: &f64| self.0.shear(x, y, z);
        let [x, y, z] = self.places(&x, &y, &z)?;
        Ok(rows(py, &Zip::from(&x).and(&y).and(&z).map_collect(shear)))
    }
}

attributes!(HertzStress, self:
    /// Radius of the loaded circle [m].
    a: f64 = self.0.a;
    /// Poisson's ratio.
    nu: f64 = self.0.nu;
);

impl HertzStress {
    /// Broadcasts x, y, z; fails outside the body, and so far away that rounding would hide the stress.
    fn places(
        &self,
        x: &Numbers<'_>,
        y: &Numbers<'_>,
        z: &Numbers<'_>,
    ) -> Answer<[ArrayD<f64>; 3]> {
        let far = FAR * self.0.a;
        for (name, of) in [("x", x), ("y", y)] {
            checked(of, |of| between(name, of, (-far, far)))?;
        }
        checked(z, |z| between("z", z, (0.0, far)))?;
        together([("x", x), ("y", y), ("z", z)])
    }
}
