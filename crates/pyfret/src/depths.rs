//! Depths below the surface, each in its layer.

use contact_subsurface as core;
use contact_subsurface::Depth;

use crate::argument::Answer;
use crate::prelude::*;
use crate::scene::Body;

/// Depths [m] with their layers; on an interface both, the upper one first.
#[pyfunction]
#[pyo3(signature = (body, z: "Sequence[float]"))]
pub(crate) fn depths(body: Body, z: List<f64>) -> Answer<(Vec<f64>, Vec<usize>)> {
    let depths = core::depths(&body.0, &z)?;
    Ok(depths.iter().map(|d| (d.z, d.layer)).unzip())
}

/// Depths [m] that the layers of a body ask for, with their layers.
///
/// They go to the depth `deepest` [m] under a contact of the radius `a` [m]; `finer` times as
/// many as the default.
#[pyfunction]
#[pyo3(signature = (body, *, a: "float", deepest: "float", finer: "float" = 1.0))]
pub(crate) fn chosen_depths(
    body: Body,
    #[pyo3(from_py_with = number)] a: f64,
    #[pyo3(from_py_with = number)] deepest: f64,
    #[pyo3(from_py_with = number)] finer: f64,
) -> Answer<(Vec<f64>, Vec<usize>)> {
    let depths = core::default_depths(&body.0, a, deepest, finer)?;
    Ok(depths.iter().map(|d| (d.z, d.layer)).unzip())
}

/// Return what this process has computed below surfaces.
///
/// Kernel tables below layers, stresses on lines and planes and at single points (each point once
/// for each state), and planes judged by criteria.
#[pyfunction]
#[pyo3(signature = () -> "dict[str, int]")]
pub(crate) fn count_work(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let [on_grids, at_points] = core::stresses_computed();
    let counts = PyDict::new(py);
    counts.set_item("tables", contact_core::kernels::depth_tables_made())?;
    counts.set_item("stresses_on_grids", on_grids)?;
    counts.set_item("stresses_at_points", at_points)?;
    counts.set_item("planes", fatigue::planes_judged())?;
    Ok(counts)
}

/// Pairs depths \[m\] with their layers; fails if the lists differ in length.
pub(crate) fn in_layers(z: &[f64], layer: &[usize]) -> PyResult<Vec<Depth>> {
    if z.len() != layer.len() {
        refuse!("z and layer differ in length");
    }
    let pairs = z.iter().zip(layer);
    Ok(pairs.map(|(&z, &layer)| Depth { z, layer }).collect())
}
