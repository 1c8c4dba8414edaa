//! Line contact of cylinders, in partial slip, under a bulk stress, in rolling.

use contact_core::reference as core;
use contact_core::reference::domain::{between, positive};
use numpy::{PyArrayDyn, ToPyArray};
use pyo3::prelude::*;

use super::{Numbers, checked, map, pair};
use crate::error::to_python;
use crate::scene::Elastic;

/// Farthest place over the half-width.
const FAR: f64 = 1e30;

/// Hertz, Cattaneo, Carter and McEwen in plane strain.
#[pyclass(frozen, module = "pyfret.reference")]
pub(crate) struct LineContact {
    line: core::LineContact,
    #[pyo3(get)]
    E_star: f64,
}

#[pyfunction]
#[pyo3(signature = (*, R, bodies, W))]
pub(crate) fn line_contact(R: f64, bodies: (Elastic, Elastic), W: f64) -> PyResult<LineContact> {
    let (body1, body2) = pair(bodies)?;
    positive("R", R).and(positive("W", W)).map_err(to_python)?;
    let E_star = core::hertz(R, body1, body2, 1.0).E_star;
    Ok(LineContact {
        line: core::line_contact(R, E_star, W),
        E_star,
    })
}

#[pymethods]
impl LineContact {
    #[getter]
    fn W(&self) -> f64 {
        self.line.W
    }

    #[getter]
    fn a(&self) -> f64 {
        self.line.a
    }

    #[getter]
    fn p0(&self) -> f64 {
        self.line.p0
    }

    fn p<'py>(&self, py: Python<'py>, x: Numbers<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        map(py, &x, |x| self.line.p(x))
    }

    #[pyo3(signature = (*, T, mu))]
    fn stick_half_width(&self, T: f64, mu: f64) -> PyResult<f64> {
        self.check(T, mu)?;
        Ok(self.line.stick_half_width(T, mu))
    }

    #[pyo3(signature = (*, eps_x, mu))]
    fn stick_middle(&self, eps_x: f64, mu: f64) -> PyResult<f64> {
        let strain = between("eps_x", eps_x, (-1.0, 1.0));
        strain.and(positive("mu", mu)).map_err(to_python)?;
        Ok(self.line.stick_middle(eps_x, self.E_star, mu))
    }

    #[pyo3(signature = (x, *, T, mu, middle = 0.0))]
    fn q<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        T: f64,
        mu: f64,
        middle: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.check(T, mu)?;
        between("middle", middle, (-self.line.a, self.line.a)).map_err(to_python)?;
        Ok(map(py, &x, |x| self.line.q_shifted(x, middle, T, mu)))
    }

    #[pyo3(signature = (x, z, *, T, mu))]
    fn stress<'py>(
        &self,
        py: Python<'py>,
        x: Numbers<'py>,
        z: f64,
        T: f64,
        mu: f64,
    ) -> PyResult<[Bound<'py, PyArrayDyn<f64>>; 3]> {
        self.check(T, mu)?;
        let far = FAR * self.line.a;
        between("z", z, (0.0, far)).map_err(to_python)?;
        checked(&x, |x| between("x", x, (-far, far)))?;
        let x = x.as_array();
        let of = |x: f64| self.line.partial_slip_stress((x, z), T, mu);
        Ok([0, 1, 2].map(|row| x.mapv(|x| of(x)[row]).to_pyarray(py)))
    }
}

impl LineContact {
    /// A tangential force that friction carries; rounding is no reason to refuse the largest.
    fn check(&self, T: f64, mu: f64) -> PyResult<()> {
        let mu = positive("mu", mu).map_err(to_python)?;
        let limit = mu * self.line.W * (1.0 + 1e-9);
        between("T", T, (-limit, limit))
            .map(drop)
            .map_err(to_python)
    }
}
