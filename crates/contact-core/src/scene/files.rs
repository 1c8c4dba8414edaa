//! Files that a scene names.

use std::fs;
use std::path::{Component, Path, PathBuf};

use crate::error::Error;
use crate::memory::fits;

/// Memory that reading a text takes, over the length of the file: a number may be two bytes of
/// text, and a list that grows is copied.
const COPIES: f64 = 12.0;

/// Fails where there is no file, but a folder, a pipe or a device, and if what is made of the file
/// would not fit into memory.
pub(crate) fn check_file(path: &Path) -> Result<(), Error> {
    let failed = |message: String| Error::File {
        path: path.display().to_string(),
        message,
    };
    // A pipe would be waited for when it is opened, and a device has no end.
    let metadata = fs::metadata(path).map_err(|e| failed(e.to_string()))?;
    if !metadata.is_file() {
        return Err(failed("is not a file".into()));
    }
    fits("the numbers of a file", COPIES * metadata.len() as f64)
}

/// The content of a file that somebody names, whatever it is read for: checked first.
///
/// # Errors
///
/// [`Error::File`] where there is no file, but a folder, a pipe or a device, or where it cannot be
/// read; [`Error::TooLarge`] where what is made of it would not fit into memory.
pub fn read(path: &Path) -> Result<Vec<u8>, Error> {
    check_file(path)?;
    fs::read(path).map_err(|e| Error::File {
        path: path.display().to_string(),
        message: e.to_string(),
    })
}

/// Folders in which the files of a scene may lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reach {
    /// The folder of the scene file and those below it (default). A scene from somebody else
    /// reads only files that came with it.
    #[default]
    Folder,
    /// Anywhere.
    Anywhere,
}

/// The files that a scene may read.
#[derive(Clone, Copy)]
pub(in crate::scene) struct Files<'a> {
    /// The folder of the scene file; relative names start there.
    pub(in crate::scene) folder: &'a Path,
    pub(in crate::scene) reach: Reach,
}

impl Files<'_> {
    /// Returns the path of the file `name`; the error describes what is wrong with the name.
    pub(in crate::scene) fn find(&self, name: &str) -> Result<PathBuf, String> {
        let path = self.folder.join(name);
        if self.reach == Reach::Anywhere {
            return Ok(path);
        }
        let outside = || {
            format!(
                "\"{name}\" lies outside the folder of the scene: put it there, or allow it \
                 (--allow-outside, allow_outside=True)"
            )
        };
        let stays_inside = |c: Component<'_>| matches!(c, Component::Normal(_) | Component::CurDir);
        if !Path::new(name).components().all(stays_inside) {
            return Err(outside());
        }
        // Links lead out too.
        let canonical = |path: &Path| {
            path.canonicalize()
                .map_err(|e| format!("{}: {e}", path.display()))
        };
        let current = Path::new(".");
        let folder = if self.folder.as_os_str().is_empty() {
            current
        } else {
            self.folder
        };
        let (folder, path) = (canonical(folder)?, canonical(&path)?);
        if path.starts_with(folder) {
            Ok(path)
        } else {
            Err(outside())
        }
    }
}
