//! Closed forms of `contact_reference`.

mod cattaneo_mindlin;
mod hertz_contact;
mod hertz_stress;
mod indentation;
mod lubkin;
mod plane_strain;
mod springs;

use contact_core::Error;
use contact_core::scene as core;
use contact_reference::domain;
use ndarray::IxDyn;
use numpy::{PyArrayDyn, ToPyArray};
use pyo3::prelude::*;

use crate::argument::to_python;
use crate::arguments::Array;
use crate::material::Material;

pub(crate) use cattaneo_mindlin::CattaneoMindlin;
pub(crate) use hertz_contact::{Hertz, HertzEllipse, hertz, hertz_ellipse};
pub(crate) use hertz_stress::HertzStress;
pub(crate) use indentation::{
    CoatedIndentation, CoupledIndentation, coated_indentation, coupled_indentation, dundurs_beta,
    goodman_stick_ratio,
};
pub(crate) use lubkin::Lubkin;
pub(crate) use plane_strain::{LineContact, line_contact};
pub(crate) use springs::Springs;

/// A number, a sequence or an array of any shape.
type Numbers<'py> = Array<'py, IxDyn>;

/// `f` of every number, in the shape that they came in.
fn map<'py>(
    py: Python<'py>,
    x: &Numbers<'py>,
    f: impl Fn(f64) -> f64,
) -> Bound<'py, PyArrayDyn<f64>> {
    x.as_array().mapv(f).to_pyarray(py)
}

/// The same, each number checked first.
fn map_checked<'py>(
    py: Python<'py>,
    x: &Numbers<'py>,
    check: impl Fn(f64) -> Result<f64, Error>,
    f: impl Fn(f64) -> f64,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    checked(x, check)?;
    Ok(map(py, x, f))
}

/// Fails at the first number that `check` refuses; what is not a number passes.
fn checked(x: &Numbers<'_>, check: impl Fn(f64) -> Result<f64, Error>) -> PyResult<()> {
    let array = x.as_array();
    let mut numbers = array.iter().filter(|x| !x.is_nan());
    numbers
        .try_for_each(|x| check(*x).map(drop))
        .map_err(to_python)
}

/// The materials of a pair, checked.
fn pair((body1, body2): (Material, Material)) -> PyResult<(core::Elastic, core::Elastic)> {
    domain::pair((body1.0, body2.0)).map_err(to_python)
}
