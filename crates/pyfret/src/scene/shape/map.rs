//! A measured surface.

use std::path::PathBuf;

use contact_core::Error;
use contact_core::scene as core;
use numpy::{PyArray2, ToPyArray};
use pyo3::prelude::*;

use super::super::Pitch;
use crate::arguments::Field;
use crate::error::{must_be, to_python};
use crate::parts::parts;

/// Numbers over the contact plane, the middle of the map over the origin.
///
/// As the shape of a body they are heights out of it, towards the other one [m]; in a friction law
/// they are factors of mu.
///
/// Parameters
/// ----------
/// values : array of shape (points along x, points along y)
///     The numbers.
/// spacing : float or (float, float)
///     Distance of the points along x and y [m]. In between they are interpolated linearly.
/// missing : "refuse", "crop" or "fill"
///     What becomes of points that are NaN: an error that says where they are; lines taken off the
///     edges; the mean of the neighbours.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.shapes")]
#[derive(Clone, PartialEq)]
pub(crate) struct SurfaceMap(pub(crate) core::SurfaceMap);

parts!(SurfaceMap: values, spacing);

#[pymethods]
impl SurfaceMap {
    #[new]
    #[pyo3(signature = (values, *, spacing, missing = "refuse"))]
    fn new(values: &Bound<'_, PyAny>, spacing: Pitch, missing: &str) -> PyResult<Self> {
        let wanted = "an array of numbers of shape (points along x, points along y)";
        let values: Field<'_> = values.extract().map_err(|_| must_be(values, wanted))?;
        let values = values.as_array().to_owned();
        core::SurfaceMap::new(values, spacing.0, word(missing)?)
            .map(Self)
            .map_err(to_python)
    }

    /// Read numbers from a ``.npy`` array or from a table of text, one line per x.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     An array of real or whole numbers of any size and byte order, or a table parted by
    ///     commas, semicolons, tabs or blanks, with or without a line of titles.
    /// spacing : float or (float, float)
    ///     Distance of the points, along x and y [m].
    /// missing : "refuse", "crop" or "fill"
    ///     What becomes of points without a number (blank or NaN): an error that says where they
    ///     are; lines taken off the edges; the mean of the neighbours.
    #[staticmethod]
    #[pyo3(signature = (path, *, spacing, missing = "refuse"))]
    fn from_file(path: PathBuf, spacing: Pitch, missing: &str) -> PyResult<Self> {
        core::SurfaceMap::from_file(&path, spacing.0, word(missing)?)
            .map(Self)
            .map_err(to_python)
    }

    /// The numbers.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.0.values.to_pyarray(py)
    }

    /// Distance of the points along x and y [m].
    #[getter]
    fn spacing(&self) -> (f64, f64) {
        self.0.spacing
    }

    pub(super) fn __repr__(&self) -> String {
        let (nx, ny) = self.0.values.dim();
        format!(
            "SurfaceMap({nx} x {ny} numbers, spacing={:?})",
            self.0.spacing
        )
    }
}

/// What becomes of points without a number.
fn word(missing: &str) -> PyResult<core::Missing> {
    core::Missing::named(missing).ok_or_else(|| {
        let allowed = "\"refuse\", \"crop\" or \"fill\"";
        to_python(Error::invalid("missing", missing, allowed))
    })
}
