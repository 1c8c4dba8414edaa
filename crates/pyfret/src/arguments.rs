//! Arguments that several functions take, and the door for all numbers and arrays.
//!
//! Arrays go through `pyfret._util.arrays`, which knows labels, masks and kinds; numbers and lists of
//! them go through [`number`]: True and False are no numbers.

use std::ops::Deref;

use crate::hints::sequence_of;
use crate::prelude::*;
use crate::python::from_python;
use contact_core::memory::available_memory;
use contact_core::scene::{Grid, convert_to_si};
use contact_subsurface::Side;
use ndarray::{Dimension, Ix2};
use numpy::{AllowTypeChange, PyArrayLike, PyReadonlyArray};
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyMemoryError, PyTypeError};
use pyo3::types::{PyBool, PyFloat, PyInt, PyList, PyString, PyTuple};

/// Reads an argument that is a number, or holds numbers. True and False are refused, wherever they stand.
pub(crate) fn number<'py, T: FromPyObjectOwned<'py>>(value: &Bound<'py, PyAny>) -> PyResult<T> {
    refuse_truths(value)?;
    let extracted: Result<T, _> = value.extract();
    match extracted {
        Ok(extracted) => Ok(extracted),
        Err(error) => {
            refuse_texts(value)?;
            Err(error.into())
        }
    }
}

/// Refuses a text or a quantity of pint where the unit of the number is not known; the error has the number to
/// write.
fn refuse_texts(value: &Bound<'_, PyAny>) -> PyResult<()> {
    let Some(text) = crate::document::text_of(value)? else {
        return Ok(());
    };
    let write = convert_to_si(&text).map_or(", not a text".to_owned(), |(number, unit)| {
        format!(" in SI units: write {number:?}, which is in {unit}")
            .trim_end_matches(", which is in ")
            .to_owned()
    });
    Err(PyTypeError::new_err(format!(
        "{text:?}: must be a number{write}"
    )))
}

/// Refuses True and False, also within lists and tuples.
fn refuse_truths(value: &Bound<'_, PyAny>) -> PyResult<()> {
    if value.is_instance_of::<PyFloat>() || value.is_exact_instance_of::<PyInt>() {
        return Ok(());
    }
    let kind = value
        .getattr("dtype")
        .and_then(|of| of.getattr("kind")?.extract::<String>());
    if value.is_instance_of::<PyBool>() || kind.is_ok_and(|kind| kind == "b") {
        return Err(PyTypeError::new_err(format!(
            "{}: must be a number, which True and False are not",
            value.repr()?
        )));
    }
    if value.is_instance_of::<PyTuple>() || value.is_instance_of::<PyList>() {
        for item in value.try_iter()? {
            refuse_truths(&item?)?;
        }
    }
    Ok(())
}

/// An array of numbers, or what makes one, by the rules of `pyfret._util.arrays`; copies of it fit into
/// memory.
pub(crate) struct Array<'py, D: Dimension> {
    numbers: PyArrayLike<'py, f64, D, AllowTypeChange>,
    /// Distances of the points along x and y, from the labels \[m\].
    pitch: [Option<f64>; 2],
}

/// A field on the grid.
pub(crate) type Field<'py> = Array<'py, Ix2>;

/// Part of the distance of points by which their coordinates may differ from it.
const UNEVEN: f64 = 1e-3;
/// Copies of an array that are made of it at most.
const COPIES: f64 = 4.0;
/// Memory of copies that is not compared with the memory of the system \[bytes\].
const ALWAYS_FITS: f64 = 16e6;

impl<'py, D: Dimension> Deref for Array<'py, D> {
    type Target = PyArrayLike<'py, f64, D, AllowTypeChange>;

    /// The array as ndarray sees it.
    fn deref(&self) -> &Self::Target {
        &self.numbers
    }
}

impl Field<'_> {
    /// The numbers in row-major order; fails if the shape is not the one of the grid. `name` names the field in
    /// the error.
    pub(crate) fn on_grid(&self, name: &str, grid: &Grid) -> PyResult<Vec<f64>> {
        let (shape, numbers) = ((grid.nx, grid.ny), self.as_array());
        if numbers.dim() != shape {
            refuse!(
                "{name} has the shape {:?}: must be the grid's, {shape:?}",
                numbers.dim()
            );
        }
        self.must_have_pitch(name, "cells of the grid", (grid.dx, grid.dy))?;
        Ok(numbers.iter().copied().collect())
    }

    /// Fails if the labels of the field have another spacing than the `given` one along x and y \[m\]. `what`
    /// describes the points.
    pub(crate) fn must_have_pitch(
        &self,
        name: &str,
        what: &str,
        given: (f64, f64),
    ) -> PyResult<()> {
        for (axis, found, given) in [("x", self.pitch[0], given.0), ("y", self.pitch[1], given.1)] {
            if let Some(found) = found.filter(|found| (found / given - 1.0).abs() > UNEVEN) {
                refuse!(
                    "{name}: its coordinates along {axis} lie {found:.6e} m apart, and the {what} \
                     {given:.6e} m"
                );
            }
        }
        Ok(())
    }
}

impl<'a, 'py, D: Dimension + 'py> FromPyObject<'a, 'py> for Array<'py, D> {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::ARRAY_LIKE;

    /// Reads an array without holes.
    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        Self::through_the_door(&value, false)
    }
}

impl<'py, D: Dimension + 'py> Array<'py, D> {
    /// Reads an array whose missing values, masked or NaN, are holes: NaN.
    pub(crate) fn with_holes(value: &Bound<'py, PyAny>) -> PyResult<Self> {
        Self::through_the_door(value, true)
    }

    /// Reads an array: units, masks and labels are taken off by Python (`plain`); missing values become NaN if
    /// `holes`, and are refused otherwise.
    fn through_the_door(value: &Bound<'py, PyAny>, holes: bool) -> PyResult<Self> {
        if let Ok(size) = value
            .getattr("size")
            .and_then(|size| size.extract::<usize>())
        {
            must_fit(size, 8.0)?;
        }
        let text = crate::document::text_of(value)?;
        if text.is_some_and(|text| convert_to_si(&text).is_some()) {
            refuse_texts(value)?;
        }
        let py = value.py();
        let plain = from_python(py, "plain")?;
        let options = PyDict::new(py);
        options.set_item("holes", holes)?;
        let array: PyArrayLike<'py, f64, D, AllowTypeChange> = plain
            .call((value, "the array"), Some(&options))?
            .extract()?;
        must_fit(array.as_array().len(), 8.0)?;
        let pitch = if value.hasattr("dims")? {
            from_python(py, "pitch")?
                .call1((value, "the array"))?
                .extract()?
        } else {
            [None, None]
        };
        Ok(Self {
            numbers: array,
            pitch,
        })
    }
}

/// An array of yes and no; copies of it fit into memory.
pub(crate) struct Mask<'py, D: Dimension>(PyReadonlyArray<'py, bool, D>);

impl<'py, D: Dimension> Deref for Mask<'py, D> {
    type Target = PyReadonlyArray<'py, bool, D>;

    /// The mask as ndarray sees it.
    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<'a, 'py, D: Dimension + 'py> FromPyObject<'a, 'py> for Mask<'py, D> {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::MASK;

    /// Reads a mask whose copy fits into memory.
    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let array: PyReadonlyArray<'py, bool, D> = value.extract()?;
        must_fit(array.as_array().len(), 1.0)?;
        Ok(Self(array))
    }
}

/// Fails if a copy of so many `numbers` of so many `bytes` each does not fit into memory. An array that repeats
/// its numbers takes little, its copy does not.
pub(crate) fn must_fit(numbers: usize, bytes: f64) -> PyResult<()> {
    let needed = COPIES * bytes * numbers as f64;
    // Reading the memory of the system takes longer than copying a small array.
    if needed > ALWAYS_FITS && needed > available_memory() {
        return Err(PyMemoryError::new_err(format!(
            "an array of {numbers} numbers does not fit into memory"
        )));
    }
    Ok(())
}

/// Values one after another. The length of an object is not trusted.
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

    const INPUT_TYPE: PyStaticExpr = sequence_of!(T::INPUT_TYPE);

    /// Reads any iterable but a text; each value is read by the rule of its type.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if value.is_instance_of::<PyString>() {
            return Err(PyTypeError::new_err("must be a list of values, not a text"));
        }
        let length = value.len()?;
        let mut values = Vec::new();
        for item in value.try_iter()? {
            if values.len() == length {
                refuse!("has the length {length} and yields more values");
            }
            values
                .try_reserve(1)
                .map_err(|e| PyMemoryError::new_err(e.to_string()))?;
            let item = item?;
            // An array has the rule of what takes it: numbers, or yes and no.
            let dimensions = item.getattr("ndim").and_then(|of| of.extract::<usize>());
            values.push(match dimensions {
                Ok(1..) => item.extract().map_err(Into::into)?,
                _ => number(&item)?,
            });
        }
        Ok(Self(values))
    }
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
