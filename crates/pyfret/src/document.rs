//! Values of Python as values of a scene file.

use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyTypeError;
use pyo3::types::{PyBool, PyFloat, PyInt, PyString};
use toml::{Table, Value};

use crate::prelude::*;

/// A mapping of names to values, as a table of a scene file.
pub(crate) struct Document(pub(crate) Table);

impl<'py> FromPyObject<'_, 'py> for Document {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::NAMED;

    /// Reads a dict as a table of a scene file.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        table(&*value.cast::<PyDict>()?).map(Self)
    }
}

/// Converts a dict to a table; an error has the name of the entry.
fn table(dict: &Bound<'_, PyDict>) -> PyResult<Table> {
    let entries = dict.iter().map(|(name, value)| {
        let name: String = name.extract()?;
        let value = self::value(&value).map_err(|error| named(&name, error, dict.py()))?;
        Ok((name, value))
    });
    entries.collect()
}

/// Puts the name of an entry before the message of an error.
fn named(name: &str, error: PyErr, py: Python<'_>) -> PyErr {
    PyTypeError::new_err(format!("{name} = {}", error.value(py)))
}

/// Converts a value of Python to TOML. A quantity of pint becomes a text with its unit; None within a list is
/// an error.
fn value(of: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(flag) = of.cast::<PyBool>() {
        return Ok(Value::Boolean(flag.is_true()));
    }
    if of.is_instance_of::<PyString>() {
        return Ok(Value::String(of.extract()?));
    }
    if of.is_instance_of::<PyInt>() {
        return of.extract().map_or_else(
            |_| of.extract().map(Value::Float),
            |whole| Ok(Value::Integer(whole)),
        );
    }
    if of.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(of.extract()?));
    }
    if let Ok(dict) = of.cast::<PyDict>() {
        return table(dict).map(Value::Table);
    }
    if of.hasattr("magnitude")? && of.hasattr("units")? {
        return quantity(of).map(Value::String);
    }
    // Numbers of numpy, zero-dimensional arrays.
    if let Ok(whole) = of.call_method0("__index__") {
        return Ok(Value::Integer(whole.extract()?));
    }
    if let Ok(number) = of.call_method0("__float__") {
        return Ok(Value::Float(number.extract()?));
    }
    if let Ok(items) = of.try_iter() {
        return items
            .map(|item| value(&item?))
            .collect::<PyResult<_>>()
            .map(Value::Array);
    }
    let shown = of.repr()?;
    Err(PyTypeError::new_err(format!(
        "{shown}: must be a number, a text, or a list of them"
    )))
}

/// Converts a table of a scene file to a dict.
pub(crate) fn to_dict<'py>(table: &Table, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, value) in table {
        dict.set_item(name, to_python(value, py)?)?;
    }
    Ok(dict)
}

/// Converts a TOML value to Python.
fn to_python<'py>(value: &Value, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::Boolean(flag) => flag.into_bound_py_any(py),
        Value::Integer(whole) => whole.into_bound_py_any(py),
        Value::Float(number) => number.into_bound_py_any(py),
        Value::Table(table) => Ok(to_dict(table, py)?.into_any()),
        Value::Array(items) => {
            let items = items.iter().map(|item| to_python(item, py));
            items.collect::<PyResult<Vec<_>>>()?.into_bound_py_any(py)
        }
        Value::String(text) => text.into_bound_py_any(py),
        Value::Datetime(date) => date.to_string().into_bound_py_any(py),
    }
}

/// Converts a quantity of pint to a text with its unit, `380.0 GPa`.
fn quantity(of: &Bound<'_, PyAny>) -> PyResult<String> {
    let number: f64 = of.getattr("magnitude")?.extract()?;
    let unit = of.getattr("units")?.call_method1("__format__", ("~P",))?;
    Ok(format!("{number:?} {unit}"))
}

/// The text of a value that is a text, or a quantity of pint; none for other values.
pub(crate) fn text_of(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    if value.is_instance_of::<PyString>() {
        return value.extract().map(Some);
    }
    if value.is_exact_instance_of::<PyFloat>() || value.is_exact_instance_of::<PyInt>() {
        return Ok(None);
    }
    if value.hasattr("magnitude")? && value.hasattr("units")? {
        return quantity(value).map(Some);
    }
    Ok(None)
}

/// Whether a value is a number with its unit: a text that has one, or a quantity of pint.
pub(crate) fn has_unit(value: &Bound<'_, PyAny>) -> PyResult<bool> {
    let text = text_of(value)?;
    Ok(text.is_some_and(|text| text.contains(|c: char| c.is_ascii_digit())))
}
