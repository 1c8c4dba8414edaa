//! Coatings graded in depth.

use contact_core::kernels as core;

use crate::error::Answer;
use crate::material::Coating;
use crate::parts::{Remade, remade_by_method};
use crate::prelude::*;

/// How a property changes from the surface of a graded coating to its bottom, s = z/h.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Profile(core::Profile);

#[pymethods]
impl Profile {
    /// Return the same value everywhere.
    #[staticmethod]
    #[pyo3(signature = (value: "float"))]
    fn constant(#[pyo3(from_py_with = number)] value: f64) -> Self {
        Self(core::Profile::Constant(value))
    }

    /// Return top + (bottom - top) s.
    #[staticmethod]
    #[pyo3(signature = (*, top: "float", bottom: "float"))]
    fn linear(
        #[pyo3(from_py_with = number)] top: f64,
        #[pyo3(from_py_with = number)] bottom: f64,
    ) -> Self {
        Self(core::Profile::Linear { top, bottom })
    }

    /// Return top + (bottom - top) s^exponent, with a positive exponent.
    #[staticmethod]
    #[pyo3(signature = (*, top: "float", bottom: "float", exponent: "float"))]
    fn power(
        #[pyo3(from_py_with = number)] top: f64,
        #[pyo3(from_py_with = number)] bottom: f64,
        #[pyo3(from_py_with = number)] exponent: f64,
    ) -> Self {
        Self(core::Profile::Power {
            top,
            bottom,
            exponent,
        })
    }

    /// Return top (bottom/top)^s over the depth s from 0 to 1, both of one sign.
    #[staticmethod]
    #[pyo3(signature = (*, top: "float", bottom: "float"))]
    fn exponential(
        #[pyo3(from_py_with = number)] top: f64,
        #[pyo3(from_py_with = number)] bottom: f64,
    ) -> Self {
        Self(core::Profile::Exponential { top, bottom })
    }

    /// Interpolate linearly between the points (s, value), s rising from 0 to 1.
    #[staticmethod]
    #[pyo3(signature = (points: "Sequence[tuple[float, float]]"))]
    fn table(points: List<(f64, f64)>) -> Self {
        Self(core::Profile::Table(points.0))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Remade<'py>> {
        let py = slf.py();
        let (method, given) = slf.get().made_by(py)?;
        remade_by_method(slf.get_type().into_any(), method, given)
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        Self::__repr__(slf)?.into_pyobject(slf.py())?.hash()
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let (method, given) = slf.get().made_by(slf.py())?;
        let texts = given
            .iter()
            .map(|(name, of)| Ok(format!("{name}={}", of.repr()?)));
        let texts: Vec<_> = texts.collect::<PyResult<_>>()?;
        Ok(format!("Profile.{method}({})", texts.join(", ")))
    }
}

impl Profile {
    /// The method that makes it, and what that is given.
    fn made_by<'py>(&self, py: Python<'py>) -> PyResult<(&'static str, Bound<'py, PyDict>)> {
        let arguments = PyDict::new(py);
        let ends = |top: f64, bottom: f64| {
            arguments.set_item("top", top)?;
            arguments.set_item("bottom", bottom)
        };
        let method = match &self.0 {
            core::Profile::Constant(value) => {
                arguments.set_item("value", value)?;
                "constant"
            }
            core::Profile::Linear { top, bottom } => {
                ends(*top, *bottom)?;
                "linear"
            }
            core::Profile::Power {
                top,
                bottom,
                exponent,
            } => {
                ends(*top, *bottom)?;
                arguments.set_item("exponent", exponent)?;
                "power"
            }
            core::Profile::Exponential { top, bottom } => {
                ends(*top, *bottom)?;
                "exponential"
            }
            core::Profile::Table(points) => {
                arguments.set_item("points", points.clone())?;
                "table"
            }
        };
        Ok((method, arguments))
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
#[pyo3(signature = (*, E, nu, thickness: "Thickness", layers: "int"))]
pub(crate) fn graded(
    E: Profile,
    nu: Profile,
    #[pyo3(from_py_with = Given::thickness)] thickness: f64,
    #[pyo3(from_py_with = number)] layers: usize,
) -> Answer<Vec<Coating>> {
    let coating = core::Graded {
        E: E.0,
        nu: nu.0,
        thickness,
        layers,
    };
    let coatings = coating.coatings()?;
    Ok(coatings.into_iter().map(Coating::perfect).collect())
}
