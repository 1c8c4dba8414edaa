//! The flat surface.

use pyo3::prelude::*;

use crate::parts::parts;

/// The contact plane itself.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.shapes")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Flat;

parts!(Flat:);

#[pymethods]
impl Flat {
    #[new]
    fn new() -> Self {
        Self
    }

    #[expect(clippy::unused_self, reason = "Python passes it")]
    pub(super) fn __repr__(&self) -> &'static str {
        "Flat()"
    }
}
