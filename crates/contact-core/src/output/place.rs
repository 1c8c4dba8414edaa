//! A store is laid out beside its place and put there at once.
//!
//! ```text
//! .NAME.unfinished   what will be at NAME
//! .NAME.replaced     what was at NAME
//! ```
//!
//! With a store to be replaced the steps are: NAME becomes `.NAME.replaced`, `.NAME.unfinished` becomes
//! NAME, `.NAME.replaced` goes. Whenever the process dies, NAME is nothing, the old store or the new one;
//! between the first two steps, where it is nothing, whoever writes there next or resumes puts the
//! old store back ([`mend`]). What else is left goes when the same place is written again.

use std::ffi::OsStr;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::catalogue::{FIELDS, SCALARS};
use super::checkpoint::{self, Checkpoints};
use super::folder::{Folder, beside};
use super::reader::Store;
use crate::error::Error;
use crate::fields::Probe;

const METADATA: [&str; 3] = [".zgroup", ".zattrs", ".zmetadata"];
/// Coordinates of the stores of a run and of the stress below it.
const COORDINATES: [&str; 6] = ["x", "y", "saved_increment", "saved_t", "z", "layer"];

/// A folder on its way to its place; one that does not get there is removed.
#[derive(Debug)]
pub(super) struct Unfinished {
    folder: Arc<Folder>,
    place: PathBuf,
    /// The folder, locked: a place has one writer.
    _lock: File,
    in_place: bool,
}

impl Unfinished {
    /// An empty folder beside its place, which is cleared of what a killed process has left there.
    pub(super) fn begin(place: &Path) -> Result<Self, Error> {
        let folder = Folder::on_its_way(place, beside(place, "unfinished"));
        if place.file_name().is_none() {
            return Err(folder.error(&"is no name for a store"));
        }
        clear(&folder, folder.root())?;
        let replaced = beside(place, "replaced");
        if place.exists() || Store::open(&replaced).is_err() {
            clear(&folder, &replaced)?;
        }
        let begin = || {
            fs::create_dir_all(folder.root())?;
            File::open(folder.root())
        };
        let lock = begin().map_err(|e| folder.error(&e))?;
        is_free(&lock, &folder)?;
        Ok(Self {
            folder,
            place: place.to_owned(),
            _lock: lock,
            in_place: false,
        })
    }

    /// Where to write meanwhile; errors name the place.
    pub(super) fn folder(&self) -> &Arc<Folder> {
        &self.folder
    }

    /// Puts the folder in its place, where there must be nothing, or a store that nobody writes if it is
    /// to be replaced.
    pub(super) fn finish(mut self, replace: bool) -> Result<Arc<Folder>, Error> {
        let failed = |e: io::Error| {
            self.folder
                .error(&format!("cannot be put in its place: {e}"))
        };
        let (place, replaced) = (Folder::new(&self.place), beside(&self.place, "replaced"));
        let old = replace && self.place.exists();
        if old {
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
            // The new store is in its place: what cannot be removed now is no reason to fail.
            let _ = remove(&replaced);
        }
        Ok(place)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if !self.in_place {
            // Nothing can be done if it stays.
            let _ = fs::remove_dir_all(self.folder.root());
        }
    }
}

/// Puts a store back that a killed process had moved aside to replace it, but did not.
pub(super) fn mend(place: &Path) {
    let replaced = beside(place, "replaced");
    if !place.exists() && Store::open(&replaced).is_ok() {
        // If that fails, the place is as it was found.
        let _ = fs::rename(replaced, place);
    }
}

/// Removes what a killed process has left at `path`, if it is that.
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
    if let Some(name) = names.iter().find(|name| !is_of_a_store(name)) {
        let name = name.display();
        return Err(failed(&format!("{name} in it is no part of a store")));
    }
    is_free(&File::open(path).map_err(|e| failed(&e))?, folder)?;
    remove(path).map_err(|e| failed(&e))
}

/// Locks a folder; fails if another process has.
fn is_free(lock: &File, folder: &Folder) -> Result<(), Error> {
    match lock.try_lock() {
        Err(TryLockError::WouldBlock) => Err(folder.error(&"is being written by another process")),
        _ => Ok(()),
    }
}

/// Removes a store, first that which makes it one.
fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path.join(".zmetadata")) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => return Err(e),
        _ => {}
    }
    fs::remove_dir_all(path)
}

/// Whether a store has an entry of that name, or one on its way to it.
fn is_of_a_store(name: &OsStr) -> bool {
    let Some(name) = name.to_str() else {
        return false;
    };
    let on_its_way = |name: &str| name.starts_with('.') && name.ends_with(".unfinished");
    on_its_way(name)
        || name == checkpoint::FOLDER
        || METADATA.contains(&name)
        || COORDINATES.contains(&name)
        || SCALARS.iter().any(|s| s.name == name)
        || FIELDS.iter().any(|f| f.name == name)
        || Probe::all().any(|p| p.name() == name)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::march::solve;
    use crate::output::StoreWriter;
    use crate::scene::Scene;

    const SCENE: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction.mu = 0.0
grid = { n = 8, extent = { a_H = 3.0 } }
path = [{ W = 1000.0, increments = 1 }]
"#;

    /// An empty folder, and a place in it.
    fn place(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("fret-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir(&folder).unwrap();
        folder.join("run.zarr")
    }

    fn run(place: &Path, title: &str, overwrite: bool) -> Result<(), Error> {
        let title = format!("title=\"{title}\"");
        let scene = Scene::from_toml_str(SCENE, "scene.toml", &[title]).unwrap();
        solve(&scene, &mut StoreWriter::create(place, overwrite)?).map(drop)
    }

    fn title(place: &Path) -> String {
        Store::open(place).unwrap().scene().title.clone()
    }

    fn remove_all(place: &Path) {
        fs::remove_dir_all(place.parent().unwrap()).unwrap();
    }

    /// The names beside the place and its own.
    fn names(place: &Path) -> Vec<String> {
        let found = fs::read_dir(place.parent().unwrap()).unwrap();
        let name = |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name();
        let mut names: Vec<_> = found.map(|e| name(e).into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// A folder in which a process died while it laid a store out.
    fn leave_unfinished(place: &Path, files: &[&str]) {
        let folder = beside(place, "unfinished");
        fs::create_dir_all(folder.join("checkpoint")).unwrap();
        for file in files {
            fs::write(folder.join(file), "").unwrap();
        }
    }

    #[test]
    fn what_a_kill_leaves_is_cleared() {
        let place = place("cleared");
        for files in [&[][..], &["..zattrs.unfinished"], &[".zattrs", ".zgroup"]] {
            leave_unfinished(&place, files);
            run(&place, "new", true).unwrap();
            assert_eq!(names(&place), ["run.zarr"]);
        }
        // Killed while the old store was removed: its metadata go first.
        let replaced = beside(&place, "replaced");
        fs::create_dir_all(replaced.join("p")).unwrap();
        run(&place, "newer", true).unwrap();
        assert_eq!(
            (names(&place), title(&place)),
            (vec!["run.zarr".into()], "newer".into())
        );
        remove_all(&place);
    }

    #[test]
    fn a_store_that_was_moved_aside_is_put_back() {
        let place = place("aside");
        run(&place, "old", false).unwrap();
        fs::rename(&place, beside(&place, "replaced")).unwrap();
        leave_unfinished(&place, &[".zattrs"]);
        // Without the leave to replace it, it is there again and stays.
        let refused = run(&place, "new", false).unwrap_err().to_string();
        assert!(refused.contains("--overwrite"), "{refused}");
        assert_eq!(title(&place), "old");
        fs::rename(&place, beside(&place, "replaced")).unwrap();
        assert!(crate::output::resume(&place, None).unwrap().is_none());
        assert_eq!(title(&place), "old");
        fs::rename(&place, beside(&place, "replaced")).unwrap();
        run(&place, "new", true).unwrap();
        assert_eq!(
            (names(&place), title(&place)),
            (vec!["run.zarr".into()], "new".into())
        );
        remove_all(&place);
    }

    #[test]
    fn what_is_not_ours_is_left_alone() {
        let place = place("theirs");
        for suffix in ["unfinished", "replaced"] {
            let theirs = beside(&place, suffix);
            fs::create_dir(&theirs).unwrap();
            fs::write(theirs.join("thesis.tex"), "").unwrap();
            let refused = run(&place, "new", true).unwrap_err().to_string();
            assert!(refused.contains("thesis.tex in it is no part"), "{refused}");
            assert!(theirs.join("thesis.tex").exists() && !place.exists());
            fs::remove_dir_all(theirs).unwrap();
        }
        let another = Unfinished::begin(&place).unwrap();
        let refused = run(&place, "new", true).unwrap_err().to_string();
        assert!(refused.contains("by another process"), "{refused}");
        drop(another);
        run(&place, "new", true).unwrap();
        assert_eq!(names(&place), ["run.zarr"]);
        remove_all(&place);
    }

    #[test]
    fn what_came_to_the_place_meanwhile_stays() {
        let place = place("meanwhile");
        let unfinished = Unfinished::begin(&place).unwrap();
        fs::create_dir(&place).unwrap();
        let refused = unfinished.finish(false).unwrap_err().to_string();
        assert!(refused.contains("exists by now"), "{refused}");
        assert_eq!(names(&place), ["run.zarr"]);
        remove_all(&place);
    }
}
