//! A measured surface.

use contact_core::Error;
use contact_core::scene as core;
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyTypeError;

use super::super::Pitch;
use crate::error::{Answer, InvalidSceneError, StoreError};
use crate::hints::Numbers;
use crate::prelude::*;
use crate::python::from_python;

/// Numbers over the contact plane, the middle of the map over the origin.
///
/// As the shape of a body they are heights out of it, towards the other one [m]. In a friction law
/// they are factors of mu.
///
/// Parameters
/// ----------
/// values : array of shape (points along x, points along y)
///     The numbers.
/// spacing : float or (float, float)
///     Distance of the points along x and y [m]. In between they are interpolated linearly.
/// missing : "refuse", "crop" or "fill"
///     What becomes of points that are NaN or masked. "refuse": an error with their place. "crop":
///     lines are taken off the edges. "fill": the mean of the neighbours, where at most a tenth of
///     the points is missing and no hole is wider than ten.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.shapes")]
#[derive(Clone, PartialEq)]
pub(crate) struct SurfaceMap(pub(crate) core::SurfaceMap);

parts!(SurfaceMap: values, spacing);

#[pymethods]
impl SurfaceMap {
    #[new]
    #[pyo3(signature = (values: "ArrayLike", *, spacing, missing: "Literal['refuse', 'crop', 'fill']" = "refuse"))]
    fn new(values: &Bound<'_, PyAny>, spacing: Pitch, missing: &str) -> Answer<Self> {
        let allowed = "an array of numbers of shape (points along x, points along y)";
        let numbers = Field::with_holes(values).map_err(|error| {
            if error.is_instance_of::<PyTypeError>(values.py()) {
                must_be(values, allowed)
            } else {
                InvalidSceneError::new_err(error.value(values.py()).to_string())
            }
        })?;
        numbers.must_have_pitch("values", "points of the map, spacing,", spacing.0)?;
        let numbers = numbers.as_array().to_owned();
        let map = core::SurfaceMap::new(numbers, spacing.0, word(missing)?);
        warn_of_filled(values.py(), map?)
    }

    /// Read numbers from a file: a ``.npy`` array, or text of instruments and spreadsheets.
    ///
    /// Text is UTF-8, UTF-16 or Latin-1; its numbers are parted by semicolons, tabs, commas or
    /// blanks, with decimal points or commas. The text is a table, one line per x, with or without
    /// titles. Or it has points x, y and height in any order, Gwyddion's export, or an ESRI grid. A
    /// profile is refused.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The file.
    /// spacing : float or (float, float), optional
    ///     Distance of the points along x and y [m], where the file does not have it.
    /// unit : str, optional
    ///     Unit of the numbers, such as "um"; by default the unit of the file, or metres. It
    ///     holds for x and y of a list of points, too.
    /// channel : str, optional
    ///     Of a list of points with several columns beside x and y, the title or the number
    ///     (from 1) of the one that is meant.
    /// missing : "refuse", "crop" or "fill"
    ///     What becomes of points without a number (blank, NaN or the mark of the header).
    ///     "refuse": an error with their place. "crop": lines are taken off the edges. "fill": the
    ///     mean of the neighbours, where at most a tenth of the points is missing and no hole is
    ///     wider than ten.
    ///
    /// Raises
    /// ------
    /// StoreError
    ///     If the file cannot be read, contradicts the arguments, or leaves something open. The
    ///     message has the line, the column and the argument to give.
    #[staticmethod]
    #[pyo3(signature = (path, *, spacing = None, unit = None, channel = None, missing: "Literal['refuse', 'crop', 'fill']" = "refuse"))]
    fn from_file(
        py: Python<'_>,
        path: PathBuf,
        spacing: Option<Pitch>,
        unit: Option<String>,
        channel: Option<String>,
        missing: &str,
    ) -> Answer<Self> {
        let file = core::FileOfNumbers {
            spacing: spacing.map(|spacing| spacing.0),
            unit,
            channel,
            missing: word(missing)?,
        };
        let map = py.detach(|| core::SurfaceMap::from_file(&path, &file));
        warn_of_filled(py, map?)
    }

    /// Describe the map: points, pitch, size, form, and the parameters without the form.
    ///
    /// A ball that was measured with its curvature is named as such, with its radius.
    #[pyo3(signature = () -> "str")]
    fn summary<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "summarize_map")?.call1((slf,))
    }

    /// Return the parameters of the heights after ISO 25178-2 about their mean.
    ///
    /// S_q, S_a, S_z, S_sk, S_ku and S_dq, with the pitch of the slope. The heights are
    /// taken as they are: subtract the form and filter first.
    #[pyo3(signature = () -> "Statistics")]
    fn statistics<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "statistics")?.call1((slf,))
    }

    /// Fit a form by least squares: its slopes, radii and heights.
    ///
    /// Parameters
    /// ----------
    /// form : "plane", "sphere", "paraboloid" or "cubic"
    ///     A sphere is replaced by its paraboloid, as every curved shape.
    #[pyo3(signature = (form: "Literal['plane', 'sphere', 'paraboloid', 'cubic']") -> "Form")]
    fn fit_form<'py>(slf: &Bound<'py, Self>, form: &str) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "fit_form")?.call1((slf, form))
    }

    /// Return the map without a form; :meth:`fit_form` gives the radius of what is subtracted.
    ///
    /// Parameters
    /// ----------
    /// form : "plane", "sphere", "paraboloid" or "cubic"
    ///     The form that is fitted by least squares and subtracted (default "plane").
    #[pyo3(signature = (form: "Literal['plane', 'sphere', 'paraboloid', 'cubic']" = "plane") -> "SurfaceMap")]
    fn level<'py>(slf: &Bound<'py, Self>, form: &str) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "level")?.call1((slf, form))
    }

    /// Return the map without waves that are shorter or longer than cut-offs.
    ///
    /// The filters are Gaussian (ISO 16610-61): half of a wave as long as the cut-off passes. At
    /// the border the weights are normalised.
    ///
    /// Parameters
    /// ----------
    /// short, long : float, optional
    ///     Cut-off wavelengths [m]: shorter than `short` is removed, and longer than `long`.
    #[pyo3(signature = (*, short: "Length | None" = None, long: "Length | None" = None) -> "SurfaceMap")]
    fn filter<'py>(
        slf: &Bound<'py, Self>,
        short: Option<&Bound<'py, PyAny>>,
        long: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "filter_waves")?.call1((slf, short, long))
    }

    /// Return the map on other points, by a cosine series through all of its points.
    ///
    /// Finer points show the waves of the map between them. Coarser points leave out the waves that
    /// they cannot carry. The size of the map stays.
    ///
    /// Parameters
    /// ----------
    /// spacing : float or (float, float), optional
    ///     Distance of the new points [m], rounded to a whole number of them.
    /// n : int or (int, int), optional
    ///     Number of the new points along x and y.
    #[pyo3(signature = (*, spacing = None, n: "int | tuple[int, int] | None" = None) -> "SurfaceMap")]
    fn resample<'py>(
        slf: &Bound<'py, Self>,
        spacing: Option<Pitch>,
        n: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let spacing = spacing.map(|spacing| spacing.0);
        from_python(slf.py(), "resample")?.call1((slf, spacing, n))
    }

    /// Return the power spectral density of the heights, mean over directions [m^4].
    #[pyo3(signature = () -> "xr.DataArray")]
    fn spectrum<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "spectrum")?.call1((slf,))
    }

    /// Write the heights as a table of text: x, y and z of a point in m on each line.
    ///
    /// :func:`pyfret.read_surface` reads it. A file that is there is replaced.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The file.
    #[pyo3(signature = (path: "str | PathLike[str]") -> "None")]
    fn to_csv<'py>(
        slf: &Bound<'py, Self>,
        path: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "write_heights")?.call1((slf, path))
    }

    /// Draw the heights; return the axes.
    #[pyo3(signature = (ax: "Axes | None" = None) -> "Axes")]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        ax: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "surface_heights")?.call1((slf, ax))
    }

    pub(super) fn __repr__(&self) -> String {
        let (nx, ny) = self.0.values.dim();
        let filled = match self.0.filled {
            0 => String::new(),
            n => format!(" ({n} of them filled)"),
        };
        format!(
            "SurfaceMap({nx} x {ny} numbers{filled}, spacing={:?})",
            self.0.spacing
        )
    }
}

attributes!(SurfaceMap, self, py:
    /// The numbers.
    values: Numbers<'py> = self.0.values.to_pyarray(py).into();
);

attributes!(SurfaceMap, self:
    /// How many of the numbers were not measured: each is the mean of its neighbours.
    filled: usize = self.0.filled;
    /// Distance of the points along x and y [m].
    spacing: (f64, f64) = self.0.spacing;
    /// Root of the mean square about the mean: S_q of heights [m].
    rms: f64 = self.0.rms();
    /// Largest less smallest number: S_z of heights [m].
    peak_to_valley: f64 = self.0.peak_to_valley();
);

/// Build the map of measured heights less their mean; return it and its S_q [m].
#[pyfunction]
#[pyo3(signature = (heights, *, spacing, missing: "Literal['refuse', 'crop', 'fill']") -> "tuple[SurfaceMap, float]")]
pub(crate) fn map_from_heights(
    heights: &Bound<'_, PyAny>,
    spacing: (f64, f64),
    missing: &str,
) -> Answer<(SurfaceMap, f64)> {
    let numbers: PyReadonlyArray2<'_, f64> = heights.extract()?;
    let view = numbers.as_array();
    let (map, rms) = core::SurfaceMap::from_heights(&view, spacing, word(missing)?)?;
    Ok((warn_of_filled(heights.py(), map)?, rms))
}

/// Refuse a map of a file that is larger or smaller than any instrument measures.
#[pyfunction]
pub(crate) fn check_sides(shape: (usize, usize), spacing: (f64, f64)) -> Answer<()> {
    core::check_sides(shape, spacing).map_err(|message| StoreError::new_err(message).into())
}

/// Wraps a map, with a warning if points were filled.
fn warn_of_filled(py: Python<'_>, map: core::SurfaceMap) -> Answer<SurfaceMap> {
    if map.filled > 0 {
        let (filled, all) = (map.filled, map.values.len());
        let share = 100.0 * filled as f64 / all as f64;
        let digits = if share < 0.1 { 3 } else { 1 };
        let text = format!(
            "{filled} of {all} points ({share:.digits$} %) were not measured: each has the mean of its neighbours"
        );
        from_python(py, "warn")?.call1((text,))?;
    }
    Ok(SurfaceMap(map))
}

/// Reads the treatment of points without a number.
fn word(missing: &str) -> Answer<core::Missing> {
    core::Missing::from_word(missing).ok_or_else(|| {
        let allowed = "\"refuse\", \"crop\" or \"fill\"";
        Error::invalid("missing", missing, allowed).into()
    })
}
