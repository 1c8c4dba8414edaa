//! Files of text in any encoding.

use std::path::PathBuf;

use contact_core::Error;
use contact_core::scene::text_of_numbers;
use pyo3::prelude::*;

use crate::error::to_python;

/// The text of a file of numbers, in UTF-8, UTF-16 or Latin-1.
#[pyfunction]
pub(crate) fn read_text(path: PathBuf) -> PyResult<String> {
    let failed = |message: String| {
        to_python(Error::File {
            path: path.display().to_string(),
            message,
        })
    };
    let bytes = std::fs::read(&path).map_err(|e| failed(e.to_string()))?;
    text_of_numbers(bytes).map_err(failed)
}
