//! Units, and doubts of numbers that are allowed and hardly meant.

use plausible::{QUANTITIES, Quantity, unit};
use pyo3::exceptions::PyKeyError;

use crate::prelude::*;
use crate::quantity::si;

/// The doubt of a number, if it is hardly meant, by its key and the name that it is shown by.
#[pyfunction]
#[pyo3(signature = (key, shown, value: "float"))]
pub(crate) fn doubt(
    key: &str,
    shown: &str,
    #[pyo3(from_py_with = number)] value: f64,
) -> Option<String> {
    plausible::doubt_of(key, shown, value)
}

/// Kind of the number of a key, and its unit in SI; none of a key that is unknown.
#[pyfunction]
pub(crate) fn measured_by(key: &str) -> Option<(&'static str, &'static str)> {
    let kind = plausible::of_key(key)?.kind;
    Some((kind.name(), kind.unit()))
}

/// The number in SI of a text with a unit, or of a quantity of pint, by the key of the quantity.
///
/// A key that is unknown is refused with the number to write.
#[pyfunction]
#[pyo3(signature = (key, value: "Any") -> "float")]
pub(crate) fn si_of(key: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    if plausible::of_key(key).is_none() {
        return number(value);
    }
    si(key, value)
}

/// The names of the units that measure one of some kinds, such as ``"length, force"``.
#[pyfunction]
pub(crate) fn units(kinds: &str) -> String {
    unit::names_of(&kinds.split(", ").collect::<Vec<_>>())
}

/// Whether a unit measures a kind; a force per length is a force and a stiffness, too.
#[pyfunction]
pub(crate) fn measures(unit: &str, kind: &str) -> bool {
    unit::measures(unit, kind)
}

/// Kind of a unit, and its size in SI; none of a name that is no unit.
#[pyfunction]
pub(crate) fn unit_of(name: &str) -> Option<(&'static str, f64)> {
    unit::named(name).map(|(kind, size)| (kind.name(), size))
}

/// Rows of the table of quantities: name, SI unit, and whether there is a plausible range.
#[pyfunction]
pub(crate) fn quantities() -> Vec<(&'static str, &'static str, bool)> {
    let rows = QUANTITIES.iter();
    rows.map(|q| (q.name, q.kind.unit(), q.least > 0.0 || q.most.is_finite()))
        .collect()
}

/// Number in SI of a text with a unit, or of a quantity of pint, by the row of the table.
#[pyfunction]
#[pyo3(signature = (quantity, value: "Any") -> "float")]
pub(crate) fn quantity_in_si(quantity: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    si(row(quantity)?.keys[0], value)
}

/// Doubt of a number that lies outside the range of its row.
#[pyfunction]
#[pyo3(signature = (quantity, shown, value: "float"))]
pub(crate) fn doubt_quantity(
    quantity: &str,
    shown: &str,
    #[pyo3(from_py_with = number)] value: f64,
) -> PyResult<Option<String>> {
    Ok(row(quantity)?.doubt(shown, value))
}

/// The row of the table of quantities with this name.
fn row(name: &str) -> PyResult<&'static Quantity> {
    let row = QUANTITIES.iter().find(|q| q.name == name);
    row.ok_or_else(|| PyKeyError::new_err(format!("no quantity {name:?}")))
}
