//! The temperature that friction causes.

use std::sync::atomic::AtomicBool;

use contact_heat as core;
use ndarray::{Array2, Array3, ArrayView2, Axis, Ix2, Ix3, stack};

use crate::argument::Answer;
use crate::prelude::*;
use crate::scene::{Body, Grid};

/// Conductivity and heat capacity of each layer.
type Conductors = List<(f64, f64)>;

/// The layers of a body with their conductors; `key` names the argument in errors.
fn layers(conductors: &Conductors, body: &Body, key: &str) -> Answer<core::Layers> {
    let conductors: Vec<_> = conductors
        .iter()
        .map(|&(conductivity, heat_capacity)| core::Conductor {
            conductivity,
            heat_capacity,
        })
        .collect();
    let thicknesses: Vec<f64> = body.0.coatings.iter().map(|c| c.thickness).collect();
    Ok(core::Layers::new(&conductors, &thicknesses, key)?)
}

/// Temperature over a cycle; use :meth:`pyfret.Result.temperature`.
#[pyfunction]
#[pyo3(signature = (conductor1: "Sequence[tuple[float, float]]", conductor2: "Sequence[tuple[float, float]]", *, body1, body2, grid, bulk: "tuple[float, float]", frequency: "Frequency", ends: "Sequence[float]", heat, contact, harmonics: "int", jumps: "bool") -> "dict[str, Any]")]
pub(crate) fn cycle_temperature<'py>(
    py: Python<'py>,
    conductor1: Conductors,
    conductor2: Conductors,
    body1: Body,
    body2: Body,
    grid: Grid,
    #[pyo3(from_py_with = number)] bulk: (f64, f64),
    #[pyo3(from_py_with = Given::frequency)] frequency: f64,
    ends: List<f64>,
    heat: Array<'py, Ix3>,
    contact: Mask<'py, Ix2>,
    #[pyo3(from_py_with = number)] harmonics: usize,
    jumps: bool,
) -> Answer<Bound<'py, PyDict>> {
    let layers1 = layers(&conductor1, &body1, "conductor1")?;
    let two = layers(&conductor2, &body2, "conductor2")?;
    let heat: Vec<Array2<f64>> = heat
        .as_array()
        .outer_iter()
        .map(|of| of.to_owned())
        .collect();
    let contact = contact.as_array().to_owned();
    let cycle = core::Cycle {
        frequency,
        ends: &ends,
        heat: &heat,
        contact: &contact,
        jumps,
    };
    let stop = Arc::<AtomicBool>::default();
    let bulk = [bulk.0, bulk.1];
    let run = || core::temperature([&layers1, &two], bulk, &grid.0, &cycle, harmonics, &stop);
    let temperature = interruptible(py, &stop, run)??;
    let stack = |of: &[Array2<f64>; 2]| -> Array3<f64> {
        let views: [ArrayView2<'_, f64>; 2] = [of[0].view(), of[1].view()];
        stack(Axis(0), &views).expect("both bodies are on one grid")
    };
    let result = PyDict::new(py);
    result.set_item("mean", stack(&temperature.mean).into_pyarray(py))?;
    result.set_item("largest", stack(&temperature.largest).into_pyarray(py))?;
    result.set_item("heat", temperature.heat.into_pyarray(py))?;
    result.set_item("flux", temperature.flux.into_pyarray(py))?;
    result.set_item("instants", temperature.instants)?;
    result.set_item("peaks", temperature.peaks)?;
    result.set_item("error", temperature.error)?;
    Ok(result)
}
