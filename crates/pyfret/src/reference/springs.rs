//! The one-dimensional springs that answer every path of W and T.

use contact_reference as core;
use contact_reference::domain::{between, count, positive};

use super::{Curved, Hertz, pair_of};
use crate::argument::Answer;
use crate::material::{Elastic, Material};
use crate::prelude::*;

/// Most springs, and most steps of a load.
const MOST_SPRINGS: usize = 10_000;

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
/// loads : list of (float, float, int)
///     Loads to go through at once: W and T [N], and the steps of :meth:`load`.
#[pyclass(module = "pyfret.reference")]
pub(crate) struct Springs {
    springs: core::Springs,
    /// The contact under the largest force that there are springs for.
    #[pyo3(get)]
    largest: Hertz,
    /// Radius [m].
    #[pyo3(get)]
    R: f64,
    /// Materials of body 1 and body 2.
    #[pyo3(get)]
    bodies: (Elastic, Elastic),
    /// Friction coefficient.
    #[pyo3(get)]
    mu: f64,
    /// Springs on either side.
    #[pyo3(get)]
    n: usize,
    /// The loads gone through: W and T [N] at the end of each, and its steps.
    #[pyo3(get)]
    loads: Vec<(f64, f64, usize)>,
}

made!(changing Springs by "Springs": largest, R, bodies, mu, n, loads);

#[pymethods]
impl Springs {
    #[new]
    #[pyo3(signature = (largest, *, R: "Radius", bodies, mu: "float", n: "int" = 1500, loads: "Sequence[tuple[float, float, int]]" = List::default()))]
    fn new(
        largest: Hertz,
        #[pyo3(from_py_with = Given::R)] R: f64,
        bodies: (Material, Material),
        #[pyo3(from_py_with = number)] mu: f64,
        #[pyo3(from_py_with = number)] n: usize,
        loads: List<(f64, f64, usize)>,
    ) -> Answer<Self> {
        positive("R", R).and(positive("mu", mu))?;
        let (body1, body2) = pair_of(Curved::Sphere(R), bodies)?;
        count("n", n, MOST_SPRINGS)?;
        let mut springs = Self {
            springs: core::Springs::new(largest.0, R, body1, body2, mu, n),
            largest,
            R,
            bodies: (Elastic(body1, None), Elastic(body2, None)),
            mu,
            n,
            loads: Vec::new(),
        };
        for (W, T, steps) in loads {
            springs.load(W, T, steps)?;
        }
        Ok(springs)
    }

    /// Go straight to the forces `W`, `T` [N] in `steps` steps; the shift delta_x [m].
    #[pyo3(signature = (*, W: "PointForce", T: "PointForce", steps: "int" = 10))]
    fn load(
        &mut self,
        #[pyo3(from_py_with = Given::point_W)] W: f64,
        #[pyo3(from_py_with = Given::point_T)] T: f64,
        #[pyo3(from_py_with = number)] steps: usize,
    ) -> Answer<f64> {
        // Rounding is no reason to refuse the largest forces.
        let limit_rounded = |limit: f64| limit * (1.0 + 1e-9);
        between("W", W, (0.0, limit_rounded(self.largest.0.W)))?;
        let limit = limit_rounded(self.mu * W);
        between("T", T, (-limit, limit))?;
        count("steps", steps, MOST_SPRINGS)?;
        let from = self.loads.last().map_or((0.0, 0.0), |(W, T, _)| (*W, *T));
        self.loads.push((W, T, steps));
        Ok(self.springs.load(from, (W, T), steps))
    }
}
