//! Errors of numbers, families and tables.

/// Every failure of a table of materials, for people: what is wrong, where, what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A number of a material is missing, unknown, out of its range, or without a source.
    #[error("material `{material}`.{key}: {why}")]
    Material {
        /// Name of the material.
        material: String,
        /// Name of the number.
        key: String,
        /// The wrong value, and allowed values.
        why: String,
    },
    /// There is no family of alloys of this name.
    #[error("family {name:?}: must be one of {allowed}")]
    Family {
        /// The name given.
        name: String,
        /// Existing names.
        allowed: String,
    },
    /// A table of materials does not have its form.
    #[error("{file}:{line}: {message}")]
    Table {
        /// Name of the file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// The wrong value, and allowed values.
        message: String,
    },
}
