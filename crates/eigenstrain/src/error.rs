//! Refusals of arguments.

/// A value that is not allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key} = {value}: allowed is {allowed}")]
pub struct Error {
    /// The wrong value.
    pub key: String,
    /// Its value.
    pub value: String,
    /// Allowed values.
    pub allowed: String,
}

impl Error {
    /// A value out of its range.
    pub fn new(
        key: impl Into<String>,
        value: impl std::fmt::Display,
        allowed: impl Into<String>,
    ) -> Self {
        Self {
            key: key.into(),
            value: value.to_string(),
            allowed: allowed.into(),
        }
    }
}
