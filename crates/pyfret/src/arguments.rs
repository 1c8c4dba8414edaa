//! Arguments that several functions take.

use contact_core::fields::Side;
use numpy::{AllowTypeChange, PyArrayLike2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A field on the grid.
pub(crate) type Field<'py> = PyArrayLike2<'py, f64, AllowTypeChange>;

/// The side of body 1 or 2.
pub(crate) fn side(body_number: u8) -> PyResult<Side> {
    match body_number {
        1 => Ok(Side::Body1),
        2 => Ok(Side::Body2),
        n => Err(PyValueError::new_err(format!(
            "body_number = {n}: must be 1 or 2"
        ))),
    }
}
