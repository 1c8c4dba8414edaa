//! Arguments that several functions take.

use std::ops::Deref;

use contact_core::memory::available_memory;
use contact_subsurface::Side;
use ndarray::{Dimension, Ix2};
use numpy::{AllowTypeChange, PyArrayLike, PyReadonlyArray};
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyString;

/// An array of numbers, or what makes one, without masked values; copies of it fit into memory.
pub(crate) struct Array<'py, D: Dimension>(PyArrayLike<'py, f64, D, AllowTypeChange>);

/// A field on the grid.
pub(crate) type Field<'py> = Array<'py, Ix2>;

/// Copies of an array that are made of it at most.
const COPIES: f64 = 4.0;

impl<'py, D: Dimension> Deref for Array<'py, D> {
    type Target = PyArrayLike<'py, f64, D, AllowTypeChange>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<'a, 'py, D: Dimension + 'py> FromPyObject<'a, 'py> for Array<'py, D> {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if is_masked(&value)? {
            return Err(PyValueError::new_err(
                "has masked values: must have a number everywhere, filled(0.0) for one",
            ));
        }
        let array: PyArrayLike<'py, f64, D, AllowTypeChange> = value.extract()?;
        must_fit(array.as_array().len(), 8.0)?;
        Ok(Self(array))
    }
}

/// An array of yes and no; copies of it fit into memory.
pub(crate) struct Mask<'py, D: Dimension>(PyReadonlyArray<'py, bool, D>);

impl<'py, D: Dimension> Deref for Mask<'py, D> {
    type Target = PyReadonlyArray<'py, bool, D>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<'a, 'py, D: Dimension + 'py> FromPyObject<'a, 'py> for Mask<'py, D> {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let array: PyReadonlyArray<'py, bool, D> = value.extract()?;
        must_fit(array.as_array().len(), 1.0)?;
        Ok(Self(array))
    }
}

/// Refuses arrays of so many numbers of so many bytes whose copies do not fit: one that repeats its numbers takes no memory,
/// a copy of it does.
fn must_fit(numbers: usize, bytes: f64) -> PyResult<()> {
    if COPIES * bytes * numbers as f64 > available_memory() {
        return Err(PyMemoryError::new_err(format!(
            "an array of {numbers} numbers does not fit into memory"
        )));
    }
    Ok(())
}

/// Values one after another. What an object says of its length is not trusted.
#[derive(Default)]
pub(crate) struct List<T>(pub(crate) Vec<T>);

impl<T> Deref for List<T> {
    type Target = Vec<T>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<T> IntoIterator for List<T> {
    type Item = T;
    type IntoIter = std::vec::IntoIter<T>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'py, T: FromPyObjectOwned<'py>> FromPyObject<'_, 'py> for List<T> {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if value.is_instance_of::<PyString>() {
            return Err(PyTypeError::new_err("must be a list of values, not a text"));
        }
        let length = value.len()?;
        let mut values = Vec::new();
        for item in value.try_iter()? {
            if values.len() == length {
                return Err(PyValueError::new_err(format!(
                    "says that it has {length} values and gives more"
                )));
            }
            values
                .try_reserve(1)
                .map_err(|e| PyMemoryError::new_err(e.to_string()))?;
            values.push(item?.extract::<T>().map_err(Into::into)?);
        }
        Ok(Self(values))
    }
}

/// Whether an array has values that its mask hides.
fn is_masked(value: &Bound<'_, PyAny>) -> PyResult<bool> {
    if !value.hasattr("mask")? {
        return Ok(false);
    }
    let ma = value.py().import("numpy.ma")?;
    ma.call_method1("is_masked", (value,))?.extract()
}

/// The array with NaN where its mask hides a value.
pub(crate) fn with_holes<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    if !is_masked(value)? {
        return Ok(value.clone());
    }
    let numbers = value.call_method1("astype", ("float64",))?;
    numbers.call_method1("filled", (f64::NAN,))
}

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
