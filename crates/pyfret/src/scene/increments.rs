//! Numbers of increments, and values to visit.

use contact_core::scene as core;
use pyo3::{PyTypeInfo, type_hint_union};

use crate::document::has_unit;
use crate::prelude::*;
use crate::quantity::si;

/// One value or several to visit in turn.
pub(super) enum Values {
    One(f64),
    Several(Vec<f64>),
}

impl<'py> FromPyObject<'_, 'py> for Values {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::NUMBERS;

    /// Takes a number, or a list of numbers.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(one) = number(&value) {
            return Ok(Self::One(one));
        }
        let allowed = "a number, or several to visit in turn, such as [100.0, -100.0, 100.0]";
        let several = value.extract::<List<f64>>().ok().filter(|v| !v.is_empty());
        several
            .map(|values| Self::Several(values.0))
            .ok_or_else(|| must_be(&value, allowed))
    }
}

impl Values {
    /// The values as a slice.
    pub(super) fn slice(&self) -> &[f64] {
        match self {
            Self::One(value) => std::slice::from_ref(value),
            Self::Several(values) => values,
        }
    }
}

/// Takes values to visit by the name of the load or the shift: numbers, or texts with units.
pub(super) struct Visited;

macro_rules! visited {
    ($($name:ident)*; $($optional:ident)*) => {
        impl Visited {
            $(pub(super) fn $name(value: &Bound<'_, PyAny>) -> PyResult<Values> {
                visit(stringify!($name), value)
            })*
            $(pub(super) fn $optional(value: &Bound<'_, PyAny>) -> PyResult<Option<Values>> {
                if value.is_none() {
                    return Ok(None);
                }
                visit(stringify!($optional), value).map(Some)
            })*
        }
    };
}

visited!(M_z; delta_x delta_y delta_z phi_x phi_y phi_z);

/// Reads a value or a list of values of the quantity `name`, each with or without its unit.
pub(super) fn visit(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Values> {
    if has_unit(value)? {
        return si(name, value).map(Values::One);
    }
    if let Ok(several) = value.extract::<List<Bound<'_, PyAny>>>() {
        let units = several.iter().map(has_unit).collect::<PyResult<Vec<_>>>()?;
        if units.contains(&true) {
            let numbers = several.iter().map(|one| si(name, one));
            return numbers.collect::<PyResult<_>>().map(Values::Several);
        }
    }
    value.extract()
}

/// One name or several.
pub(super) struct Names(pub(super) Vec<String>);

impl<'py> FromPyObject<'_, 'py> for Names {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::NAMES;

    /// Takes a name, or a list of names.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(one) = value.extract::<String>() {
            return Ok(Self(vec![one]));
        }
        let allowed = "a name, or a list of names, such as \"delta_x\"";
        let names = value.extract::<List<String>>();
        names
            .map(|names| Self(names.0))
            .map_err(|_| must_be(&value, allowed))
    }
}

/// Increments in proportion to a change, where the whole range takes this many.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct PerRange(pub(super) usize);

parts!(PerRange: increments);

#[pymethods]
impl PerRange {
    #[new]
    #[pyo3(signature = (increments: "int"))]
    fn new(#[pyo3(from_py_with = number)] increments: usize) -> Self {
        Self(increments)
    }

    fn __repr__(&self) -> String {
        format!("PerRange({})", self.0)
    }
}

attributes!(PerRange, self:
    /// Increments over the whole range of the load or motion that needs most.
    increments: usize = self.0;
);

/// Increments of a branch: a number, or "auto" for as many as the path tolerance asks for.
pub(super) struct Count(pub(super) Option<usize>);

impl<'py> FromPyObject<'_, 'py> for Count {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::COUNT;

    /// Takes a whole number, or "auto".
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if value.extract::<&str>().is_ok_and(|word| word == "auto") {
            return Ok(Self(None));
        }
        let allowed = "a whole number of increments >= 1, or \"auto\"";
        let count = number(&value).ok().filter(|&n: &usize| n >= 1);
        count
            .map(|n| Self(Some(n)))
            .ok_or_else(|| must_be(&value, allowed))
    }
}

/// Increments between two waypoints.
pub(super) enum AnyIncrements {
    Each(usize),
    PerRange(PerRange),
    Chosen,
}

impl<'py> FromPyObject<'_, 'py> for AnyIncrements {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = type_hint_union!(PerRange::TYPE_HINT, crate::hints::COUNT);

    /// Takes a number per branch, PerRange, or "auto".
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(per_range) = value.extract::<PerRange>() {
            return Ok(Self::PerRange(per_range));
        }
        if value.extract::<&str>().is_ok_and(|word| word == "auto") {
            return Ok(Self::Chosen);
        }
        let allowed = "a whole number of increments per branch, PerRange(40) or \"auto\"";
        number(&value)
            .map(Self::Each)
            .map_err(|_| must_be(&value, allowed))
    }
}

impl From<AnyIncrements> for core::Increments {
    fn from(increments: AnyIncrements) -> Self {
        match increments {
            AnyIncrements::Each(n) => Self::Each(n),
            AnyIncrements::PerRange(PerRange(n)) => Self::PerRange(n),
            AnyIncrements::Chosen => Self::Chosen,
        }
    }
}
