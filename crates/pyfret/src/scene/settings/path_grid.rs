//! The grid of increments that are solved for the path alone.

use contact_core::Error;
use contact_core::scene as core;
use pyo3::prelude::*;

use crate::error::{must_be, to_python};

const ALLOWED: &str = "\"auto\", \"same\", or a half or a quarter of the cells along x";

/// The path grid, on its way in or out.
#[derive(IntoPyObject)]
pub(crate) enum PathGrid {
    Cells(usize),
    Named(String),
}

impl<'py> FromPyObject<'_, 'py> for PathGrid {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(name) = value.extract::<String>() {
            return Ok(Self::Named(name));
        }
        let cells = value.extract::<usize>();
        cells.map(Self::Cells).map_err(|_| must_be(&value, ALLOWED))
    }
}

impl PathGrid {
    pub(crate) fn into_core(self) -> PyResult<core::PathGrid> {
        match self {
            Self::Cells(cells) => Ok(core::PathGrid::Cells(cells)),
            Self::Named(name) if name == "auto" => Ok(core::PathGrid::Auto),
            Self::Named(name) if name == "same" => Ok(core::PathGrid::Same),
            Self::Named(name) => Err(to_python(Error::invalid("solver.path_grid", name, ALLOWED))),
        }
    }
}

impl From<core::PathGrid> for PathGrid {
    fn from(path_grid: core::PathGrid) -> Self {
        match path_grid {
            core::PathGrid::Auto => Self::Named("auto".into()),
            core::PathGrid::Same => Self::Named("same".into()),
            core::PathGrid::Cells(cells) => Self::Cells(cells),
        }
    }
}
