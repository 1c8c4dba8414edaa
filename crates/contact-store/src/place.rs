//! A store is laid out beside its place and put there at once.
//!
//! ```text
//! .NAME.unfinished   what will be at NAME
//! .NAME.replaced     what was at NAME
//! ```
//!
//! With a store to be replaced the steps are: NAME becomes `.NAME.replaced`, `.NAME.unfinished`
//! becomes NAME, `.NAME.replaced` goes. Whenever the process dies, NAME is nothing, the old store
//! or the new one; between the first two steps, where it is nothing, whoever writes there next or
//! resumes puts the old store back ([`restore_moved_store`]). What else is left goes when the same place is
//! written again.

use std::ffi::OsStr;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use contact_core::Error;
use contact_subsurface::Probe;

use super::catalogue::{FIELDS, HALF_WIDTH, SCALARS};
use super::checkpoint::{self, Checkpoints};
use super::folder::{Folder, hidden_sibling};
use super::reader::Store;
use super::{wear_catalogue, wear_checkpoint};

const METADATA: [&str; 3] = [".zgroup", ".zattrs", ".zmetadata"];
const ARRAY: [&str; 2] = [".zarray", ".zattrs"];
/// Coordinates of the stores of a run and of the stress below it.
const COORDINATES: [&str; 6] = ["x", "y", "saved_increment", "saved_t", "z", "layer"];

/// A folder that is written beside its place; it is removed unless it is moved there.
#[derive(Debug)]
pub(super) struct PendingFolder {
    folder: Arc<Folder>,
    place: PathBuf,
    /// The folder, locked: a place has one writer.
    _lock: File,
    in_place: bool,
}

impl PendingFolder {
    /// Creates and locks the empty folder beside its place. Remains of a killed process are removed. A store
    /// that was to be replaced is kept, if its successor never came.
    pub(super) fn begin(place: &Path) -> Result<Self, Error> {
        let folder = Folder::with_final_place(place, hidden_sibling(place, "unfinished"));
        if place.file_name().is_none() {
            return Err(folder.error(&"is no name for a store"));
        }
        clear(&folder, folder.root())?;
        let replaced = hidden_sibling(place, "replaced");
        if place.exists() || !is_store(&replaced) {
            clear(&folder, &replaced)?;
        }
        let begin = || {
            fs::create_dir_all(folder.root())?;
            File::open(folder.root())
        };
        let lock = begin().map_err(|e| folder.error(&e))?;
        lock_folder(&lock, &folder)?;
        Ok(Self {
            folder,
            place: place.to_owned(),
            _lock: lock,
            in_place: false,
        })
    }

    /// Folder for the time of writing; errors name the place.
    pub(super) fn folder(&self) -> &Arc<Folder> {
        &self.folder
    }

    /// Moves the folder to its place. There must be nothing at that place or, if `replace`, a store that no
    /// process writes.
    pub(super) fn finish(mut self, replace: bool) -> Result<Arc<Folder>, Error> {
        let failed = |e: io::Error| {
            self.folder
                .error(&format!("cannot be put in its place: {e}"))
        };
        let (place, replaced) = (
            Folder::new(&self.place),
            hidden_sibling(&self.place, "replaced"),
        );
        let old = replace && self.place.exists();
        if old {
            check_only_store(&self.place)?;
            if Checkpoints::in_use(&place) {
                return Err(place.error(&"is being written by another process"));
            }
            fs::rename(&self.place, &replaced).map_err(failed)?;
        } else if self.place.exists() {
            return Err(place.error(&"exists by now: choose another path"));
        }
        if let Err(e) = fs::rename(self.folder.root(), &self.place) {
            if old {
                // If that fails too, the next run does it.
                let _ = fs::rename(&replaced, &self.place);
            }
            return Err(failed(e));
        }
        self.in_place = true;
        if old {
            // The new store is in its place: remains that cannot be removed are no failure.
            let _ = remove(&replaced);
        }
        Ok(place)
    }
}

impl Drop for PendingFolder {
    /// Removes the folder if it was never finished.
    fn drop(&mut self) {
        if !self.in_place {
            // Nothing can be done if it stays.
            let _ = fs::remove_dir_all(self.folder.root());
        }
    }
}

/// Follows links to the place that a path leads to. So the pending folder is on the same file
/// system, and a link stays a link.
pub(super) fn resolve_place(path: &Path) -> Result<PathBuf, Error> {
    // A slash at the end has no meaning.
    let path: PathBuf = path.components().collect();
    let is_link = fs::symlink_metadata(&path).is_ok_and(|about| about.is_symlink());
    if !is_link {
        return Ok(path);
    }
    path.canonicalize().map_err(|e| {
        let folder = Folder::new(&path);
        folder.error(&format!("is a link that leads nowhere: {e}"))
    })
}

/// Fails if a store contains anything that is no part of a store.
pub(super) fn check_only_store(store: &Path) -> Result<(), Error> {
    let folder = Folder::new(store);
    let foreign_entry = find_foreign(store, is_store_entry).map_err(|e| folder.error(&e))?;
    let Some(name) = foreign_entry else {
        return Ok(());
    };
    let name = name.display();
    let message = format!("{name} in it is no part of a store: move it elsewhere before");
    Err(folder.error(&message))
}

/// The first entry in a folder, or in a folder in it, whose name does not belong in a store; none if all
/// belong.
fn find_foreign(path: &Path, belongs: impl Fn(&OsStr) -> bool) -> io::Result<Option<PathBuf>> {
    for entry in fs::read_dir(path)? {
        let entry = entry?;
        let name = entry.file_name();
        if !belongs(&name) {
            return Ok(Some(name.into()));
        }
        if entry.file_type()?.is_dir() {
            let inner = find_foreign(&entry.path(), is_array_entry)?;
            if let Some(inner) = inner {
                return Ok(Some(Path::new(&name).join(inner)));
            }
        }
    }
    Ok(None)
}

/// Checks that an array of a store, or its checkpoint, may have an entry of that name: metadata,
/// chunks.
fn is_array_entry(name: &OsStr) -> bool {
    let Some(name) = name.to_str() else {
        return false;
    };
    let is_chunk = !name.is_empty() && name.chars().all(|c| c.is_ascii_digit() || c == '.');
    is_chunk || is_unfinished_name(name) || ARRAY.contains(&name) || is_checkpoint_entry(name)
}

/// Whether a name belongs to a checkpoint.
fn is_checkpoint_entry(name: &str) -> bool {
    checkpoint::FILES.contains(&name) || name == wear_checkpoint::FILE
}

/// Whether a name belongs to a store that was never finished.
fn is_unfinished_name(name: &str) -> bool {
    name.starts_with('.') && name.ends_with(".unfinished")
}

/// Checks that there is a store, of a run, of wear or of the stress below. A store that is being
/// removed loses its metadata first.
pub(super) fn is_store(path: &Path) -> bool {
    Store::open(path).is_ok() || path.join(".zmetadata").is_file()
}

/// Restores a store that a killed process had moved aside to replace it.
pub(super) fn restore_moved_store(place: &Path) {
    let replaced = hidden_sibling(place, "replaced");
    if !place.exists() && is_store(&replaced) {
        // If that fails, the place is as it was found.
        let _ = fs::rename(replaced, place);
    }
}

/// Removes what a killed process has left at `path`, unless another process holds its lock.
fn clear(folder: &Folder, path: &Path) -> Result<(), Error> {
    if fs::symlink_metadata(path).is_err() {
        return Ok(());
    }
    let failed = |e: &dyn std::fmt::Display| {
        let path = path.display();
        folder.error(&format!(
            "{path}, left by an earlier run, cannot be removed: {e}"
        ))
    };
    let names = fs::read_dir(path).map_err(|e| failed(&e))?;
    let names: Vec<_> = names.flatten().map(|entry| entry.file_name()).collect();
    if let Some(name) = names.iter().find(|name| !is_store_entry(name)) {
        let name = name.display();
        return Err(failed(&format!("{name} in it is no part of a store")));
    }
    lock_folder(&File::open(path).map_err(|e| failed(&e))?, folder)?;
    remove(path).map_err(|e| failed(&e))
}

/// Locks a folder; fails if another process has locked it.
pub(super) fn lock_folder(lock: &File, folder: &Folder) -> Result<(), Error> {
    match lock.try_lock() {
        Err(TryLockError::WouldBlock) => Err(folder.error(&"is being written by another process")),
        _ => Ok(()),
    }
}

/// Removes a store, its metadata first.
fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path.join(".zmetadata")) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => return Err(e),
        _ => {}
    }
    fs::remove_dir_all(path)
}

/// Checks that a store may have an entry of that name, or a temporary one.
fn is_store_entry(name: &OsStr) -> bool {
    let Some(name) = name.to_str() else {
        return false;
    };
    is_unfinished_name(name)
        || name == checkpoint::FOLDER
        || METADATA.contains(&name)
        || COORDINATES.contains(&name)
        || SCALARS.iter().any(|s| s.name == name)
        || name == HALF_WIDTH.0
        || FIELDS.iter().any(|f| f.name == name)
        || Probe::all().any(|p| p.name() == name)
        || wear_catalogue::has_array(name)
}

#[cfg(test)]
mod tests;
