//! The load path, one increment at a time.

use std::collections::HashMap;
use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use contact_core::estimate::choose_increments;
use contact_core::march as core;
use contact_core::scene::PathGrid;
use contact_store::{FIELDS, Kind, SCALARS, group_attributes};
use numpy::PyArray2;
use serde_json::Value;

use crate::error::Answer;
use crate::prelude::*;
use crate::scene::{Grid, Scene};
use crate::variables::Variables;

/// A load path being run through; iterating solves one increment after the other.
///
/// Use :func:`pyfret.march`, which labels what this one gives.
#[pyclass(module = "pyfret")]
pub(crate) struct March {
    /// Python may hand the object to another thread.
    inner: Mutex<core::March>,
    /// The most that the increments came to.
    reached: core::Reached,
    last: Option<core::Increment>,
}

impl March {
    /// The march, which only this object uses.
    fn inner(&mut self) -> &mut core::March {
        self.inner.get_mut().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl March {
    #[new]
    fn new(py: Python<'_>, scene: Scene) -> Answer<Self> {
        scene.0.check_fit()?;
        let march = stoppable(py, |stop| {
            let mut scene = scene.0;
            // The fields of every increment can be read.
            scene.settings.solver.path_grid = PathGrid::Same;
            let mut scene = choose_increments(&scene, stop)?;
            scene.settings.solver.path_grid = PathGrid::Auto;
            core::March::until(&scene, stop)
        })??;
        Ok(Self {
            inner: Mutex::new(march),
            reached: core::Reached::default(),
            last: None,
        })
    }

    /// Increments solved so far.
    #[getter]
    fn done(&mut self) -> usize {
        self.inner().state().increments
    }

    /// The scene that is being solved.
    #[getter]
    fn scene(&mut self) -> Scene {
        Scene(self.inner().scene().clone())
    }

    /// Doubts of the increments so far, one sentence each.
    fn doubts(&mut self) -> Vec<String> {
        let reached = self.reached.clone();
        reached.all_doubts(self.inner().scene())
    }

    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    /// Solve the next increment and give its scalars.
    fn __next__<'py>(&mut self, py: Python<'py>) -> Answer<Option<Bound<'py, PyDict>>> {
        py.check_signals()?;
        let march = self.inner();
        let stop = Arc::<AtomicBool>::default();
        march.stop_on(stop.clone());
        match interruptible(py, &stop, || march.advance())? {
            None => {
                let scene = self.inner().scene().clone();
                self.reached.check(&scene)?;
                Ok(None)
            }
            Some(Err(error)) => Err(error.into()),
            Some(Ok(increment)) => {
                self.reached.see(&increment);
                let scalars = PyDict::new(py);
                let grid = self.inner().scene().grid;
                for scalar in SCALARS.iter().map(|scalar| scalar.for_grid(&grid)) {
                    let value = (scalar.value)(&increment);
                    match scalar.kind {
                        Kind::Real => scalars.set_item(scalar.name, value)?,
                        _ => scalars.set_item(scalar.name, value as i64)?,
                    }
                }
                self.last = Some(increment);
                Ok(Some(scalars))
            }
        }
    }

    /// The last increment as variables: dimensions, values, attributes as xarray takes them.
    #[pyo3(signature = () -> "dict[str, Variable]")]
    fn variables<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let variables = Variables::new(py);
        let last = self.last;
        let march = self.inner();
        let grid = march.scene().grid;
        if let Some(increment) = &last {
            variables.increment(increment, &grid)?;
        }
        variables.cells(&grid)?;
        variables.fields(march.state().increments, &march.fields())?;
        Ok(variables.finish())
    }

    /// The attributes of the result, as JSON.
    #[getter]
    fn attributes(&mut self) -> String {
        let march = self.inner();
        Value::Object(group_attributes(march.scene(), march.plan())).to_string()
    }
}

/// Pressure [Pa], that at the rim continued from inside; use :meth:`Snapshot.p_continued`.
#[pyfunction]
#[pyo3(signature = (p, grid) -> "NDArray[np.float64]")]
pub(crate) fn continued_pressure<'py>(
    py: Python<'py>,
    p: Field<'py>,
    grid: Grid,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (p, shape) = (p.as_array(), (grid.0.nx, grid.0.ny));
    if p.dim() != shape {
        refuse!("p: must be of the grid's shape {shape:?}");
    }
    Ok(contact_core::zones::continue_pressure_to_rim(&p.to_owned(), &grid.0).into_pyarray(py))
}

/// Units and meaning of every variable of a result, scalars and fields.
#[pyfunction]
pub(crate) fn labels() -> HashMap<&'static str, (&'static str, &'static str)> {
    let scalars = SCALARS.iter().map(|s| (s.name, (s.units, s.long_name)));
    let fields = FIELDS.iter().map(|f| (f.name, (f.units, f.long_name)));
    scalars.chain(fields).collect()
}
