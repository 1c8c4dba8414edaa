//! Faults of a scene file.

use toml::Value;

use crate::error::Error;
use crate::shown::abridge;

/// A message about the value at a key.
#[derive(Debug)]
pub struct Fault {
    /// The key, `body2.coatings[0].E`; it may be missing from the file.
    pub(super) key: String,
    /// One sentence.
    pub(super) message: String,
    /// Whether the key is unknown.
    pub(super) is_unknown: bool,
    /// The nearest valid name of an unknown key in its table.
    pub(super) nearest: Option<String>,
    /// Whether the value can be read, but is out of range or contradicts other values.
    pub(super) is_of_meaning: bool,
}

impl Fault {
    /// A fault of the value at `key`, with a message for the user.
    pub fn new(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            message: message.into(),
            is_unknown: false,
            nearest: None,
            is_of_meaning: false,
        }
    }

    /// The error of values that come from no file.
    pub fn into_error(self) -> Error {
        Error::Values {
            message: self.message,
        }
    }

    /// The fault of a value of the wrong kind or range: the message has the value and what is `allowed`.
    pub(crate) fn value(key: &str, value: &Value, allowed: &str) -> Self {
        let shown = match value {
            Value::Table(table) => {
                let keys: Vec<_> = table.iter().map(|(k, v)| format!("{k} = {v}")).collect();
                format!("{{ {} }}", keys.join(", "))
            }
            value => value.to_string(),
        };
        let (named, value) = (abridge(key), abridge(&shown));
        Self::new(key, format!("{named} = {value}: must be {allowed}"))
    }
}

impl From<Error> for Fault {
    /// The fault of the key that an error of a scene is about.
    fn from(error: Error) -> Self {
        let message = error.to_string();
        let key = match error {
            Error::InvalidScene { key, .. } => key,
            _ => String::new(),
        };
        Self {
            is_of_meaning: true,
            ..Self::new(key, message)
        }
    }
}
