//! Types of arguments and answers, as Python's type checkers read them.
//!
//! The stub of the module is made of these, of the types that PyO3 knows, and of the annotations
//! in the signatures of functions.

use std::convert::Infallible;

use numpy::PyArray;
use pyo3::{type_hint_identifier, type_hint_subscript, type_hint_union};

use crate::prelude::*;

/// Values that numpy makes an array of.
pub(crate) const ARRAY_LIKE: PyStaticExpr = type_hint_identifier!("numpy.typing", "ArrayLike");
/// An array of numbers.
const ARRAY: PyStaticExpr = type_hint_subscript!(
    type_hint_identifier!("numpy.typing", "NDArray"),
    type_hint_identifier!("numpy", "float64")
);
/// An array of yes and no.
pub(crate) const MASK: PyStaticExpr = type_hint_subscript!(
    type_hint_identifier!("numpy.typing", "NDArray"),
    type_hint_identifier!("numpy", "bool_")
);
/// Any value.
pub(crate) const ANY: PyStaticExpr = type_hint_identifier!("typing", "Any");
/// A name, or a word of those that are allowed.
pub(crate) const TEXT: PyStaticExpr = type_hint_identifier!("builtins", "str");
/// Yes or no.
pub(crate) const BOOL: PyStaticExpr = type_hint_identifier!("builtins", "bool");
/// A number.
pub(crate) const FLOAT: PyStaticExpr = type_hint_identifier!("builtins", "float");
/// A whole number.
pub(crate) const INT: PyStaticExpr = type_hint_identifier!("builtins", "int");
const SEQUENCE: PyStaticExpr = type_hint_identifier!("collections.abc", "Sequence");
const TUPLE: PyStaticExpr = type_hint_identifier!("builtins", "tuple");
/// One of the words that are allowed.
macro_rules! word {
    ($text:literal) => {
        pyo3::type_hint_subscript!(
            pyo3::type_hint_identifier!("typing", "Literal"),
            pyo3::inspect::PyStaticExpr::Constant {
                value: pyo3::inspect::PyStaticConstant::Str($text)
            }
        )
    };
}
pub(crate) use word;

/// Names with their values.
pub(crate) const NAMED: PyStaticExpr =
    type_hint_subscript!(type_hint_identifier!("builtins", "dict"), TEXT, ANY);
/// A whole number, or the word "auto".
pub(crate) const COUNT: PyStaticExpr = type_hint_union!(INT, word!("auto"));
/// A number, or what has one with its unit.
const QUANTITY: PyStaticExpr = type_hint_identifier!("pyfret.quantities", "Quantity");
/// One of these, or several.
pub(crate) const NUMBERS: PyStaticExpr = type_hint_identifier!("pyfret.quantities", "Quantities");
/// A name, or several.
pub(crate) const NAMES: PyStaticExpr = type_hint_union!(TEXT, type_hint_subscript!(SEQUENCE, TEXT));
/// A length, or one along x and one along y.
pub(crate) const PITCH: PyStaticExpr =
    type_hint_union!(QUANTITY, type_hint_subscript!(TUPLE, QUANTITY, QUANTITY));
/// A number of cells, or one along x and one along y.
pub(crate) const CELLS: PyStaticExpr = type_hint_union!(INT, type_hint_subscript!(TUPLE, INT, INT));
/// How a scene is solved.
pub(crate) const SETTINGS: PyStaticExpr = type_hint_identifier!("pyfret.settings", "Settings");

/// The type of values one after another.
macro_rules! sequence_of {
    ($of:expr) => {
        pyo3::type_hint_subscript!(
            pyo3::type_hint_identifier!("collections.abc", "Sequence"),
            $of
        )
    };
}
pub(crate) use sequence_of;

/// An array of numbers that is the value of an attribute.
pub(crate) struct Numbers<'py>(Bound<'py, PyAny>);

impl<'py, D> From<Bound<'py, PyArray<f64, D>>> for Numbers<'py> {
    fn from(array: Bound<'py, PyArray<f64, D>>) -> Self {
        Self(array.into_any())
    }
}

impl<'py> IntoPyObject<'py> for Numbers<'py> {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = Infallible;

    const OUTPUT_TYPE: PyStaticExpr = ARRAY;

    fn into_pyobject(self, _: Python<'py>) -> Result<Self::Output, Infallible> {
        Ok(self.0)
    }
}
