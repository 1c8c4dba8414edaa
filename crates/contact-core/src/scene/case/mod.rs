//! The scene file: TOML, `schema = 1`, SI units.
//!
//! [`Scene::from_file`] reads it, [`Scene::to_toml`] writes it back with every number in SI. A
//! number in another measure is a table of one key, `thickness = { a_H = 1.0 }`, and one in another
//! unit a text, `thickness = "3 um"`. Every error names the key and its line, and an unknown key the
//! nearest valid one; of a file with several faults all are reported.

mod all_faults;
mod document;
mod fault;
mod friction;
mod measure;
mod path;
mod read;
#[cfg(test)]
mod refusal_tests;
mod section;
mod settings;
mod shape;
mod synonyms;
#[cfg(test)]
mod tests;
mod write;

use std::path::Path;

use toml::Table;

pub use fault::Fault;
pub use measure::{convert_to_si, quantity};
pub use section::Section;

use document::Document;

use super::Scene;
use super::files::{self, Files, Reach};
use super::number_files::decode_unicode;
use crate::error::Error;

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
        let (text, file) = read_text(path.as_ref())?;
        Self::from_toml_str_reaching(&text, &file, settings, reach)
    }

    /// Reads and checks a scene in the format of the scene file; `file` is its name in errors.
    pub fn from_toml_str(text: &str, file: &str, settings: &[String]) -> Result<Self, Error> {
        Self::from_toml_str_reaching(text, file, settings, Reach::Folder)
    }

    /// [`Self::from_toml_str`], with files of the given reach.
    pub fn from_toml_str_reaching(
        text: &str,
        file: &str,
        settings: &[String],
        reach: Reach,
    ) -> Result<Self, Error> {
        Ok(read_scene_and(text, file, settings, reach, |_, _| Ok(()))?.0)
    }
}

/// Reads a text file in UTF-8 or UTF-16; returns its text and its name in errors.
///
/// # Errors
///
/// The errors of [`read_file`](crate::scene::read_file), and [`Error::File`] where it is no text.
pub fn read_text(path: &Path) -> Result<(String, String), Error> {
    let file = path.display().to_string();
    match decode_unicode(files::read(path)?) {
        Ok(text) => Ok((text, file)),
        Err(message) => Err(Error::File {
            path: file,
            message,
        }),
    }
}

/// Reads and checks a scene and further sections of its file: `read_more` gets the root of the file
/// and the scene.
pub fn read_scene_and<T>(
    text: &str,
    file: &str,
    settings: &[String],
    reach: Reach,
    read_more: impl Fn(&Section<'_>, &Scene) -> Result<T, Fault>,
) -> Result<(Scene, T), Error> {
    let document = Document::parse(text, file, settings)?;
    let folder = Path::new(file).parent().unwrap_or_else(|| Path::new(""));
    let read_document = |root: &Table| -> Result<_, Fault> {
        let scene = read::scene(root, &Files { folder, reach })?;
        scene.check()?;
        let root = Section::root(root, &read::ROOT)?;
        let extra = read_more(&root, &scene)?;
        Ok((scene, extra))
    };
    read_document(document.root()).map_err(|first| {
        let read = |root: &Table| read_document(root).map(|(scene, _)| scene);
        let (faults, doubts) = all_faults::find_all_faults(document.root(), first, read);
        let mut errors: Vec<_> = faults.iter().map(|fault| document.error(fault)).collect();
        if errors.len() == 1 && doubts.is_empty() {
            return errors.remove(0);
        }
        errors.sort_by_key(Error::line);
        Error::SceneFaults { errors, doubts }
    })
}
