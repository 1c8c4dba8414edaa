//! Cracks below a contact.

use ::fracture as of_cracks;
use contact_assess::crack as core;
use contact_subsurface as subsurface;
use ndarray::Array2;

use super::names::{named, set_path};
use crate::error::Answer;
use crate::prelude::*;
use crate::residual_stress::{Profiles, of_body};
use crate::scene::Body;
use crate::states::States;

/// Calls `f` below a contact in its states.
fn below_contact<T: Send>(
    py: Python<'_>,
    (body, body_number): (&Body, u8),
    states: &States,
    residual: Profiles,
    f: impl FnOnce(&core::Below<'_>, &subsurface::States<'_>) -> Result<T, contact_core::Error> + Send,
) -> Answer<T> {
    let (grid, moments) = states.parts();
    let residual = of_body(&body.0, residual)?;
    let below = core::Below {
        body: &body.0,
        side: side(body_number)?,
        grid,
    };
    let answer = stoppable(py, |stop| {
        moments.with_states(Some(&residual), stop, |states| f(&below, &states))
    })??;
    Ok(answer)
}

/// K over (state, length), as named arrays.
fn tables<'py>(py: Python<'py>, found: &[core::OverCycle]) -> PyResult<Bound<'py, PyDict>> {
    let states = found.first().map_or(0, |over| over.faces.len());
    let table = |f: &dyn Fn(&core::OverCycle, usize) -> f64| {
        Array2::from_shape_fn((states, found.len()), |(n, l)| f(&found[l], n)).into_pyarray(py)
    };
    let result = PyDict::new(py);
    result.set_item("K_I", table(&|c, n| c.faces[n].K_I))?;
    result.set_item("K_II", table(&|c, n| c.faces[n].K_II))?;
    result.set_item("K_I_linear", table(&|c, n| c.linear[n].K_I))?;
    result.set_item("K_II_linear", table(&|c, n| c.linear[n].K_II))?;
    result.set_item("error", table(&|c, n| c.faces[n].error))?;
    result.set_item("open", table(&|c, n| c.open[n]))?;
    Ok(result)
}

/// K of cracks below a contact in several of its states; use :meth:`pyfret.Result.crack`.
#[pyfunction]
#[pyo3(signature = (body, states, *, residual = None, x: "float", lengths: "Sequence[float]", angle: "Angle" = 0.0, kink: "tuple[float, float] | None" = None, azimuth: "Angle" = 0.0, offset: "float" = 0.0, friction: "float" = 0.0, body_number: "int" = 2) -> "dict[str, NDArray[np.float64]]")]
pub(crate) fn crack_of_states<'py>(
    py: Python<'py>,
    body: Body,
    states: PyRef<'_, States>,
    residual: Profiles,
    #[pyo3(from_py_with = number)] x: f64,
    lengths: List<f64>,
    #[pyo3(from_py_with = Given::angle)] angle: f64,
    #[pyo3(from_py_with = number)] kink: Option<(f64, f64)>,
    #[pyo3(from_py_with = Given::azimuth)] azimuth: f64,
    #[pyo3(from_py_with = number)] offset: f64,
    #[pyo3(from_py_with = number)] friction: f64,
    #[pyo3(from_py_with = number)] body_number: u8,
) -> PyResult<Bound<'py, PyDict>> {
    let cracks = core::Cracks {
        x,
        angle,
        kink,
        azimuth,
        offset,
        lengths: lengths.0,
        friction,
    };
    let cracks = below_contact(
        py,
        (&body, body_number),
        &states,
        residual,
        |below, states| core::over_cycle(below, states, &cracks),
    )?;
    tables(py, &cracks)
}

/// A crack that grows below a contact; use :meth:`pyfret.Result.grow_crack`.
#[pyfunction]
#[pyo3(signature = (body, states, *, residual = None, x: "float", start: "float", end: "float", direction, tolerance: "float", angle: "Angle" = 0.0, azimuth: "Angle" = 0.0, offset: "float" = 0.0, friction: "float" = 0.0, body_number: "int" = 2) -> "dict[str, Any]")]
pub(crate) fn crack_growth_of_states<'py>(
    py: Python<'py>,
    body: Body,
    states: PyRef<'_, States>,
    residual: Profiles,
    #[pyo3(from_py_with = number)] x: f64,
    #[pyo3(from_py_with = number)] start: f64,
    #[pyo3(from_py_with = number)] end: f64,
    direction: &str,
    #[pyo3(from_py_with = number)] tolerance: f64,
    #[pyo3(from_py_with = Given::angle)] angle: f64,
    #[pyo3(from_py_with = Given::azimuth)] azimuth: f64,
    #[pyo3(from_py_with = number)] offset: f64,
    #[pyo3(from_py_with = number)] friction: f64,
    #[pyo3(from_py_with = number)] body_number: u8,
) -> Answer<Bound<'py, PyDict>> {
    let growth = core::Growth {
        x,
        angle,
        azimuth,
        offset,
        start,
        growing: of_cracks::Growing {
            direction: core::direction_named(direction)?,
            to: end,
            friction,
            tolerance,
        },
    };
    let growth = below_contact(
        py,
        (&body, body_number),
        &states,
        residual,
        |below, states| core::grown(below, states, &growth),
    )?;
    let result = tables(py, &growth.over)?;
    set_path(py, &result, &growth.tips)?;
    result.set_item("path_error", growth.error)?;
    result.set_item("end", named(growth.end))?;
    Ok(result)
}
