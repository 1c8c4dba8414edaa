//! Line contact of cylinders, in partial slip, under a bulk stress, in rolling.

use contact_core::reference as core;
use numpy::{PyArrayDyn, ToPyArray};
use pyo3::prelude::*;

use super::{Numbers, map};
use crate::scene::Material;

/// Cylinders in plane strain: Hertz, Cattaneo, Carter, McEwen; from `line_contact`.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct LineContact {
    line: core::LineContact,
    /// Contact modulus [Pa].
    #[pyo3(get)]
    E_star: f64,
}

/// Line contact of cylinders of relative radius `R` [m] under `W` [N/m].
#[pyfunction]
#[pyo3(signature = (*, R, bodies, W))]
pub(crate) fn line_contact(R: f64, bodies: (Material, Material), W: f64) -> LineContact {
    let E_star = core::hertz(R, bodies.0.0, bodies.1.0, 1.0).E_star;
    LineContact {
        line: core::line_contact(R, E_star, W),
        E_star,
    }
}

#[pymethods]
impl LineContact {
    /// Normal force per length [N/m].
    #[getter]
    fn W(&self) -> f64 {
        self.line.W
    }

    /// Half-width [m], a^2 = 4 W R/(pi E*).
    #[getter]
    fn a(&self) -> f64 {
        self.line.a
    }

    /// Peak pressure [Pa].
    #[getter]
    fn p0(&self) -> f64 {
        self.line.p0
    }

    /// Pressure at `x` [m] [Pa].
    fn p<'py>(&self, py: Python<'py>, x: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &x, |x| self.line.p(x))
    }

    /// Half-width of the stick zone under `T` [N/m] [m].
    #[pyo3(signature = (*, T, mu))]
    fn stick_half_width(&self, T: f64, mu: f64) -> f64 {
        self.line.stick_half_width(T, mu)
    }

    /// Middle of the stick zone [m] under the bulk strain `eps_x` of body 2.
    ///
    /// The strain is brought up together with T > 0.
    #[pyo3(signature = (*, eps_x, mu))]
    fn stick_middle(&self, eps_x: f64, mu: f64) -> f64 {
        self.line.stick_middle(eps_x, self.E_star, mu)
    }

    /// Shear at `x` [m] under `T` [N/m] with the stick zone around `middle` [m] [Pa].
    ///
    /// Cattaneo's with the middle at 0, Carter's with it at a - c towards the leading edge.
    #[pyo3(signature = (x, *, T, mu, middle = 0.0))]
    fn q<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        T: f64,
        mu: f64,
        middle: f64,
    ) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &x, |x| self.line.q_shifted(x, middle, T, mu))
    }

    /// Stress s_xx, s_zz, s_xz at (`x`, `z`) [m] in partial slip [Pa].
    #[pyo3(signature = (x, z, *, T, mu))]
    fn stress<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        z: f64,
        T: f64,
        mu: f64,
    ) -> [Bound<'py, PyArrayDyn<f64>>; 3] {
        let x = x.as_array();
        let of = |x: f64| self.line.partial_slip_stress((x, z), T, mu);
        [0, 1, 2].map(|row| x.mapv(|x| of(x)[row]).to_pyarray(py))
    }
}
