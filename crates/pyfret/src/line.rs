//! Lines of the surface, below which sections lie.

use contact_subsurface::Line;

use crate::prelude::*;
use crate::scene::Grid;

/// Places along a line and their x, y [m].
type Places = (Vec<f64>, Vec<(f64, f64)>);
/// The line y = const (along x), x = const (along y), or through a point x, y at an azimuth; fails if neither x
/// nor y is given.
pub(crate) fn line(x: Option<f64>, y: Option<f64>, azimuth: Option<f64>) -> PyResult<Line> {
    match (x, y, azimuth) {
        (None, Some(y), None) => Ok(Line::AlongX(y)),
        (Some(x), None, None) => Ok(Line::AlongY(x)),
        (Some(x), Some(y), Some(azimuth)) => Ok(Line::through((x, y), azimuth)),
        _ => Err(PyValueError::new_err(
            "a section has either x or y constant, or a point x, y and an azimuth",
        )),
    }
}

/// The line as [`line`], or none if neither x nor y is given.
pub(crate) fn line_if_given(
    x: Option<f64>,
    y: Option<f64>,
    azimuth: Option<f64>,
) -> PyResult<Option<Line>> {
    match (x, y) {
        (None, None) => Ok(None),
        _ => line(x, y, azimuth).map(Some),
    }
}

/// x, y and azimuth that name a line.
pub(crate) type LineName = (Option<f64>, Option<f64>, Option<f64>);

/// x, y and azimuth of a line, as [`line`] takes them.
pub(crate) fn name_of(line: Line) -> LineName {
    match line {
        Line::AlongX(y) => (None, Some(y), None),
        Line::AlongY(x) => (Some(x), None, None),
        Line::Through { x, y, azimuth } => (Some(x), Some(y), Some(azimuth)),
    }
}

/// x, y and azimuth of the line through a point at an angle; along an axis x or y alone.
#[pyfunction]
#[pyo3(signature = (x: "float", y: "float", azimuth: "Angle"))]
pub(crate) fn line_through(
    #[pyo3(from_py_with = number)] x: f64,
    #[pyo3(from_py_with = number)] y: f64,
    #[pyo3(from_py_with = Given::azimuth)] azimuth: f64,
) -> LineName {
    name_of(Line::through((x, y), azimuth))
}

/// Places along a line on a grid, and their x, y [m].
#[pyfunction]
#[pyo3(signature = (grid, *, x: "float | None" = None, y: "float | None" = None, azimuth: "Angle | None" = None))]
pub(crate) fn line_places(
    grid: Grid,
    #[pyo3(from_py_with = number)] x: Option<f64>,
    #[pyo3(from_py_with = number)] y: Option<f64>,
    #[pyo3(from_py_with = Optional::azimuth)] azimuth: Option<f64>,
) -> PyResult<Places> {
    let line = line(x, y, azimuth)?;
    let places = line.places(&grid.0);
    let at = places.iter().map(|s| line.place(*s)).collect();
    Ok((places, at))
}
