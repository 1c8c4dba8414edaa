//! Doubts of numbers that are allowed and hardly meant.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::number;

/// The doubt of a number, if it is hardly meant, by the name of its quantity.
#[pyfunction]
#[pyo3(signature = (quantity, key, value: "float"))]
pub(crate) fn doubt(
    quantity: &str,
    key: &str,
    #[pyo3(from_py_with = number)] value: f64,
) -> PyResult<Option<String>> {
    if plausible::QUANTITIES.iter().all(|q| q.name != quantity) {
        return Err(PyValueError::new_err(format!("no quantity {quantity:?}")));
    }
    Ok(plausible::doubt(quantity, key, value))
}
