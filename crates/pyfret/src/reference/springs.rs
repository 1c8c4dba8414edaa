//! The one-dimensional springs that answer every path of W and T.

use contact_core::reference as core;
use pyo3::prelude::*;

use super::Hertz;
use crate::scene::Material;

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
}

#[pymethods]
impl Springs {
    #[new]
    #[pyo3(signature = (largest, *, R, bodies, mu, n = 1500))]
    fn new(largest: Hertz, R: f64, bodies: (Material, Material), mu: f64, n: usize) -> Self {
        Self {
            springs: core::Springs::new(largest.0, R, bodies.0.0, bodies.1.0, mu, n),
            at: (0.0, 0.0),
        }
    }

    /// Go straight to the forces `W`, `T` [N] in `steps` steps; the shift delta_x [m].
    #[pyo3(signature = (*, W, T, steps = 10))]
    fn load(&mut self, W: f64, T: f64, steps: usize) -> f64 {
        let from = std::mem::replace(&mut self.at, (W, T));
        self.springs.load(from, self.at, steps)
    }
}
