//! Criteria, first yield and shakedown on histories of stress.

use fatigue as core;
use ndarray::{Array1, Array2, Ix2, Ix3};

use super::Criterion;
use crate::error::Answer;
use crate::prelude::*;

/// A number of what a criterion finds at a point.
type Number = fn(&core::PointResult) -> f64;

/// The numbers of a criterion at a point, by the names that Python has for them.
pub(crate) const AT_POINT: [(&str, Number); 7] = [
    ("value", |p| p.value),
    ("missed", |p| p.missed),
    ("planes", |p| p.planes as f64),
    ("shear_amplitude", |p| p.shear_amplitude),
    ("shear_chord", |p| p.shear_chord),
    ("normal_max", |p| p.normal_max),
    ("normal_min", |p| p.normal_min),
];

/// A load factor of a point.
type Factor = fn(&core::Yield) -> f64;

/// The load factors of a point, by the names that Python has for them.
pub(crate) const FACTORS: [(&str, Factor); 3] = [
    ("von_mises", |f| f.von_mises),
    ("tresca", |f| f.tresca),
    ("shakedown", |f| f.shakedown),
];

/// A criterion on stresses of shape (time, points, 6): arrays over the points.
///
/// `plastic_strain` has that shape; without it the points stay elastic.
#[pyfunction]
#[pyo3(signature = (criterion, stress, plastic_strain = None, *, tolerance: "float") -> "dict[str, NDArray[np.float64]]")]
pub(crate) fn criterion_on<'py>(
    py: Python<'py>,
    criterion: Criterion,
    stress: Array<'py, Ix3>,
    plastic_strain: Option<Array<'py, Ix3>>,
    #[pyo3(from_py_with = number)] tolerance: f64,
) -> Answer<Bound<'py, PyDict>> {
    let stop = Arc::default();
    let history = core::History {
        stress: stress.as_array(),
        plastic: plastic_strain.as_ref().map(|strain| strain.as_array()),
    };
    let search = core::Search {
        tolerance,
        ..core::Search::default()
    };
    let work = || core::evaluate(&criterion.0, &history, &search, &stop);
    let points = interruptible(py, &stop, work)??;
    let fields = PyDict::new(py);
    for (name, number) in AT_POINT {
        let values: Array1<f64> = points.iter().map(number).collect();
        fields.set_item(name, values.into_pyarray(py))?;
    }
    let normal = Array2::from_shape_fn((points.len(), 3), |(n, d)| points[n].normal[d]);
    fields.set_item("normal", normal.into_pyarray(py))?;
    Ok(fields)
}

/// Load factors of first yield and shakedown of stresses of shape (time, points, 6).
#[pyfunction]
#[pyo3(signature = (stress, *, s_y: "YieldStress", constant: "tuple[float, float, float, float, float, float]") -> "dict[str, NDArray[np.float64]]")]
pub(crate) fn yielding_on<'py>(
    py: Python<'py>,
    stress: Array<'py, Ix3>,
    #[pyo3(from_py_with = Given::s_y)] s_y: f64,
    #[pyo3(from_py_with = number)] constant: [f64; 6],
) -> Answer<Bound<'py, PyDict>> {
    let (view, stop) = (stress.as_array(), Arc::default());
    let work = || core::yielding(&view, s_y, &constant, &stop);
    let points = interruptible(py, &stop, work)??;
    let factors = PyDict::new(py);
    for (name, factor) in FACTORS {
        let values: Array1<f64> = points.iter().map(factor).collect();
        factors.set_item(name, values.into_pyarray(py))?;
    }
    let residual = Array2::from_shape_fn((points.len(), 6), |(n, c)| points[n].residual[c]);
    factors.set_item("residual", residual.into_pyarray(py))?;
    Ok(factors)
}

/// The path of one point in Dang Van's plane.
///
/// From its stress of shape (time, 6): tau and hydrostatic stress at every instant.
#[pyfunction]
#[pyo3(signature = (stress) -> "NDArray[np.float64]")]
pub(crate) fn dang_van_path<'py>(
    py: Python<'py>,
    stress: Array<'py, Ix2>,
) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
    let stress = stress.as_array();
    if stress.ncols() != 6 {
        let allowed = "6 long: xx, yy, zz, xy, xz, yz";
        let columns = stress.ncols();
        refuse!("last axis of stress = {columns}: must be {allowed}");
    }
    let rows = stress.rows().into_iter();
    let stress: Vec<_> = rows.map(|s| std::array::from_fn(|c| s[c])).collect();
    let path = core::dang_van_path(&stress);
    let path = Array2::from_shape_fn(
        (path.len(), 2),
        |(t, k)| {
            if k == 0 { path[t].0 } else { path[t].1 }
        },
    );
    Ok(path.into_pyarray(py))
}
