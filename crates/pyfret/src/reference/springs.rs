//! The one-dimensional springs that answer every path of W and T.

use contact_core::reference as core;
use contact_core::reference::domain::{between, count, positive};
use pyo3::prelude::*;

use super::{Hertz, pair};
use crate::error::to_python;
use crate::material::Material;

/// Most springs, and most steps of a load.
const MOST: usize = 10_000;

/// One-dimensional springs with friction: the shift for every path of W and T.
///
/// Exact for a sphere on a flat of like bodies with nu = 0 (method of dimensionality reduction).
///
/// Parameters
/// ----------
/// largest : Hertz
///     The contact under the largest force of the path.
/// R : float
///     Radius [m].
/// bodies : tuple of Elastic
///     Materials of body 1 and body 2.
/// mu : float
///     Friction coefficient.
/// n : int
///     Springs on either side.
#[pyclass(module = "pyfret.reference")]
pub(crate) struct Springs {
    springs: core::Springs,
    at: (f64, f64),
    /// Largest normal force that there are springs for.
    largest: f64,
    mu: f64,
}

#[pymethods]
impl Springs {
    #[new]
    #[pyo3(signature = (largest, *, R, bodies, mu, n = 1500))]
    fn new(
        largest: Hertz,
        R: f64,
        bodies: (Material, Material),
        mu: f64,
        n: usize,
    ) -> PyResult<Self> {
        let (body1, body2) = pair(bodies)?;
        positive("R", R)
            .and(positive("mu", mu))
            .map_err(to_python)?;
        count("n", n, MOST).map_err(to_python)?;
        Ok(Self {
            springs: core::Springs::new(largest.0, R, body1, body2, mu, n),
            at: (0.0, 0.0),
            largest: largest.0.W,
            mu,
        })
    }

    /// Go straight to the forces `W`, `T` [N] in `steps` steps; the shift delta_x [m].
    #[pyo3(signature = (*, W, T, steps = 10))]
    fn load(&mut self, W: f64, T: f64, steps: usize) -> PyResult<f64> {
        // Rounding is no reason to refuse the largest forces.
        let most = |limit: f64| limit * (1.0 + 1e-9);
        between("W", W, (0.0, most(self.largest))).map_err(to_python)?;
        let limit = most(self.mu * W);
        between("T", T, (-limit, limit)).map_err(to_python)?;
        count("steps", steps, MOST).map_err(to_python)?;
        let from = std::mem::replace(&mut self.at, (W, T));
        Ok(self.springs.load(from, self.at, steps))
    }
}
