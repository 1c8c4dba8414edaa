//! The cycle of a contact that an object of Python gives, moment by moment.

use std::sync::Mutex;

use contact_core::Error;
use contact_core::scene::Grid;
use contact_subsurface::{Moments, OverCycle, Yielding};
use ndarray::Ix2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::{Array, List, Mask};
use crate::yielding::{Eigenstress, of_states};

/// Fields of several moments.
type Fields<'py> = List<Array<'py, Ix2>>;
type Sticking<'py> = List<Mask<'py, Ix2>>;
/// q_x, q_y, p, where it sticks, bulk stress, and the stress of what has yielded.
type GivenMoments<'py> = (
    Fields<'py>,
    Fields<'py>,
    Fields<'py>,
    Sticking<'py>,
    Vec<f64>,
    List<Option<Py<Eigenstress>>>,
);
/// The moments of a cycle that an object of Python gives: fields of shape (nx, ny) of each and bulk stresses.
pub(super) struct Given {
    /// Called with the numbers of moments, or with none for the start of the cycle.
    give: Py<PyAny>,
    count: usize,
    shape: (usize, usize),
    /// Plastic work of the cycle, and that beside which it is small [J].
    yielding: Option<(f64, f64)>,
    /// What Python raised.
    raised: Mutex<Option<PyErr>>,
}

impl Given {
    pub(super) fn new(give: Py<PyAny>, count: usize, grid: &Grid) -> Self {
        Self {
            give,
            count,
            shape: (grid.nx, grid.ny),
            yielding: None,
            raised: Mutex::new(None),
        }
    }

    /// With what yields in it.
    pub(super) fn yields(self, yielding: Option<(f64, f64)>) -> Self {
        Self { yielding, ..self }
    }

    /// What Python raised, once.
    pub(super) fn taken(&self) -> Option<PyErr> {
        self.raised.lock().ok().and_then(|mut raised| raised.take())
    }

    fn ask(&self, which: Option<&[usize]>) -> Result<Option<Moments>, Error> {
        Python::attach(|py| self.asked(py, which)).map_err(|error| {
            if let Ok(mut raised) = self.raised.lock() {
                *raised = Some(error);
            }
            Error::Interrupted { increment: 0 }
        })
    }

    fn asked(&self, py: Python<'_>, which: Option<&[usize]>) -> PyResult<Option<Moments>> {
        let given = self.give.call1(py, (which.map(<[usize]>::to_vec),))?;
        if given.is_none(py) {
            return Ok(None);
        }
        let (q_x, q_y, p, stick, sigma_B, eigenstress): GivenMoments<'_> = given.extract(py)?;
        let lengths = [q_x.len(), q_y.len(), p.len(), stick.len(), sigma_B.len()];
        let shapes = q_x
            .iter()
            .chain(q_y.iter())
            .chain(p.iter())
            .map(|f| f.as_array().dim());
        let mut shapes = shapes.chain(stick.iter().map(|f| f.as_array().dim()));
        if lengths.iter().any(|n| *n != lengths[0]) || shapes.any(|found| found != self.shape) {
            return Err(PyValueError::new_err(format!(
                "fields of a cycle: must be as many of each, of the shape of the grid, {:?}",
                self.shape
            )));
        }
        let own = |f: &Array<'_, Ix2>| f.as_array().as_standard_layout().into_owned();
        let tractions = (0..p.len()).map(|n| [own(&q_x[n]), own(&q_y[n]), own(&p[n])]);
        Ok(Some(Moments {
            tractions: tractions.collect(),
            stick: stick
                .iter()
                .map(|f| f.as_array().as_standard_layout().into_owned())
                .collect(),
            sigma_B,
            eigenstress: of_states(Some(eigenstress)),
        }))
    }
}

impl OverCycle for Given {
    fn count(&self) -> usize {
        self.count
    }

    fn moments(&self, which: &[usize]) -> Result<Moments, Error> {
        let allowed = "the moments asked for";
        self.ask(Some(which))?
            .filter(|moments| moments.sigma_B.len() == which.len())
            .ok_or_else(|| Error::invalid("fields of a cycle", "others", allowed))
    }

    fn start(&self) -> Result<Option<Moments>, Error> {
        self.ask(None)
    }

    fn yielding(&self) -> Result<Option<Yielding>, Error> {
        let of = |(plastic, beside)| Yielding { plastic, beside };
        Ok(self.yielding.map(of))
    }
}
