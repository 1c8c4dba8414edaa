//! Stress below a sphere that presses and slides.

use contact_core::reference as core;
use numpy::{PyArrayDyn, ToPyArray};
use pyo3::prelude::*;

use super::Numbers;

/// A half-space under Hertz's distribution, as pressure or as shear.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct HertzStress(core::HertzStress);

#[pymethods]
impl HertzStress {
    #[new]
    #[pyo3(signature = (*, a, nu))]
    fn new(a: f64, nu: f64) -> Self {
        Self(core::HertzStress { a, nu })
    }

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
