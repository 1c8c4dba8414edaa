//! Stress below a sphere that presses and slides.

use contact_reference as core;
use contact_reference::domain::{between, positive};
use numpy::{PyArrayDyn, ToPyArray};
use pyo3::prelude::*;

use super::{Numbers, checked};
use crate::argument::to_python;
use crate::arguments::number;
use crate::parts::made;

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
    #[pyo3(signature = (*, a: "float", nu: "float"))]
    fn new(
        #[pyo3(from_py_with = number)] a: f64,
        #[pyo3(from_py_with = number)] nu: f64,
    ) -> PyResult<Self> {
        positive("a", a)
            .and(between("nu", nu, (-1.0, 0.5)))
            .map_err(to_python)?;
        Ok(Self(core::HertzStress { a, nu }))
    }

    /// Radius of the loaded circle [m].
    #[getter]
    fn a(&self) -> f64 {
        self.0.a
    }

    /// Poisson's ratio.
    #[getter]
    fn nu(&self) -> f64 {
        self.0.nu
    }

    /// Stress s_xx, s_yy, s_zz, s_xy, s_xz, s_yz at (`x`, `y`, `z`) [m] under a pressure.
    #[pyo3(signature = (x, y: "float", z: "float") -> "list[NDArray[np.float64]]")]
    fn pressure<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        #[pyo3(from_py_with = number)] y: f64,
        #[pyo3(from_py_with = number)] z: f64,
    ) -> PyResult<[Bound<'py, PyArrayDyn<f64>>; 6]> {
        self.check(&x, y, z)?;
        let x = x.as_array();
        let row = |row: usize| x.mapv(|x| self.0.pressure(x, y, z)[row]).to_pyarray(py);
        Ok(std::array::from_fn(row))
    }

    /// The same under a shear traction that acts on the body along +x.
    #[pyo3(signature = (x, y: "float", z: "float") -> "list[NDArray[np.float64]]")]
    fn shear<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        #[pyo3(from_py_with = number)] y: f64,
        #[pyo3(from_py_with = number)] z: f64,
    ) -> PyResult<[Bound<'py, PyArrayDyn<f64>>; 6]> {
        self.check(&x, y, z)?;
        let x = x.as_array();
        let row = |row: usize| x.mapv(|x| self.0.shear(x, y, z)[row]).to_pyarray(py);
        Ok(std::array::from_fn(row))
    }
}

impl HertzStress {
    /// Places in the body, not so far away that the stress is lost in rounding.
    fn check(&self, x: &Numbers<'_>, y: f64, z: f64) -> PyResult<()> {
        let far = FAR * self.0.a;
        between("y", y, (-far, far)).map_err(to_python)?;
        between("z", z, (0.0, far)).map_err(to_python)?;
        checked(x, |x| between("x", x, (-far, far)))
    }
}
