//! The scene file: TOML, `schema = 1`, SI units.
//!
//! [`Scene::from_file`] reads it, [`Scene::to_toml`] writes it back with every number in SI. A
//! number in another measure is a table of one key, `thickness = { a_H = 1.0 }`. Every error
//! names the key and its line, and an unknown key the nearest valid one.

mod document;
mod measure;
mod read;
mod section;
mod shape;
#[cfg(test)]
mod tests;
mod write;

use std::path::Path;

use document::Document;
use section::Fault;

use super::Scene;
use crate::error::Error;

/// The version of the scene file that is read and written.
const SCHEMA: i64 = 1;

impl Scene {
    /// Reads and checks a scene file. Each of `settings` is a `key=value` that replaces a value of
    /// the file before it is read, such as `friction.mu=0.5` or
    /// `body2.coatings.0.E.E_substrate=4`.
    pub fn from_file(path: impl AsRef<Path>, settings: &[String]) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = std::fs::read_to_string(path).map_err(|e| Error::File {
            path: path.display().to_string(),
            message: e.to_string(),
        })?;
        Self::from_toml_str(&text, &path.display().to_string(), settings)
    }

    /// Reads and checks a scene in the format of the scene file; `file` is its name in errors.
    pub fn from_toml_str(text: &str, file: &str, settings: &[String]) -> Result<Self, Error> {
        let document = Document::parse(text, file, settings)?;
        let folder = Path::new(file).parent().unwrap_or_else(|| Path::new(""));
        read::scene(document.root(), folder)
            .and_then(|scene| {
                scene.check()?;
                Ok(scene)
            })
            .map_err(|fault| document.error(&fault))
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
