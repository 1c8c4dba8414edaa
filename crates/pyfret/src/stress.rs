//! Quantities from stresses: measures, principal values, maxima, rims.

use std::collections::HashMap;

use contact_subsurface as core;
use contact_subsurface::Measure;
use ndarray::{Array2, Array3};
use numpy::{PyArray1, PyArray2, PyArray3};
use stress_tensor::StressTensor;

use crate::depths::in_layers;
use crate::prelude::*;

/// Numbers for Python, one row per point.
type Matrix<'py> = Bound<'py, PyArray2<f64>>;

/// The measures of stress with these names; the error lists all names.
pub(crate) fn measures(names: &[String]) -> PyResult<Vec<Measure>> {
    let measures = || -> Vec<_> { core::MEASURES.iter().map(|m| m.name).collect() };
    names
        .iter()
        .map(|name| {
            core::find_measure(name).copied().ok_or_else(|| {
                PyValueError::new_err(format!(
                    "{name:?}: must be one of {}",
                    measures().join(", ")
                ))
            })
        })
        .collect()
}

/// Units and meaning of everything that follows from the stress.
#[pyfunction]
pub(crate) fn probe_labels() -> HashMap<&'static str, (&'static str, &'static str)> {
    let label = |p: core::Probe| (p.name(), (p.unit(), p.long_name()));
    core::Probe::all().map(label).collect()
}

/// The stress tensors of n points, from an array of shape (6, n).
fn tensors(stress: &Field<'_>) -> PyResult<Vec<StressTensor>> {
    let stress = stress.as_array();
    if stress.nrows() != 6 {
        refuse!("stress: must have six rows, xx, yy, zz, xy, xz, yz");
    }
    let columns = stress.columns().into_iter();
    Ok(columns.map(|s| std::array::from_fn(|c| s[c])).collect())
}

/// Give what follows from stresses of shape (6, n), by its name.
#[pyfunction]
#[pyo3(signature = (name, stress) -> "NDArray[np.float64]")]
pub(crate) fn measure<'py>(
    py: Python<'py>,
    name: String,
    stress: Field<'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (of, stress) = (measures(&[name])?[0].value, tensors(&stress)?);
    Ok(stress.iter().map(of).collect::<Vec<_>>().into_pyarray(py))
}

/// Principal values (n, 3), the largest first, and directions (n, 3, 3) of stresses (6, n).
#[pyfunction]
#[pyo3(signature = (stress) -> "tuple[NDArray[np.float64], NDArray[np.float64]]")]
pub(crate) fn principal<'py>(
    py: Python<'py>,
    stress: Field<'py>,
) -> PyResult<(Matrix<'py>, Bound<'py, PyArray3<f64>>)> {
    let stress = tensors(&stress)?;
    let mut values = Array2::zeros((stress.len(), 3));
    let mut directions = Array3::zeros((stress.len(), 3, 3));
    for (n, s) in stress.iter().enumerate() {
        let principal = stress_tensor::principal(s);
        for i in 0..3 {
            values[(n, i)] = principal.values[i];
            for j in 0..3 {
                directions[(n, i, j)] = principal.directions[i][j];
            }
        }
    }
    Ok((values.into_pyarray(py), directions.into_pyarray(py)))
}

/// Value, place along the line, depth, layer and error.
type Judgement = (f64, f64, f64, usize, f64);

/// Largest value of a field known at samples alone, shape (depths, places) along x or y.
///
/// The value, its place along the line, depth, layer and error.
#[pyfunction]
#[pyo3(signature = (samples, z: "Sequence[float]", layer: "Sequence[int]", along: "Sequence[float]"))]
pub(crate) fn largest_of_samples(
    samples: Field<'_>,
    z: List<f64>,
    layer: List<usize>,
    along: List<f64>,
) -> PyResult<Option<Judgement>> {
    let (samples, depths) = (samples.as_array(), in_layers(&z, &layer)?);
    if samples.dim() != (depths.len(), along.len()) {
        refuse!(
            "the samples have the shape {:?}: must be {:?}",
            samples.dim(),
            (depths.len(), along.len())
        );
    }
    let largest = core::largest_of_samples(&samples, &depths, core::Line::AlongX(0.0), &along);
    Ok(largest.map(|m| (m.value, m.x, m.depth.z, m.depth.layer, m.error.total())))
}
