//! Coatings graded in depth.

use contact_core::kernels as core;
use pyo3::prelude::*;

use crate::error::to_python;
use crate::material::Coating;

/// How a property changes from the surface of a graded coating to its bottom, s = z/h.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Profile(core::Profile);

#[pymethods]
impl Profile {
    /// Return the same value everywhere.
    #[staticmethod]
    fn constant(value: f64) -> Self {
        Self(core::Profile::Constant(value))
    }

    /// Return top + (bottom - top) s.
    #[staticmethod]
    #[pyo3(signature = (*, top, bottom))]
    fn linear(top: f64, bottom: f64) -> Self {
        Self(core::Profile::Linear { top, bottom })
    }

    /// Return top + (bottom - top) s^exponent, with a positive exponent.
    #[staticmethod]
    #[pyo3(signature = (*, top, bottom, exponent))]
    fn power(top: f64, bottom: f64, exponent: f64) -> Self {
        Self(core::Profile::Power {
            top,
            bottom,
            exponent,
        })
    }

    /// Return top (bottom/top)^s, both of one sign.
    #[staticmethod]
    #[pyo3(signature = (*, top, bottom))]
    fn exponential(top: f64, bottom: f64) -> Self {
        Self(core::Profile::Exponential { top, bottom })
    }

    /// Interpolate linearly between the points (s, value), s rising from 0 to 1.
    #[staticmethod]
    fn table(points: Vec<(f64, f64)>) -> Self {
        Self(core::Profile::Table(points))
    }
}

/// Stack of equally thick layers that stands for a graded coating, outermost first.
///
/// Each layer has the properties of its middle; the error falls with the square of their number.
///
/// Parameters
/// ----------
/// E, nu : Profile
///     Young's modulus [Pa] and Poisson's ratio over the depth.
/// thickness : float
///     Thickness of the whole coating [m], positive.
/// layers : int
///     Number of layers, at least 1.
///
/// Raises
/// ------
/// InvalidSceneError
///     If a profile, the thickness or the number of layers is out of its range.
#[pyfunction]
#[pyo3(signature = (*, E, nu, thickness, layers))]
pub(crate) fn graded(
    E: Profile,
    nu: Profile,
    thickness: f64,
    layers: usize,
) -> PyResult<Vec<Coating>> {
    let coating = core::Graded {
        E: E.0,
        nu: nu.0,
        thickness,
        layers,
    };
    let coatings = coating.coatings().map_err(to_python)?;
    Ok(coatings.into_iter().map(Coating::perfect).collect())
}
