//! The cycle of a contact that an object of Python gives, moment by moment.

use std::sync::Mutex;

use contact_core::Error;
use contact_core::scene::Grid;
use contact_subsurface::{CycleSource, Moments, Yielding};

use crate::prelude::*;
use crate::states::States;

/// The moments of a cycle that an object of Python gives.
pub(super) struct PythonCycle {
    /// Called with the numbers of moments, or with none for the start of the cycle.
    fetch: Py<PyAny>,
    count: usize,
    grid: Grid,
    /// Plastic work of the cycle, and the work beside which it is small [J].
    yielding: Option<(f64, f64)>,
    /// Error of the shear by the increments.
    path_error: Option<f64>,
    /// Exception of Python.
    raised: Mutex<Option<PyErr>>,
}

impl PythonCycle {
    /// A cycle of `count` moments that the function `fetch` returns.
    pub(super) fn new(fetch: Py<PyAny>, count: usize, grid: &Grid) -> Self {
        Self {
            fetch,
            count,
            grid: *grid,
            yielding: None,
            path_error: None,
            raised: Mutex::new(None),
        }
    }

    /// Adds the plastic work.
    pub(super) fn with_plastic_work(self, yielding: Option<(f64, f64)>) -> Self {
        Self { yielding, ..self }
    }

    /// Adds the error of the shear from the increments.
    pub(super) fn with_path_error(self, path_error: Option<f64>) -> Self {
        Self { path_error, ..self }
    }

    /// Takes the exception of Python, once.
    pub(super) fn take_error(&self) -> Option<PyErr> {
        self.raised.lock().ok().and_then(|mut raised| raised.take())
    }

    /// Calls Python for moments; its exception is kept, and ends the work.
    fn take_moments(&self, which: Option<&[usize]>) -> Result<Option<Moments>, Error> {
        Python::attach(|py| self.fetch_moments(py, which)).map_err(|error| {
            if let Ok(mut raised) = self.raised.lock() {
                *raised = Some(error);
            }
            Error::Interrupted { increment: 0 }
        })
    }

    /// Calls the function of Python: with numbers of moments, or with None for the moment before the cycle.
    fn fetch_moments(&self, py: Python<'_>, which: Option<&[usize]>) -> PyResult<Option<Moments>> {
        let states = self.fetch.call1(py, (which.map(<[usize]>::to_vec),))?;
        if states.is_none(py) {
            return Ok(None);
        }
        let states: PyRef<'_, States> = states.extract(py)?;
        Ok(Some(states.moments_on(&self.grid)?.clone()))
    }
}

impl CycleSource for PythonCycle {
    /// Number of moments of the cycle.
    fn count(&self) -> usize {
        self.count
    }

    /// The moments with these numbers, from Python.
    fn moments(&self, which: &[usize]) -> Result<Moments, Error> {
        let allowed = "the moments asked for";
        self.take_moments(Some(which))?
            .filter(|moments| moments.sigma_B.len() == which.len())
            .ok_or_else(|| Error::invalid("fields of a cycle", "others", allowed))
    }

    /// The moment before the cycle, if Python has it.
    fn start(&self) -> Result<Option<Moments>, Error> {
        self.take_moments(None)
    }

    /// The error of the shear by the increments, if it is known.
    fn path_error(&self) -> Option<f64> {
        self.path_error
    }

    /// Plastic work in the cycle and beside it; none if the body stays elastic.
    fn yielding(&self) -> Result<Option<Yielding>, Error> {
        let to_yielding = |(plastic, beside)| Yielding { plastic, beside };
        Ok(self.yielding.map(to_yielding))
    }
}
