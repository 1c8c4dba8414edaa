//! Faults of a scene file.

use toml::Value;

use crate::error::Error;

/// What is wrong, and at which key.
#[derive(Debug)]
pub struct Fault {
    /// The key, `body2.coatings[0].E`; it may be missing from the file.
    pub(super) key: String,
    /// One sentence.
    pub(super) message: String,
}

impl Fault {
    /// A fault of the value at a key.
    pub fn new(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            message: message.into(),
        }
    }

    /// A value that is not what it must be.
    pub(crate) fn value(key: &str, value: &Value, allowed: &str) -> Self {
        let shown = match value {
            Value::Table(table) => {
                let keys: Vec<_> = table.iter().map(|(k, v)| format!("{k} = {v}")).collect();
                format!("{{ {} }}", keys.join(", "))
            }
            value => value.to_string(),
        };
        Self::new(key, format!("{key} = {shown}: must be {allowed}"))
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        let message = error.to_string();
        match error {
            Error::InvalidScene { key, .. } => Self { key, message },
            _ => Self {
                key: String::new(),
                message,
            },
        }
    }
}
