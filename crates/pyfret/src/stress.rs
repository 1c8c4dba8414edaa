//! What follows from stresses: measures, principal values, maxima, rims.

use std::collections::HashMap;

use contact_core::fields as core;
use contact_core::fields::Measure;
use ndarray::{Array2, Array3, Ix3};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::{Array, Field, List};
use crate::subsurface::Subsurface;

/// Numbers for Python, one row per point.
type Matrix<'py> = Bound<'py, PyArray2<f64>>;

pub(crate) fn measures(names: &[String]) -> PyResult<Vec<Measure>> {
    let known = || -> Vec<_> { core::MEASURES.iter().map(|m| m.name).collect() };
    names
        .iter()
        .map(|name| {
            core::measure_named(name).copied().ok_or_else(|| {
                PyValueError::new_err(format!("{name:?}: must be one of {}", known().join(", ")))
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

/// The stresses of n points, from an array of shape (6, n).
fn tensors(stress: &Field<'_>) -> PyResult<Vec<core::StressTensor>> {
    let stress = stress.as_array();
    if stress.nrows() != 6 {
        return Err(PyValueError::new_err(
            "stress: must have six rows, xx, yy, zz, xy, xz, yz",
        ));
    }
    let columns = stress.columns().into_iter();
    Ok(columns.map(|s| std::array::from_fn(|c| s[c])).collect())
}

/// Give what follows from stresses of shape (6, n), by its name.
#[pyfunction]
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
pub(crate) fn principal<'py>(
    py: Python<'py>,
    stress: Field<'py>,
) -> PyResult<(Matrix<'py>, Bound<'py, PyArray3<f64>>)> {
    let stress = tensors(&stress)?;
    let mut values = Array2::zeros((stress.len(), 3));
    let mut directions = Array3::zeros((stress.len(), 3, 3));
    for (n, s) in stress.iter().enumerate() {
        let of = core::principal(s);
        for i in 0..3 {
            values[(n, i)] = of.values[i];
            for j in 0..3 {
                directions[(n, i, j)] = of.directions[i][j];
            }
        }
    }
    Ok((values.into_pyarray(py), directions.into_pyarray(py)))
}

/// Largest stress whose square is a number \[Pa\].
const LARGEST: f64 = 1e150;

/// Largest value on a section of stresses (6, depths, places).
///
/// The value, its place, depth and layer, and the error that the distances of the depths leave.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "a tuple of Python")]
pub(crate) fn maximum(
    name: String,
    stress: Array<'_, Ix3>,
    z: List<f64>,
    layer: List<usize>,
    along: List<f64>,
) -> PyResult<Option<(f64, f64, f64, usize, f64)>> {
    let stress = stress.as_array().to_owned();
    let depths = Subsurface::depths(&z, &layer)?;
    if stress.dim() != (6, depths.len(), along.len()) {
        return Err(PyValueError::new_err(format!(
            "the stress has the shape {:?}: must be {:?}",
            stress.dim(),
            (6, depths.len(), along.len())
        )));
    }
    if stress.iter().any(|s| s.abs() > LARGEST) {
        return Err(PyValueError::new_err(format!(
            "the stress is beyond {LARGEST:e} Pa: its measures have squares"
        )));
    }
    let found = measures(&[name])?[0].maximum(&stress, &depths, &along);
    Ok(found.map(|m| (m.value, m.place[0], m.depth.z, m.depth.layer, m.error)))
}

/// Places of the rims on a line on the surface, and stresses (6, rims), from stresses (6, n).
#[pyfunction]
pub(crate) fn rims<'py>(
    py: Python<'py>,
    stress: Field<'py>,
    along: List<f64>,
) -> PyResult<(Vec<f64>, Matrix<'py>)> {
    if stress.as_array().dim() != (6, along.len()) {
        return Err(PyValueError::new_err(
            "stress: must be of the shape (6, places)",
        ));
    }
    let found = core::rims(&stress.as_array(), &along);
    let tensors = Array2::from_shape_fn((6, found.len()), |(c, n)| found[n].stress[c]);
    let places = found.iter().map(|rim| rim.place).collect();
    Ok((places, tensors.into_pyarray(py)))
}
