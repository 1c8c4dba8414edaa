//! Closed forms of `contact_core::reference`.

mod cattaneo_mindlin;
mod hertz_contact;
mod hertz_stress;
mod indentation;
mod lubkin;
mod plane_strain;
mod springs;

use numpy::{AllowTypeChange, PyArrayDyn, PyArrayLikeDyn, ToPyArray};
use pyo3::prelude::*;

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
type Numbers<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// `f` of every number, in the shape that they came in.
fn map<'py>(
    py: Python<'py>,
    x: &Numbers<'py>,
    f: impl Fn(f64) -> f64,
) -> Bound<'py, PyArrayDyn<f64>> {
    x.as_array().mapv(f).to_pyarray(py)
}
