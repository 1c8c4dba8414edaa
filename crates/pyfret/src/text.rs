//! Files of text in any encoding; numbers as people read them.

use contact_core::scene::{read_file, text_of_numbers};
use contact_core::{Error, digits};
use pyo3::types::PyBytes;

use crate::error::Answer;
use crate::prelude::*;

/// The text of a file of numbers, in UTF-8, UTF-16 or Latin-1.
#[pyfunction]
pub(crate) fn read_text(path: PathBuf) -> Answer<String> {
    let failed = |message: String| Error::File {
        path: path.display().to_string(),
        message,
    };
    Ok(text_of_numbers(read_file(&path)?).map_err(failed)?)
}

/// The bytes of a file that somebody names.
///
/// A pipe, a device or a file that would not fit into memory is refused before it is read.
#[pyfunction]
pub(crate) fn read_bytes(py: Python<'_>, path: PathBuf) -> Answer<Bound<'_, PyBytes>> {
    Ok(PyBytes::new(py, &read_file(&path)?))
}

/// A text whose control codes and marks that turn the direction of reading stand as escapes.
#[pyfunction]
pub(crate) fn shown(text: &str) -> String {
    contact_core::shown(text).into_owned()
}

/// A table as text, of lines of at most `width` characters.
///
/// Columns that do not fit stand below, beside the first `keys` columns again.
#[pyfunction]
pub(crate) fn table_text(
    titles: Vec<String>,
    rows: Vec<Vec<String>>,
    keys: usize,
    width: usize,
) -> String {
    fret_cli::layout::table_text(&titles, &rows, keys, width)
}

/// A text whose lines that are wider than `width` are wrapped.
#[pyfunction]
pub(crate) fn wrap_text(text: &str, width: usize) -> String {
    fret_cli::wrapping::wrap_text(text, width)
}

/// A number and its error, with the digits that the error leaves; an estimate without one.
#[pyfunction]
#[pyo3(signature = (value: "float", error: "float | None" = None))]
pub(crate) fn with_error(
    #[pyo3(from_py_with = number)] value: f64,
    #[pyo3(from_py_with = number)] error: Option<f64>,
) -> String {
    digits::with_error(value, error)
}

/// An angle [degrees] to a tenth, with its unit.
#[pyfunction]
#[pyo3(signature = (angle: "float"))]
pub(crate) fn degrees(#[pyo3(from_py_with = number)] angle: f64) -> String {
    digits::degrees(angle)
}

/// The coordinate `at` [m], or 0 where it is rounding of `size` [m], its grid's length.
#[pyfunction]
#[pyo3(signature = (at: "float", size: "float"))]
pub(crate) fn rounded_place(
    #[pyo3(from_py_with = number)] at: f64,
    #[pyo3(from_py_with = number)] size: f64,
) -> f64 {
    digits::place(at, size)
}

/// A number in two digits, which is known to no more.
#[pyfunction]
#[pyo3(signature = (value: "float"))]
pub(crate) fn rough(#[pyo3(from_py_with = number)] value: f64) -> String {
    digits::known_to_two(value)
}

/// A number and the range that it lies in, with the digits that the range leaves.
#[pyfunction]
#[pyo3(signature = (value: "float", low: "float", high: "float"))]
pub(crate) fn with_range(
    #[pyo3(from_py_with = number)] value: f64,
    #[pyo3(from_py_with = number)] low: f64,
    #[pyo3(from_py_with = number)] high: f64,
) -> String {
    digits::with_range(value, [low, high])
}
