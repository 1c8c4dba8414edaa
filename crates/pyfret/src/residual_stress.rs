//! Residual stress as Python gives it: a stress, or a table over depth.

use contact_core::scene::{Body, Profile as Core, ResidualStress};
use pyo3::types::PyString;

use crate::error::{Answer, to_python};
use crate::hints::ARRAY_LIKE;
use crate::prelude::*;
use crate::quantity::si;

/// Residual stress of one layer: a number, or rows of depth and stress.
#[derive(Clone, Default)]
pub(crate) struct Profile(pub(crate) Core);

/// Residual stress of every layer, where it is given.
pub(crate) type Profiles = Option<List<Profile>>;

/// The residual stress of a body: the `given` one of each layer, or its own.
pub(crate) fn of_body(body: &Body, given: Profiles) -> Answer<ResidualStress> {
    let layers = given.unwrap_or_default().into_iter().map(|layer| layer.0);
    Ok(ResidualStress::from_profiles(
        body,
        &layers.collect::<Vec<_>>(),
    )?)
}

impl<'py> FromPyObject<'_, 'py> for Profile {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = ARRAY_LIKE;

    /// Takes a uniform stress, or rows of depth and stress.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let has = |name: &str| value.hasattr(name).unwrap_or(false);
        let is_table =
            !value.is_instance_of::<PyString>() && !has("magnitude") && value.len().is_ok();
        if !is_table {
            return si("residual", &value).map(|stress| Self(Core::uniform(stress)));
        }
        // Tables of pandas hold their rows elsewhere.
        let rows = if has("iterrows") {
            value.call_method0("to_numpy")?
        } else {
            value.to_owned()
        };
        let row = |row: PyResult<Bound<'py, PyAny>>| -> PyResult<[f64; 3]> {
            let row: Vec<Bound<'py, PyAny>> = row?.try_iter()?.collect::<PyResult<_>>()?;
            let stress = |n: usize| si("residual", &row[n]);
            match row.len() {
                2 => {
                    let s = stress(1)?;
                    Ok([si("depth", &row[0])?, s, s])
                }
                3 => Ok([si("depth", &row[0])?, stress(1)?, stress(2)?]),
                _ => Err(wrong()),
            }
        };
        let rows = rows.try_iter()?.map(|one| {
            row(one).map_err(|error| {
                // A row that is none: a number, for one.
                if error.is_instance_of::<PyValueError>(value.py()) {
                    error
                } else {
                    wrong()
                }
            })
        });
        let rows: Vec<_> = rows.collect::<PyResult<_>>()?;
        if rows.is_empty() {
            return Err(wrong());
        }
        let profile = Core { rows };
        profile.check("residual").map_err(to_python)?;
        Ok(Self(profile))
    }
}

/// The error of any other value.
fn wrong() -> PyErr {
    PyValueError::new_err(
        "residual: must be a stress in Pa, or a table of depth and stress, [[depth, s], ..] or \
         [[depth, s_xx, s_yy], ..], such as [[0, -500e6], [1e-4, 0]]",
    )
}

/// Residual stress as a user writes it: a number, or rows.
#[derive(IntoPyObject)]
pub(crate) enum Shown {
    Uniform(f64),
    Rows(Vec<Vec<f64>>),
}

/// Residual stress in the form that a user gives: one number if uniform and equal along x and y, else rows
/// (depth, s_xx, s_yy). None if there is no stress.
pub(crate) fn shown(of: &Core) -> Option<Shown> {
    match of.rows.as_slice() {
        [] => None,
        [[_, xx, yy]] if xx == yy => Some(Shown::Uniform(*xx)),
        rows => Some(Shown::Rows(rows.iter().map(|row| row.to_vec()).collect())),
    }
}

/// The text of an expression that makes it again.
pub(crate) fn text(of: &Core) -> String {
    match of.rows.as_slice() {
        [[_, xx, yy]] if xx == yy => format!("{xx:?}"),
        rows => format!("{rows:?}"),
    }
}
