//! Wear over many cycles.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::output::{WearStore, resume_wear as take_up};
use contact_core::wear::{self as core, BodyWear, Cycling, Jumps, Law, WearRun, WornThrough};
use numpy::{PyArrayLike1, ToPyArray};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::error::to_python;
use crate::interruptible::interruptible;
use crate::parts::parts;
use crate::scene::Scene;

/// Archard's law.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.wear")]
#[derive(Clone, PartialEq)]
pub(crate) struct Archard(core::Archard);

parts!(Archard: k, threshold);

#[pymethods]
impl Archard {
    #[new]
    #[pyo3(signature = (k, *, threshold = 0.0))]
    fn new(k: f64, threshold: f64) -> Self {
        Self(core::Archard { k, threshold })
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

    fn __repr__(&self) -> String {
        format!("Archard({:?}, threshold={:?})", self.0.k, self.0.threshold)
    }
}

/// Wear by the energy dissipated.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.wear")]
#[derive(Clone, PartialEq)]
pub(crate) struct DissipatedEnergy(core::DissipatedEnergy);

parts!(DissipatedEnergy: alpha, threshold);

#[pymethods]
impl DissipatedEnergy {
    #[new]
    #[pyo3(signature = (alpha, *, threshold = 0.0))]
    fn new(alpha: f64, threshold: f64) -> Self {
        Self(core::DissipatedEnergy { alpha, threshold })
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

    fn __repr__(&self) -> String {
        let core::DissipatedEnergy { alpha, threshold } = self.0;
        format!("DissipatedEnergy({alpha:?}, threshold={threshold:?})")
    }
}

/// A callable on arrays.
#[derive(Debug)]
struct Own(Py<PyAny>);

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
            contact_core::Error::invalid("wear.law", e, allowed)
        };
        Python::attach(|py| call(py).map_err(wrong))
    }
}

fn law(given: &Bound<'_, PyAny>) -> PyResult<Arc<dyn Law>> {
    if let Ok(law) = given.extract::<Archard>() {
        return Ok(Arc::new(law.0));
    }
    if let Ok(law) = given.extract::<DissipatedEnergy>() {
        return Ok(Arc::new(law.0));
    }
    if given.is_callable() {
        return Ok(Arc::new(Own(given.clone().unbind())));
    }
    Err(PyTypeError::new_err(format!(
        "a wear law must be an Archard, a DissipatedEnergy or a function, not {given}"
    )))
}

fn body(given: Option<&Bound<'_, PyAny>>, share: Option<f64>) -> PyResult<BodyWear> {
    let laws = match given {
        None => Vec::new(),
        Some(list) if list.is_instance_of::<pyo3::types::PyList>() => list
            .try_iter()?
            .map(|one| law(&one?))
            .collect::<PyResult<_>>()?,
        Some(one) => vec![law(one)?],
    };
    Ok(BodyWear { laws, share })
}

/// Runs a scene over many cycles into a store.
#[pyfunction]
#[pyo3(signature = (scene, *, body1, body2, cycles, store, share1 = None, share2 = None, first_branch = 1,
    sliding = false, rig_stiffness = f64::INFINITY, tolerance = None, jumps = None, explicit_jumps = None,
    go_on = false, tell_from = 0.1, on_jump = None))]
pub(crate) fn wear(
    py: Python<'_>,
    scene: Scene,
    body1: Option<Bound<'_, PyAny>>,
    body2: Option<Bound<'_, PyAny>>,
    cycles: f64,
    store: PathBuf,
    share1: Option<f64>,
    share2: Option<f64>,
    first_branch: usize,
    sliding: bool,
    rig_stiffness: f64,
    tolerance: Option<f64>,
    jumps: Option<usize>,
    explicit_jumps: Option<usize>,
    go_on: bool,
    tell_from: f64,
    on_jump: Option<Py<PyAny>>,
) -> PyResult<()> {
    let bodies = [body(body1.as_ref(), share1)?, body(body2.as_ref(), share2)?];
    let wear = core::Wear {
        first_branch,
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
    let run = || {
        let store = WearStore::create(&store, false)?;
        Ok((WearRun::new(&scene.0, &wear, &stop)?, store))
    };
    let begun: Result<_, contact_core::Error> = interruptible(py, &stop, run)?;
    let (run, store) = begun.map_err(to_python)?;
    go(py, run, store, &stop, on_jump.as_ref())
}

/// Goes on with a run of wear that ended early.
#[pyfunction]
#[pyo3(signature = (store, *, on_jump = None))]
pub(crate) fn resume_wear(
    py: Python<'_>,
    store: PathBuf,
    on_jump: Option<Py<PyAny>>,
) -> PyResult<()> {
    let stop = Arc::<AtomicBool>::default();
    let found = interruptible(py, &stop, || take_up(&store, None, &stop))?.map_err(to_python)?;
    match found {
        None => Ok(()),
        Some((run, store)) => go(py, run, store, &stop, on_jump.as_ref()),
    }
}

fn go(
    py: Python<'_>,
    mut run: WearRun,
    mut store: WearStore,
    stop: &Arc<AtomicBool>,
    on_jump: Option<&Py<PyAny>>,
) -> PyResult<()> {
    loop {
        let step = interruptible(py, stop, || {
            let jump = run.advance()?;
            Some(jump.and_then(|jump| store.write(&mut run).map(|()| jump.cycles)))
        });
        match step {
            Ok(None) => return store.finish(&run, "done").map_err(to_python),
            Ok(Some(Ok(cycles))) => {
                if let Some(tell) = on_jump {
                    tell.call1(py, (cycles,))?;
                }
            }
            Ok(Some(Err(error))) => {
                store.finish(&run, &error.to_string()).map_err(to_python)?;
                return Err(to_python(error));
            }
            Err(raised) => {
                store.finish(&run, "stopped").map_err(to_python)?;
                return Err(raised);
            }
        }
    }
}
