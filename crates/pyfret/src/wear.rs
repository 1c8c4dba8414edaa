//! Wear over many cycles.

use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use contact_core::scene::Reach;
use contact_store::{
    WearColumns, WearStore, resume_wear_with_laws as take_up, verify_wear as verify,
};
use contact_wear::{self as core, Law, WearRun, WornStart};
use ndarray::Ix1;
use numpy::PyArrayLike2;
use pyo3::exceptions::{PyKeyboardInterrupt, PyTypeError};

use crate::argument::to_python;
use crate::document::Document;
use crate::error::to_python as scene_to_python;
use crate::prelude::*;
use crate::python::from_python;
use crate::scene::Scene;
use crate::scene::friction_law::own_law;
use crate::variables::Variables;

/// Exception of a law of the user.
type Raised = Arc<Mutex<Option<PyErr>>>;

/// Fields of the third body that a function gets if its signature names them.
const THIRD_BODY: [&str; 2] = ["aerated", "bed"];

/// A callable on arrays, where what it raises is kept, and the fields of the third body that it takes.
#[derive(Debug)]
struct Own(Py<PyAny>, Raised, Vec<String>);

impl Law for Own {
    /// Calls the function with the fields of the cycle and the fields of the third body that it takes; its
    /// exception is kept in `raised`.
    fn depth(
        &self,
        cycle: &core::CellCycle<'_>,
        depth: &mut [f64],
    ) -> Result<(), contact_core::Error> {
        let mut call = |py: Python<'_>| -> PyResult<()> {
            let array = |field: &[f64]| field.to_pyarray(py);
            let arguments = (
                array(cycle.pressure_times_slip),
                array(cycle.slip_distance),
                array(cycle.dissipated),
                array(cycle.worn),
                cycle.cycles,
            );
            let third_body = PyDict::new(py);
            let fresh = [vec![1.0; depth.len()], vec![0.0; depth.len()]];
            for (n, field) in [cycle.aerated, cycle.debris].into_iter().enumerate() {
                if self.2.iter().any(|name| name == THIRD_BODY[n]) {
                    let field = if field.is_empty() { &fresh[n] } else { field };
                    third_body.set_item(THIRD_BODY[n], array(field))?;
                }
            }
            let answer = self.0.bind(py).call(arguments, Some(&third_body))?;
            let array: Array<'_, Ix1> = answer.extract()?;
            let values = array.as_array();
            if values.len() != depth.len() {
                return Err(PyTypeError::new_err(format!(
                    "an array of {} depths, not {}",
                    depth.len(),
                    values.len()
                )));
            }
            for (depth, values) in depth.iter_mut().zip(values) {
                *depth = *values;
            }
            Ok(())
        };
        let wrong = |e: PyErr| {
            let allowed = "a function of (pressure_times_slip, slip_distance, dissipated, worn, cycles) that gives the depth \
                           of each cell";
            let error = contact_core::Error::invalid("wear.law", &e, allowed);
            *self.1.lock().unwrap_or_else(PoisonError::into_inner) = Some(e);
            error
        };
        Python::attach(|py| call(py).map_err(wrong))
    }
}

/// Makes laws of the functions of both bodies.
fn laws(
    given: &[Vec<Py<PyAny>>; 2],
    raised: &Raised,
    py: Python<'_>,
) -> PyResult<[Vec<Arc<dyn Law>>; 2]> {
    let to_law = |law: &Py<PyAny>| -> PyResult<Arc<dyn Law>> {
        let names = from_python(py, "accepted_keywords")?;
        let names = names.call1((law, THIRD_BODY.to_vec()))?.extract()?;
        Ok(Arc::new(Own(law.clone_ref(py), raised.clone(), names)))
    };
    let [body1, body2] = given
        .each_ref()
        .map(|body| body.iter().map(to_law).collect::<PyResult<Vec<_>>>());
    Ok([body1?, body2?])
}

/// Surfaces to begin on: cycles, energy dissipated, the fields worn1, worn2, energy1, energy2, slid, bed, and the
/// volume of debris that has left.
#[derive(FromPyObject)]
pub(crate) struct Start<'py>(f64, f64, Vec<PyArrayLike2<'py, f64>>, f64);

impl Start<'_> {
    /// The worn surfaces from their fields.
    fn read(&self) -> WornStart {
        let field = |n: usize| {
            self.2
                .get(n)
                .map(|f| f.as_array().to_owned())
                .unwrap_or_default()
        };
        WornStart {
            cycles: self.0,
            dissipated: self.1,
            worn: [field(0), field(1)],
            energy: [field(2), field(3)],
            slid: field(4),
            bed: (self.2.len() > 5).then(|| field(5)),
            ejected: self.3,
        }
    }
}

/// A run of wear in memory: its variables as xarray takes them, and its attributes as JSON.
type StoredVariable<'py> = (Bound<'py, PyDict>, String);

/// Runs a scene over many cycles, by the table `[wear]` of a scene file.
///
/// It writes a store, or without one gives all in memory. Laws that are functions, `{ own = true }`
/// in the table, stand in `own` for each body.
#[pyfunction]
#[pyo3(signature = (scene, wear: "dict[str, Any]", own: "Sequence[Sequence[Callable[..., ArrayLike]]]", *, store = None, overwrite = false, start: "tuple[float, float, Sequence[NDArray[np.float64]], float] | None" = None, on_jump: "Callable[[float], None] | None" = None) -> "tuple[dict[str, Variable], str] | None")]
pub(crate) fn wear<'py>(
    py: Python<'py>,
    scene: Scene,
    wear: Document,
    own: [Vec<Py<PyAny>>; 2],
    store: Option<PathBuf>,
    overwrite: bool,
    start: Option<Start<'py>>,
    on_jump: Option<Py<PyAny>>,
) -> PyResult<Option<StoredVariable<'py>>> {
    scene.0.check().map_err(scene_to_python)?;
    let raised = Raised::default();
    let python_laws = laws(&own, &raised, py)?;
    let (scene, wear) =
        core::Wear::from_table(&scene.0, &wear.0, &python_laws).map_err(to_python)?;
    if let Some(doubt) = wear.doubt_of_grid(&scene) {
        let warn = from_python(py, "warn")?;
        warn.call1((doubt,))?;
    }
    let stop = Arc::<AtomicBool>::default();
    let start = start.map(|start| start.read());
    let run = || {
        let kept = match &store {
            Some(store) => Kept::Store(Box::new(WearStore::create(store, overwrite)?)),
            None => Kept::Memory(WearColumns::default()),
        };
        let run = match &start {
            Some(start) => WearRun::from_worn(&scene, &wear, start, &stop)?,
            None => WearRun::new(&scene, &wear, &stop)?,
        };
        Ok((run, kept))
    };
    let begun: Result<_, contact_core::Error> = interruptible(py, &stop, run)?;
    let (mut run, mut kept) = begun.map_err(|e| with_cause(py, to_python(e), &raised))?;
    run_to_end(py, &mut run, &mut kept, (&stop, &raised), on_jump.as_ref())?;
    let Kept::Memory(columns) = kept else {
        return Ok(None);
    };
    let (variables, attributes) = columns.finish(&run, "done");
    let labelled = Variables::new(py);
    variables
        .into_iter()
        .try_for_each(|variable| labelled.in_memory(variable))?;
    Ok(Some((labelled.finish(), attributes.to_string())))
}

/// Fails if a file of the store of a run of wear is missing, or is not as it was written.
#[pyfunction]
pub(crate) fn verify_wear(py: Python<'_>, store: PathBuf) -> PyResult<()> {
    py.detach(|| verify(&store)).map_err(to_python)
}

/// The scene of a file and its table `[wear]`, as the text of a scene file each.
#[pyfunction]
#[pyo3(signature = (path, set: "Sequence[str]" = List::default()))]
pub(crate) fn wear_of_file(path: PathBuf, set: List<String>) -> PyResult<(Scene, String)> {
    let read = core::Wear::from_file(path, &set, Reach::Folder);
    let (scene, wear) = read.map_err(scene_to_python)?;
    Ok((Scene(scene), wear.to_toml()))
}

/// Goes on with a run of wear that ended early; `own` has the functions among the laws.
#[pyfunction]
#[pyo3(signature = (store, own: "Sequence[Sequence[Callable[..., ArrayLike]]]", *, friction_law: "FrictionFunction | Literal['own'] | None" = None, on_jump: "Callable[[float], None] | None" = None))]
pub(crate) fn resume_wear(
    py: Python<'_>,
    store: PathBuf,
    own: [Vec<Py<PyAny>>; 2],
    friction_law: Option<&Bound<'_, PyAny>>,
    on_jump: Option<Py<PyAny>>,
) -> PyResult<()> {
    let raised = Raised::default();
    let friction = friction_law.map(own_law).transpose()?;
    let python_laws = laws(&own, &raised, py)?;
    let stop = Arc::<AtomicBool>::default();
    let outcome = interruptible(py, &stop, || {
        take_up(&store, &python_laws, friction.as_ref(), &stop)
    })?;
    let outcome = outcome.map_err(to_python)?;
    match outcome {
        None => Ok(()),
        Some((mut run, store)) => {
            let mut kept = Kept::Store(Box::new(store));
            run_to_end(py, &mut run, &mut kept, (&stop, &raised), on_jump.as_ref())
        }
    }
}

/// An error with the exception of a user's law as its cause. An interrupt within the law is returned itself.
fn with_cause(py: Python<'_>, error: PyErr, raised: &Raised) -> PyErr {
    let cause = raised.lock().unwrap_or_else(PoisonError::into_inner).take();
    match cause {
        Some(interrupt) if interrupt.is_instance_of::<PyKeyboardInterrupt>(py) => interrupt,
        cause => {
            error.set_cause(py, cause);
            error
        }
    }
}

/// Storage of the result of a run.
enum Kept {
    Store(Box<WearStore>),
    Memory(WearColumns),
}

impl Kept {
    /// Writes the jump to the store, or keeps it in memory.
    fn write(&mut self, run: &mut WearRun) -> Result<(), contact_core::Error> {
        match self {
            Self::Store(store) => store.write(run),
            Self::Memory(columns) => {
                columns.keep(run);
                Ok(())
            }
        }
    }

    /// Writes how the run of a store ended.
    fn finish(&self, run: &WearRun, status: &str) -> Result<(), contact_core::Error> {
        match self {
            Self::Store(store) => store.finish(run, status),
            Self::Memory(_) => Ok(()),
        }
    }
}

/// Advances the run jump by jump to its end, interruptibly; writes each jump, and calls `on_jump` with the
/// cycles so far.
fn run_to_end(
    py: Python<'_>,
    run: &mut WearRun,
    kept: &mut Kept,
    (stop, raised): (&Arc<AtomicBool>, &Raised),
    on_jump: Option<&Py<PyAny>>,
) -> PyResult<()> {
    loop {
        let step = interruptible(py, stop, || {
            let jump = run.advance()?;
            Some(jump.and_then(|jump| kept.write(run).map(|()| jump.cycles)))
        });
        match step {
            Ok(None) => return kept.finish(run, "done").map_err(to_python),
            Ok(Some(Ok(cycles))) => {
                if let Some(report) = on_jump {
                    report.call1(py, (cycles,))?;
                }
            }
            Ok(Some(Err(error))) => {
                let text = error.to_string();
                let error = with_cause(py, to_python(error), raised);
                let stopped = error.is_instance_of::<PyKeyboardInterrupt>(py);
                let status = if stopped { "stopped" } else { &text };
                kept.finish(run, status).map_err(to_python)?;
                return Err(error);
            }
            Err(raised) => {
                kept.finish(run, "stopped").map_err(to_python)?;
                return Err(raised);
            }
        }
    }
}
