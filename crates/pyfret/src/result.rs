//! A run from its scene, or from what an earlier one left, to memory or its store, watched from
//! Python.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use contact_core::Error;
use contact_core::estimate::{
    BranchEnds, ErrorBars, ErrorMethod, choose_increments, choose_increments_like, error_bars,
};
use contact_core::march::{Increment, March, Observer};
use contact_store::{Columns, Resumed, StoreWriter};
use pyo3::type_hint_union;
use serde_json::Value;

use crate::error::{Answer, to_python};
use crate::hints;
use crate::prelude::*;
use crate::scene::Scene;
use crate::scene::friction_law::own_law;
use crate::variables::Variables;

/// Keeps the run, reports its progress to Python, and lets Python stop the run.
struct Watch<K> {
    keeper: K,
    on_increment: Option<Py<PyAny>>,
    stop: Arc<AtomicBool>,
    /// Exception of `on_increment`.
    raised: Option<PyErr>,
}

impl<K: Observer> Observer for Watch<K> {
    /// Passes the increment to the keeper, then calls the user's function; its exception ends the run.
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        self.keeper.on_increment(march, increment)?;
        let Some(call) = &self.on_increment else {
            return Ok(());
        };
        let total = march.scene().path.increments();
        let answer = Python::attach(|py| call.call1(py, (increment.index, total)).map(drop));
        answer.map_err(|raised| {
            self.raised = Some(raised);
            Error::Interrupted {
                increment: increment.index,
            }
        })
    }

    /// Passes the end of the run to the keeper.
    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.keeper.on_end(march, failure)
    }

    /// The flag that ends the run.
    fn stop(&self) -> Option<Arc<AtomicBool>> {
        Some(self.stop.clone())
    }
}

/// Time between two checkpoints from seconds; fails if negative or NaN.
fn interval(checkpoint: f64) -> PyResult<Duration> {
    Duration::try_from_secs_f64(checkpoint).map_err(|_| {
        let allowed = "a number of seconds >= 0";
        to_python(Error::invalid("checkpoint", checkpoint, allowed))
    })
}

/// Does `run` with an observer that keeps results and calls `on_increment`; returns the keeper and the result.
fn watched<K: Observer + Send, T: Send>(
    py: Python<'_>,
    keeper: K,
    on_increment: Option<Py<PyAny>>,
    run: impl FnOnce(&mut dyn Observer) -> Result<T, Error> + Send,
) -> Answer<(K, T)> {
    let stop = Arc::<AtomicBool>::default();
    let mut watch = Watch {
        keeper,
        on_increment,
        stop: stop.clone(),
        raised: None,
    };
    let outcome = interruptible(py, &stop, || run(&mut watch))?;
    match watch.raised {
        Some(raised) => Err(raised.into()),
        None => Ok((watch.keeper, outcome?)),
    }
}

/// Fails at scenes that a run would refuse later.
fn check(scene: &Scene) -> Answer<()> {
    Ok(scene.0.check_fit()?)
}

/// The error bars of a run, or why there are none.
type Bars = Result<Vec<ErrorBars>, Error>;

/// Whether errors are estimated, and from which grids: a flag, or the word "coarser".
pub(crate) struct ErrorGrids(Option<ErrorMethod>);

impl<'py> FromPyObject<'_, 'py> for ErrorGrids {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = type_hint_union!(hints::BOOL, hints::word!("coarser"));

    /// Takes a flag, or the word "coarser".
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if value.extract::<&str>().is_ok_and(|word| word == "coarser") {
            return Ok(Self(Some(ErrorMethod::CoarserGrids)));
        }
        let Ok(is_asked) = value.extract::<bool>() else {
            let allowed = "True, False, or \"coarser\" for errors from coarser grids alone";
            return Err(must_be(&value, allowed));
        };
        Ok(Self(is_asked.then_some(ErrorMethod::FinerGrid)))
    }
}

/// Runs through the whole path with increments chosen like the ones of `like`, if given; returns the error bars by a
/// method, if given.
fn whole(
    scene: &Scene,
    like: Option<&Scene>,
    method: Option<ErrorMethod>,
    watch: &mut dyn Observer,
) -> Result<Option<Bars>, Error> {
    let stop = watch.stop().unwrap_or_default();
    let mut ends = BranchEnds::new(watch);
    let scene = &match like {
        Some(like) => choose_increments_like(&scene.0, &like.0, &stop)?,
        None => choose_increments(&scene.0, &stop)?,
    };
    let increments = contact_core::march::solve(scene, &mut ends)?;
    let Some(method) = method else {
        return Ok(None);
    };
    match error_bars(scene, &increments, &ends.tractions, method, &stop) {
        Err(stopped @ Error::Interrupted { .. }) => Err(stopped),
        bars => Ok(Some(bars)),
    }
}

/// Run a scene into a new result store; use :func:`pyfret.solve`, which opens it.
///
/// Increments are chosen like the increments of the scene `like`.
///
/// `on_increment` is called with the number of each increment solved and their number in all,
/// which is known once they are chosen.
#[pyfunction]
#[pyo3(signature = (scene, *, store, checkpoint: "float" = 5.0, overwrite = false, error = None, like = None, on_increment: "Callable[[int, int], object] | None" = None))]
pub(crate) fn solve(
    py: Python<'_>,
    scene: Scene,
    store: PathBuf,
    #[pyo3(from_py_with = number)] checkpoint: f64,
    overwrite: bool,
    error: Option<ErrorGrids>,
    like: Option<Scene>,
    on_increment: Option<Py<PyAny>>,
) -> Answer<()> {
    check(&scene)?;
    let writer = StoreWriter::create(&store, overwrite)?.with_interval(interval(checkpoint)?);
    let method = error.and_then(|grids| grids.0);
    let run = |watch: &mut dyn Observer| {
        match whole(&scene, like.as_ref(), method, watch)? {
            Some(Ok(bars)) => contact_store::write_error_bars(&store, &bars)?,
            Some(Err(why)) => drop(contact_store::write_no_error_bars(&store, &why)?),
            None => {}
        }
        Ok(())
    };
    watched(py, writer, on_increment, run).map(drop)
}

/// Run a scene in memory; use :func:`pyfret.solve`, which labels what this one gives.
///
/// These are the variables, each with dimensions, values and attributes as xarray takes them, and
/// the attributes of the run, as JSON.
#[pyfunction]
#[pyo3(signature = (scene, *, error = None, like = None, on_increment: "Callable[[int, int], object] | None" = None) -> "tuple[dict[str, Variable], str]")]
pub(crate) fn solve_in_memory(
    py: Python<'_>,
    scene: Scene,
    error: Option<ErrorGrids>,
    like: Option<Scene>,
    on_increment: Option<Py<PyAny>>,
) -> PyResult<(Bound<'_, PyDict>, String)> {
    check(&scene)?;
    let method = error.and_then(|grids| grids.0);
    let run = |watch: &mut dyn Observer| whole(&scene, like.as_ref(), method, watch);
    let (mut columns, bars) = watched(py, Columns::default(), on_increment, run)?;
    if let Some(bars) = bars {
        columns.set_error_bars(&bars, &scene.0.grid);
    }
    let attributes = Value::Object(std::mem::take(&mut columns.attributes)).to_string();
    let grid = &scene.0.grid;
    let variables = Variables::new(py);
    variables.cells(grid)?;
    variables.columns(columns, grid)?;
    Ok((variables.finish(), attributes))
}

/// A result store whose values are checked when they are read; use :func:`pyfret.open`.
#[pyclass(frozen, module = "pyfret._core")]
pub(crate) struct CheckedStore(contact_store::Store);

#[pymethods]
impl CheckedStore {
    /// Opens a store and checks its metadata.
    #[new]
    fn new(py: Python<'_>, store: PathBuf) -> Answer<Self> {
        let store = interruptible(py, &Arc::default(), || contact_store::Store::open(store))?;
        Ok(Self(store?))
    }

    /// Return the attributes of the group as JSON.
    fn attributes(&self) -> String {
        self.0.attributes().to_string()
    }

    /// Fail if a file of the store is missing or is not as it was written.
    fn check(&self, py: Python<'_>) -> Answer<()> {
        Ok(interruptible(py, &Arc::default(), || self.0.verify())??)
    }

    /// Fail if a chunk with entries from `first` to before `end` is missing or damaged.
    fn check_part(&self, py: Python<'_>, name: &str, first: u64, end: u64) -> Answer<()> {
        let checked = || self.0.verify_part(name, first, end);
        Ok(interruptible(py, &Arc::default(), checked)??)
    }
}

/// Checks a store and gives the attributes of its group as JSON.
#[pyfunction]
pub(crate) fn verify(py: Python<'_>, store: PathBuf) -> Answer<String> {
    let store = interruptible(py, &Arc::default(), || {
        contact_store::Store::open_whole(store)
    })?;
    Ok(store?.attributes().to_string())
}

/// Go on with the run of a store that ended early; use :func:`pyfret.resume`, which opens it.
#[pyfunction]
#[pyo3(signature = (store, *, checkpoint: "float" = 5.0, friction_law: "FrictionFunction | Literal['own'] | None" = None, on_increment: "Callable[[int, int], object] | None" = None))]
pub(crate) fn resume(
    py: Python<'_>,
    store: PathBuf,
    #[pyo3(from_py_with = number)] checkpoint: f64,
    friction_law: Option<&Bound<'_, PyAny>>,
    on_increment: Option<Py<PyAny>>,
) -> Answer<()> {
    let (interval, stop) = (interval(checkpoint)?, Arc::default());
    let law = friction_law.map(own_law).transpose()?;
    let Some(Resumed {
        march,
        writer,
        increments,
    }) = interruptible(py, &stop, || {
        contact_store::resume_with_law(store, law.as_ref(), Some(&stop))
    })??
    else {
        return Ok(());
    };
    let writer = writer.with_interval(interval);
    let run = |watch: &mut dyn Observer| march.run(increments, watch).map(drop);
    watched(py, writer, on_increment, run).map(drop)
}
