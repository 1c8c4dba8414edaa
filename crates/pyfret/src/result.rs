//! A run from its scene, or from what an earlier one left, to its store, watched from Python.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use contact_core::Error;
use contact_core::estimate::{BranchEnds, choose_increments, coarsest, error_bars};
use contact_core::march::{Increment, March, Observer};
use contact_core::output::{self, Resumed, StoreWriter};
use pyo3::prelude::*;

use crate::error::to_python;
use crate::interruptible::interruptible;
use crate::scene::Scene;

/// Writes the store, tells Python how far the run is, and lets it stop the run.
struct Watch {
    writer: StoreWriter,
    on_increment: Option<Py<PyAny>>,
    stop: Arc<AtomicBool>,
    /// What `on_increment` raised.
    raised: Option<PyErr>,
}

impl Observer for Watch {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        self.writer.on_increment(march, increment)?;
        let Some(call) = &self.on_increment else {
            return Ok(());
        };
        let of = march.scene().path.increments();
        let told = Python::attach(|py| call.call1(py, (increment.index, of)).map(drop));
        told.map_err(|raised| {
            self.raised = Some(raised);
            Error::Interrupted {
                increment: increment.index,
            }
        })
    }

    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.writer.on_end(march, failure)
    }

    fn stop(&self) -> Option<Arc<AtomicBool>> {
        Some(self.stop.clone())
    }
}

/// Seconds between two checkpoints.
fn interval(checkpoint: f64) -> PyResult<Duration> {
    Duration::try_from_secs_f64(checkpoint).map_err(|_| {
        let allowed = "a number of seconds >= 0";
        to_python(Error::invalid("checkpoint", checkpoint, allowed))
    })
}

fn watched(
    py: Python<'_>,
    writer: StoreWriter,
    on_increment: Option<Py<PyAny>>,
    run: impl FnOnce(&mut dyn Observer) -> Result<Vec<Increment>, Error> + Send,
) -> PyResult<()> {
    let stop = Arc::<AtomicBool>::default();
    let mut watch = Watch {
        writer,
        on_increment,
        stop: stop.clone(),
        raised: None,
    };
    let outcome = interruptible(py, &stop, || run(&mut watch))?;
    match watch.raised {
        Some(raised) => Err(raised),
        None => outcome.map(drop).map_err(to_python),
    }
}

/// Run a scene into a new result store; use :func:`pyfret.solve`, which opens it.
///
/// `on_increment` is called with the number of each increment solved and their number in all,
/// which is known once they are chosen.
#[pyfunction]
#[pyo3(signature = (scene, *, store, checkpoint = 5.0, error = false, on_increment = None))]
pub(crate) fn solve(
    py: Python<'_>,
    scene: Scene,
    store: PathBuf,
    checkpoint: f64,
    error: bool,
    on_increment: Option<Py<PyAny>>,
) -> PyResult<()> {
    scene.0.check_fit().map_err(to_python)?;
    if error {
        coarsest(&scene.0).map_err(to_python)?;
    }
    let writer = StoreWriter::create(&store, false)
        .map_err(to_python)?
        .with_interval(interval(checkpoint)?);
    watched(py, writer, on_increment, |watch| {
        let stop = watch.stop().unwrap_or_default();
        let mut ends = BranchEnds::beside(watch);
        let scene = &choose_increments(&scene.0, &stop)?;
        let increments = contact_core::march::solve(scene, &mut ends)?;
        if error {
            match error_bars(scene, &increments, &ends.tractions, &stop) {
                Ok(bars) => output::write_error_bars(&store, &bars)?,
                Err(stopped @ Error::Interrupted { .. }) => return Err(stopped),
                Err(why) => drop(output::write_no_error_bars(&store, &why)?),
            }
        }
        Ok(increments)
    })
}

/// Checks a store and gives the attributes of its group as JSON.
#[pyfunction]
pub(crate) fn verify(py: Python<'_>, store: PathBuf) -> PyResult<String> {
    let store = interruptible(py, &Arc::default(), || output::Store::open_whole(store))?;
    Ok(store.map_err(to_python)?.attributes().to_string())
}

/// Go on with the run of a store that ended early; use :func:`pyfret.resume`, which opens it.
#[pyfunction]
#[pyo3(signature = (store, *, checkpoint = 5.0, on_increment = None))]
pub(crate) fn resume(
    py: Python<'_>,
    store: PathBuf,
    checkpoint: f64,
    on_increment: Option<Py<PyAny>>,
) -> PyResult<()> {
    let (interval, stop) = (interval(checkpoint)?, Arc::default());
    let Some(Resumed {
        march,
        writer,
        increments,
    }) = interruptible(py, &stop, || output::resume(store, Some(&stop)))?.map_err(to_python)?
    else {
        return Ok(());
    };
    let writer = writer.with_interval(interval);
    watched(py, writer, on_increment, |watch| {
        march.run(increments, watch)
    })
}
