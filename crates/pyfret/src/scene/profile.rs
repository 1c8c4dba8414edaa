//! Coatings graded in depth.

use contact_core::kernels as core;
use pyo3::prelude::*;

use super::body::Coating;
use crate::error::to_python;

/// How a property changes from the surface of a graded coating to its bottom.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Profile(core::Profile);

#[pymethods]
impl Profile {
    #[staticmethod]
    fn constant(value: f64) -> Self {
        Self(core::Profile::Constant(value))
    }

    #[staticmethod]
    #[pyo3(signature = (*, top, bottom))]
    fn linear(top: f64, bottom: f64) -> Self {
        Self(core::Profile::Linear { top, bottom })
    }

    #[staticmethod]
    #[pyo3(signature = (*, top, bottom, exponent))]
    fn power(top: f64, bottom: f64, exponent: f64) -> Self {
        Self(core::Profile::Power {
            top,
            bottom,
            exponent,
        })
    }

    #[staticmethod]
    #[pyo3(signature = (*, top, bottom))]
    fn exponential(top: f64, bottom: f64) -> Self {
        Self(core::Profile::Exponential { top, bottom })
    }

    #[staticmethod]
    fn table(points: Vec<(f64, f64)>) -> Self {
        Self(core::Profile::Table(points))
    }
}

/// The layers that stand for a graded coating, outermost first.
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
    Ok(coatings.into_iter().map(Coating).collect())
}
