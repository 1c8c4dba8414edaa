//! Stress below a sphere that presses and slides.

use contact_core::reference as core;
use numpy::{PyArrayDyn, ToPyArray};
use pyo3::prelude::*;

use super::Numbers;

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

#[pymethods]
impl HertzStress {
    #[new]
    #[pyo3(signature = (*, a, nu))]
    fn new(a: f64, nu: f64) -> Self {
        Self(core::HertzStress { a, nu })
    }

    /// Stress s_xx, s_yy, s_zz, s_xy, s_xz, s_yz at (`x`, `y`, `z`) [m] under a pressure.
    fn pressure<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        y: f64,
        z: f64,
    ) -> [Bound<'py, PyArrayDyn<f64>>; 6] {
        let x = x.as_array();
        std::array::from_fn(|row| x.mapv(|x| self.0.pressure(x, y, z)[row]).to_pyarray(py))
    }

    /// The same under a shear traction that acts on the body along +x.
    fn shear<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        y: f64,
        z: f64,
    ) -> [Bound<'py, PyArrayDyn<f64>>; 6] {
        let x = x.as_array();
        std::array::from_fn(|row| x.mapv(|x| self.0.shear(x, y, z)[row]).to_pyarray(py))
    }
}
