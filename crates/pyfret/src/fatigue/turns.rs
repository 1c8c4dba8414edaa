//! Turns of a record.

use numpy::{PyArray1, PyReadonlyArray1};

use crate::prelude::*;

/// Indices of the points where a record goes back by more than a part of its range.
///
/// The first and the last one count if they are farther from the middle of the range than `outer`
/// of its half.
#[pyfunction]
pub(crate) fn find_turns<'py>(
    py: Python<'py>,
    record: PyReadonlyArray1<'py, f64>,
    part: f64,
    outer: f64,
) -> Bound<'py, PyArray1<i64>> {
    let record = record.as_array();
    let record = record.as_standard_layout();
    let turns = fatigue::find_turns(record.as_slice().unwrap_or_default(), part, outer);
    let turns: Vec<i64> = turns.into_iter().map(|turn| turn as i64).collect();
    turns.into_pyarray(py)
}
