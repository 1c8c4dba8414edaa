//! Wear over many cycles.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use contact_store::{WearColumns, WearStore, resume_wear_by as take_up, verify_wear as verify};
use contact_wear::{
    self as core, BodyWear, Cycling, Factor, Jumps, Law, Of, Varying, WearRun, WornStart,
    WornThrough,
};
use numpy::{PyArrayLike1, PyArrayLike2, ToPyArray};
use pyo3::exceptions::{PyKeyboardInterrupt, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::to_python;
use crate::error::to_python as scene_to_python;
use crate::interruptible::interruptible;
use crate::parts::parts;
use crate::scene::Scene;
use crate::scene::friction_law::own_law;
use crate::variables::Variables;

/// What a factor is a function of, and its pairs.
type Table = Option<(String, Vec<(f64, f64)>)>;

fn factor(given: Table) -> PyResult<Option<Factor>> {
    let Some((of, table)) = given else {
        return Ok(None);
    };
    if let Some((_, of)) = Of::ALL.iter().find(|(name, _)| *name == of) {
        return Ok(Some(Factor { of: *of, table }));
    }
    let names = Of::ALL.map(|(name, _)| format!("\"{name}\"")).join(", ");
    let message = format!("factor of \"{of}\": must be of {names}");
    Err(PyValueError::new_err(message))
}

fn table(factor: Option<&Factor>) -> Table {
    factor.map(|factor| (factor.of.name().to_owned(), factor.table.clone()))
}

/// A law, times a factor where it has one.
fn varying(law: impl Law + 'static, factor: Option<&Factor>) -> Arc<dyn Law> {
    let law: Arc<dyn Law> = Arc::new(law);
    match factor.cloned() {
        Some(factor) => Arc::new(Varying { law, factor }),
        None => law,
    }
}

/// Archard's law.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.wear")]
#[derive(Clone, PartialEq)]
pub(crate) struct Archard(core::Archard, Option<Factor>);

parts!(Archard: k, threshold, factor);

#[pymethods]
impl Archard {
    #[new]
    #[pyo3(signature = (k, *, threshold = 0.0, factor = None))]
    fn new(k: f64, threshold: f64, factor: Table) -> PyResult<Self> {
        Ok(Self(core::Archard { k, threshold }, self::factor(factor)?))
    }

    /// Worn depth over pressure times sliding distance [m^2/N].
    #[getter]
    fn k(&self) -> f64 {
        self.0.k
    }

    /// Sliding distance in a cycle below which nothing wears [m].
    #[getter]
    fn threshold(&self) -> f64 {
        self.0.threshold
    }

    /// What the coefficient changes with, and pairs of that and its factor.
    #[getter]
    fn factor(&self) -> Table {
        table(self.1.as_ref())
    }

    fn __repr__(&self) -> String {
        let varies = if self.1.is_some() { ", factor=..." } else { "" };
        format!(
            "Archard({:?}, threshold={:?}{varies})",
            self.0.k, self.0.threshold
        )
    }
}

/// Wear by the energy dissipated.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.wear")]
#[derive(Clone, PartialEq)]
pub(crate) struct DissipatedEnergy(core::DissipatedEnergy, Option<Factor>);

parts!(DissipatedEnergy: alpha, threshold, factor);

#[pymethods]
impl DissipatedEnergy {
    #[new]
    #[pyo3(signature = (alpha, *, threshold = 0.0, factor = None))]
    fn new(alpha: f64, threshold: f64, factor: Table) -> PyResult<Self> {
        Ok(Self(
            core::DissipatedEnergy { alpha, threshold },
            self::factor(factor)?,
        ))
    }

    /// Worn volume over dissipated energy [m^3/J].
    #[getter]
    fn alpha(&self) -> f64 {
        self.0.alpha
    }

    /// Energy per area in a cycle below which nothing wears [J/m^2].
    #[getter]
    fn threshold(&self) -> f64 {
        self.0.threshold
    }

    /// What the coefficient changes with, and pairs of that and its factor.
    #[getter]
    fn factor(&self) -> Table {
        table(self.1.as_ref())
    }

    fn __repr__(&self) -> String {
        let core::DissipatedEnergy { alpha, threshold } = self.0;
        let varies = if self.1.is_some() { ", factor=..." } else { "" };
        format!("DissipatedEnergy({alpha:?}, threshold={threshold:?}{varies})")
    }
}

/// What a law of one's own has raised.
type Raised = Arc<Mutex<Option<PyErr>>>;

/// A callable on arrays, and where what it raises is kept.
#[derive(Debug)]
struct Own(Py<PyAny>, Raised);

impl Law for Own {
    fn depth(
        &self,
        cycle: &core::CellCycle<'_>,
        depth: &mut [f64],
    ) -> Result<(), contact_core::Error> {
        let mut call = |py: Python<'_>| -> PyResult<()> {
            let array = |field: &[f64]| field.to_pyarray(py);
            let given = (
                array(cycle.pressed_way),
                array(cycle.way),
                array(cycle.dissipated),
                array(cycle.worn),
                cycle.cycles,
            );
            let found = self.0.bind(py).call1(given)?;
            let found: PyArrayLike1<'_, f64, numpy::AllowTypeChange> = found.extract()?;
            let found = found.as_array();
            if found.len() != depth.len() {
                return Err(PyTypeError::new_err(format!(
                    "an array of {} depths, not {}",
                    depth.len(),
                    found.len()
                )));
            }
            for (depth, found) in depth.iter_mut().zip(found) {
                *depth = *found;
            }
            Ok(())
        };
        let wrong = |e: PyErr| {
            let allowed = "a function of (pressed_way, way, dissipated, worn, cycles) that gives the depth \
                           of each cell";
            let error = contact_core::Error::invalid("wear.law", &e, allowed);
            *self.1.lock().unwrap_or_else(PoisonError::into_inner) = Some(e);
            error
        };
        Python::attach(|py| call(py).map_err(wrong))
    }
}

fn law(given: &Bound<'_, PyAny>, raised: &Raised) -> PyResult<Arc<dyn Law>> {
    if let Ok(law) = given.extract::<Archard>() {
        return Ok(varying(law.0, law.1.as_ref()));
    }
    if let Ok(law) = given.extract::<DissipatedEnergy>() {
        return Ok(varying(law.0, law.1.as_ref()));
    }
    if given.is_none() {
        // A layer that does not wear.
        return Ok(Arc::new(core::Archard {
            k: 0.0,
            threshold: 0.0,
        }));
    }
    if given.is_callable() {
        return Ok(Arc::new(Own(given.clone().unbind(), raised.clone())));
    }
    Err(PyTypeError::new_err(format!(
        "a wear law must be an Archard, a DissipatedEnergy, a function, or None for what does not wear, not {given}"
    )))
}

fn body(
    given: Option<&Bound<'_, PyAny>>,
    share: Option<f64>,
    raised: &Raised,
) -> PyResult<BodyWear> {
    let laws = match given {
        None => Vec::new(),
        Some(list) if list.is_instance_of::<pyo3::types::PyList>() => list
            .try_iter()?
            .map(|one| law(&one?, raised))
            .collect::<PyResult<_>>()?,
        Some(one) => vec![law(one, raised)?],
    };
    Ok(BodyWear { laws, share })
}

/// Surfaces to begin on: cycles, energy dissipated, and the fields worn1, worn2, energy1, energy2, slid.
#[derive(FromPyObject)]
pub(crate) struct Start<'py>(f64, f64, Vec<PyArrayLike2<'py, f64>>);

impl Start<'_> {
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
        }
    }
}

/// A run of wear in memory: its variables as xarray takes them, and its attributes as JSON.
type InMemory<'py> = (Bound<'py, PyDict>, String);

/// Runs a scene over many cycles into a store, or without one in memory.
#[pyfunction]
#[pyo3(signature = (scene, *, body1, body2, cycles, store = None, overwrite = false, share1 = None, share2 = None, first_branch = None,
    debris_kept = 0.0, frequency = None, start = None,
    sliding = false, rig_stiffness = f64::INFINITY, tolerance = None, jumps = None, explicit_jumps = None,
    go_on = false, tell_from = 0.1, on_jump = None))]
pub(crate) fn wear<'py>(
    py: Python<'py>,
    scene: Scene,
    body1: Option<Bound<'py, PyAny>>,
    body2: Option<Bound<'py, PyAny>>,
    cycles: f64,
    store: Option<PathBuf>,
    overwrite: bool,
    share1: Option<f64>,
    share2: Option<f64>,
    first_branch: Option<usize>,
    debris_kept: f64,
    frequency: Option<f64>,
    start: Option<Start<'py>>,
    sliding: bool,
    rig_stiffness: f64,
    tolerance: Option<f64>,
    jumps: Option<usize>,
    explicit_jumps: Option<usize>,
    go_on: bool,
    tell_from: f64,
    on_jump: Option<Py<PyAny>>,
) -> PyResult<Option<InMemory<'py>>> {
    scene.0.check().map_err(scene_to_python)?;
    let raised = Raised::default();
    let bodies = [
        body(body1.as_ref(), share1, &raised)?,
        body(body2.as_ref(), share2, &raised)?,
    ];
    let wear = core::Wear {
        first_branch,
        debris_kept,
        frequency,
        cycling: if sliding {
            Cycling::Sliding
        } else {
            Cycling::March
        },
        rig_stiffness,
        jumps: match (explicit_jumps, jumps, tolerance) {
            (Some(n), _, _) => Jumps::Explicit(n),
            (None, Some(n), _) => Jumps::Number(n),
            (None, None, Some(tolerance)) => Jumps::Tolerance(tolerance),
            (None, None, None) => Jumps::default(),
        },
        worn_through: if go_on {
            WornThrough::GoOn
        } else {
            WornThrough::Stop
        },
        tell_from,
        ..core::Wear::new(bodies, cycles)
    };
    let stop = Arc::<AtomicBool>::default();
    let start = start.map(|start| start.read());
    let run = || {
        let kept = match &store {
            Some(store) => Kept::Store(Box::new(WearStore::create(store, overwrite)?)),
            None => Kept::Memory(WearColumns::default()),
        };
        let run = match &start {
            Some(start) => WearRun::from_worn(&scene.0, &wear, start, &stop)?,
            None => WearRun::new(&scene.0, &wear, &stop)?,
        };
        Ok((run, kept))
    };
    let begun: Result<_, contact_core::Error> = interruptible(py, &stop, run)?;
    let (mut run, mut kept) = begun.map_err(|e| caused(py, to_python(e), &raised))?;
    go(py, &mut run, &mut kept, (&stop, &raised), on_jump.as_ref())?;
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

/// Goes on with a run of wear that ended early.
#[pyfunction]
#[pyo3(signature = (store, *, body1 = None, body2 = None, friction_law = None, on_jump = None))]
pub(crate) fn resume_wear(
    py: Python<'_>,
    store: PathBuf,
    body1: Option<Bound<'_, PyAny>>,
    body2: Option<Bound<'_, PyAny>>,
    friction_law: Option<&Bound<'_, PyAny>>,
    on_jump: Option<Py<PyAny>>,
) -> PyResult<()> {
    let raised = Raised::default();
    let friction = friction_law.map(own_law).transpose()?;
    let own =
        |law: Option<&Bound<'_, PyAny>>| law.map(|law| body(Some(law), None, &raised)).transpose();
    let own = [own(body1.as_ref())?, own(body2.as_ref())?];
    let stop = Arc::<AtomicBool>::default();
    let found = interruptible(py, &stop, || {
        take_up(&store, &own, friction.as_ref(), &stop)
    })?;
    let found = found.map_err(to_python)?;
    match found {
        None => Ok(()),
        Some((mut run, store)) => {
            let mut kept = Kept::Store(Box::new(store));
            go(py, &mut run, &mut kept, (&stop, &raised), on_jump.as_ref())
        }
    }
}

/// An error with what a law has raised as its cause; an interrupt within a law as it is.
fn caused(py: Python<'_>, error: PyErr, raised: &Raised) -> PyErr {
    let cause = raised.lock().unwrap_or_else(PoisonError::into_inner).take();
    match cause {
        Some(interrupt) if interrupt.is_instance_of::<PyKeyboardInterrupt>(py) => interrupt,
        cause => {
            error.set_cause(py, cause);
            error
        }
    }
}

/// Where what a run gives is kept.
enum Kept {
    Store(Box<WearStore>),
    Memory(WearColumns),
}

impl Kept {
    fn write(&mut self, run: &mut WearRun) -> Result<(), contact_core::Error> {
        match self {
            Self::Store(store) => store.write(run),
            Self::Memory(columns) => {
                columns.keep(run);
                Ok(())
            }
        }
    }

    fn finish(&self, run: &WearRun, status: &str) -> Result<(), contact_core::Error> {
        match self {
            Self::Store(store) => store.finish(run, status),
            Self::Memory(_) => Ok(()),
        }
    }
}

fn go(
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
                if let Some(tell) = on_jump {
                    tell.call1(py, (cycles,))?;
                }
            }
            Ok(Some(Err(error))) => {
                let text = error.to_string();
                let error = caused(py, to_python(error), raised);
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
