//! A run from its scene to its store, watched from Python.

use std::path::PathBuf;

use contact_core::Error;
use contact_core::march::{Increment, March, Observer};
use contact_core::output::StoreWriter;
use pyo3::prelude::*;

use crate::error::to_python;
use crate::scene::Scene;

/// Lets Python see the progress and stop the run, by Ctrl-C or an exception.
struct Watch {
    on_increment: Option<Py<PyAny>>,
    writer: StoreWriter,
    /// What Python raised.
    raised: Option<PyErr>,
}

impl Observer for Watch {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        self.writer.on_increment(march, increment)?;
        let seen = Python::attach(|py| {
            py.check_signals()?;
            match &self.on_increment {
                Some(call) => call.call1(py, (increment.index,)).map(drop),
                None => Ok(()),
            }
        });
        seen.map_err(|raised| {
            self.raised = Some(raised);
            Error::Interrupted {
                increment: increment.index,
            }
        })
    }

    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.writer.on_end(march, failure)
    }
}

/// Runs a scene into a new result store; other Python threads go on meanwhile.
#[pyfunction]
#[pyo3(signature = (scene, *, store, on_increment = None))]
pub(crate) fn solve(
    py: Python<'_>,
    scene: Scene,
    store: PathBuf,
    on_increment: Option<Py<PyAny>>,
) -> PyResult<()> {
    let mut watch = Watch {
        on_increment,
        writer: StoreWriter::create(store, false).map_err(to_python)?,
        raised: None,
    };
    let outcome = py.detach(|| contact_core::march::solve(&scene.0, &mut watch));
    match (watch.raised, outcome) {
        (Some(raised), _) => Err(raised),
        (None, Err(error)) => Err(to_python(error)),
        (None, Ok(_)) => Ok(()),
    }
}
