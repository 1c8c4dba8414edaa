//! Errors, with the numbers that explain them.

use std::fmt::Display;

/// Every failure of the criteria, for people: what is wrong, where, what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An argument is out of its range.
    #[error("{key} = {value}: must be {allowed}")]
    Argument {
        /// Which argument.
        key: String,
        /// The value found.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// A number of a material is missing, unknown, out of its range, or without a source.
    #[error("material `{material}`.{key}: {why}")]
    Material {
        /// Name of the material.
        material: String,
        /// Name of the number.
        key: String,
        /// What is wrong and what is allowed.
        why: String,
    },
    /// There is no family of alloys of this name.
    #[error("family {name:?}: must be one of {allowed}")]
    Family {
        /// The name given.
        name: String,
        /// Those that there are.
        allowed: String,
    },
    /// A table of materials does not have its form.
    #[error("{file}:{line}: {message}")]
    Table {
        /// Name of the file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong and what is allowed.
        message: String,
    },
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
