//! Errors, with the numbers that explain them.

use std::fmt::Display;

/// Every failure of the criteria, for people: what is wrong, where, what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An argument is out of its range.
    #[error("{key} = {value}: must be {allowed}")]
    Argument {
        /// Name of the argument.
        key: String,
        /// The value found.
        value: String,
        /// Allowed values.
        allowed: String,
    },
    /// A material, a family or a table of materials is at fault.
    #[error(transparent)]
    Material(#[from] material_table::Error),
    /// The caller raised its flag.
    #[error("stopped")]
    Stopped,
}

impl Error {
    /// An argument out of its range.
    pub(crate) fn argument(
        key: impl Into<String>,
        value: impl Display,
        allowed: impl Into<String>,
    ) -> Self {
        Self::Argument {
            key: key.into(),
            value: value.to_string(),
            allowed: allowed.into(),
        }
    }
}
