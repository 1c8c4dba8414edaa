//! The cycle of a contact that an object of Python gives, moment by moment.

use std::sync::Mutex;

use contact_core::Error;
use contact_core::scene::Grid;
use contact_subsurface::{Moments, OverCycle, Yielding};

use crate::prelude::*;
use crate::states::States;

/// The moments of a cycle that an object of Python gives.
pub(super) struct Given {
    /// Called with the numbers of moments, or with none for the start of the cycle.
    give: Py<PyAny>,
    count: usize,
    grid: Grid,
    /// Plastic work of the cycle, and that beside which it is small [J].
    yielding: Option<(f64, f64)>,
    /// Error of the shear by the increments.
    path_error: Option<f64>,
    /// What Python raised.
    raised: Mutex<Option<PyErr>>,
}

impl Given {
    pub(super) fn new(give: Py<PyAny>, count: usize, grid: &Grid) -> Self {
        Self {
            give,
            count,
            grid: *grid,
            yielding: None,
            path_error: None,
            raised: Mutex::new(None),
        }
    }

    /// With what yields in it.
    pub(super) fn yields(self, yielding: Option<(f64, f64)>) -> Self {
        Self { yielding, ..self }
    }

    /// With the error of the shear by the increments.
    pub(super) fn known_to(self, path_error: Option<f64>) -> Self {
        Self { path_error, ..self }
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
        let states: PyRef<'_, States> = given.extract(py)?;
        Ok(Some(states.on(&self.grid)?.clone()))
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

    fn path_error(&self) -> Option<f64> {
        self.path_error
    }

    fn yielding(&self) -> Result<Option<Yielding>, Error> {
        let of = |(plastic, beside)| Yielding { plastic, beside };
        Ok(self.yielding.map(of))
    }
}
