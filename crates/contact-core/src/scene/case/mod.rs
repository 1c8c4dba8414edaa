//! The scene file: TOML, `schema = 1`, SI units.
//!
//! [`Scene::from_file`] reads it, [`Scene::to_toml`] writes it back with every number in SI. A
//! number in another measure is a table of one key, `thickness = { a_H = 1.0 }`. Every error
//! names the key and its line, and an unknown key the nearest valid one.

mod document;
pub(in crate::scene) mod files;
mod friction;
mod measure;
mod path;
mod read;
mod section;
mod settings;
mod shape;
#[cfg(test)]
mod tests;
mod wear;
mod write;

use std::path::Path;

pub use files::Reach;

use document::Document;
use files::Files;
use section::Fault;

use super::Scene;
use crate::error::Error;

/// The version of the scene file that is read and written.
const SCHEMA: i64 = 1;

impl Scene {
    /// Reads and checks a scene file. Each of `settings` is a `key=value` that replaces a value of
    /// the file before it is read, such as `friction.mu=0.5` or
    /// `body2.coatings.0.E.E_substrate=4`. The files that it names must lie in its folder.
    pub fn from_file(path: impl AsRef<Path>, settings: &[String]) -> Result<Self, Error> {
        Self::from_file_reaching(path, settings, Reach::Folder)
    }

    /// [`Self::from_file`], with files of the given reach.
    pub fn from_file_reaching(
        path: impl AsRef<Path>,
        settings: &[String],
        reach: Reach,
    ) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = String::from_utf8(files::read(path)?).map_err(|e| Error::File {
            path: path.display().to_string(),
            message: format!("is not UTF-8 text: {e}"),
        })?;
        Self::read(&text, &path.display().to_string(), settings, reach)
    }

    /// Reads and checks a scene in the format of the scene file; `file` is its name in errors.
    pub fn from_toml_str(text: &str, file: &str, settings: &[String]) -> Result<Self, Error> {
        Self::read(text, file, settings, Reach::Folder)
    }

    /// [`Self::from_toml_str`], with files of the given reach.
    pub fn from_toml_str_reaching(
        text: &str,
        file: &str,
        settings: &[String],
        reach: Reach,
    ) -> Result<Self, Error> {
        Self::read(text, file, settings, reach)
    }

    fn read(text: &str, file: &str, settings: &[String], reach: Reach) -> Result<Self, Error> {
        let document = Document::parse(text, file, settings)?;
        let folder = Path::new(file).parent().unwrap_or_else(|| Path::new(""));
        let files = Files { folder, reach };
        read::scene(document.root(), &files)
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
