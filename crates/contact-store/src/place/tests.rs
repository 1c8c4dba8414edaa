//! Tests of the state of a place after a process has died.

#![allow(clippy::unwrap_used)]

use contact_core::march::solve;
use contact_core::scene::Scene;

use super::*;
use crate::StoreWriter;

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
    let entries = fs::read_dir(place.parent().unwrap()).unwrap();
    let name = |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name();
    let mut names: Vec<_> = entries.map(|e| name(e).into_string().unwrap()).collect();
    names.sort();
    names
}

/// A folder in which a process died while it laid a store out.
fn leave_unfinished(place: &Path, files: &[&str]) {
    let folder = hidden_sibling(place, "unfinished");
    fs::create_dir_all(folder.join("checkpoint")).unwrap();
    for file in files {
        fs::write(folder.join(file), "").unwrap();
    }
}

#[test]
fn remains_of_a_killed_process_are_cleared() {
    let store_path = place("cleared");
    for files in [&[][..], &["..zattrs.unfinished"], &[".zattrs", ".zgroup"]] {
        leave_unfinished(&store_path, files);
        run(&store_path, "new", true).unwrap();
        assert_eq!(names(&store_path), ["run.zarr"]);
    }
    // Killed while the old store was removed: its metadata go first.
    let replaced = hidden_sibling(&store_path, "replaced");
    fs::create_dir_all(replaced.join("p")).unwrap();
    run(&store_path, "newer", true).unwrap();
    assert_eq!(
        (names(&store_path), title(&store_path)),
        (vec!["run.zarr".into()], "newer".into())
    );
    remove_all(&store_path);
}

#[test]
fn a_store_that_was_moved_aside_is_put_back() {
    let store_path = place("aside");
    run(&store_path, "old", false).unwrap();
    fs::rename(&store_path, hidden_sibling(&store_path, "replaced")).unwrap();
    leave_unfinished(&store_path, &[".zattrs"]);
    // Without the leave to replace it, it is there again and stays.
    let refused = run(&store_path, "new", false).unwrap_err().to_string();
    assert!(refused.contains("--overwrite"), "{refused}");
    assert_eq!(title(&store_path), "old");
    fs::rename(&store_path, hidden_sibling(&store_path, "replaced")).unwrap();
    assert!(crate::resume(&store_path, None).unwrap().is_none());
    assert_eq!(title(&store_path), "old");
    fs::rename(&store_path, hidden_sibling(&store_path, "replaced")).unwrap();
    run(&store_path, "new", true).unwrap();
    assert_eq!(
        (names(&store_path), title(&store_path)),
        (vec!["run.zarr".into()], "new".into())
    );
    remove_all(&store_path);
}

#[test]
fn foreign_files_are_left_alone() {
    let store_path = place("theirs");
    for suffix in ["unfinished", "replaced"] {
        let theirs = hidden_sibling(&store_path, suffix);
        fs::create_dir(&theirs).unwrap();
        fs::write(theirs.join("thesis.tex"), "").unwrap();
        let refused = run(&store_path, "new", true).unwrap_err().to_string();
        assert!(refused.contains("thesis.tex in it is no part"), "{refused}");
        assert!(theirs.join("thesis.tex").exists() && !store_path.exists());
        fs::remove_dir_all(theirs).unwrap();
    }
    let another = PendingFolder::begin(&store_path).unwrap();
    let refused = run(&store_path, "new", true).unwrap_err().to_string();
    assert!(refused.contains("by another process"), "{refused}");
    drop(another);
    run(&store_path, "new", true).unwrap();
    assert_eq!(names(&store_path), ["run.zarr"]);
    remove_all(&store_path);
}

#[test]
fn a_store_with_something_else_in_it_is_not_replaced() {
    let store_path = place("else");
    run(&store_path, "old", false).unwrap();
    for theirs in ["thesis.tex", "p/notes.txt", "p/0.0.0.png"] {
        fs::write(store_path.join(theirs), "").unwrap();
        let refused = run(&store_path, "new", true).unwrap_err().to_string();
        assert!(
            refused.contains(&format!("{theirs} in it is no part")),
            "{refused}"
        );
        assert_eq!(title(&store_path), "old");
        fs::remove_file(store_path.join(theirs)).unwrap();
    }
    run(&store_path, "new", true).unwrap();
    assert_eq!(title(&store_path), "new");
    remove_all(&store_path);
}

#[cfg(unix)]
#[test]
fn a_link_to_a_store_stays_one() {
    let store = place("link");
    run(&store, "old", false).unwrap();
    let link = store.with_file_name("link.zarr");
    std::os::unix::fs::symlink(&store, &link).unwrap();
    for (path, title_there) in [(link.clone(), "new"), (link.join(""), "newer")] {
        let refused = run(&path, "never", false).unwrap_err().to_string();
        assert!(refused.contains("--overwrite"), "{refused}");
        run(&path, title_there, true).unwrap();
        assert_eq!(names(&store), ["link.zarr", "run.zarr"]);
        assert!(link.is_symlink() && !store.is_symlink());
        assert_eq!(
            (title(&store), title(&link)),
            (title_there.into(), title_there.into())
        );
    }
    fs::remove_dir_all(&store).unwrap();
    let refused = StoreWriter::create(&link, true).err().unwrap().to_string();
    assert!(
        refused.contains("is a link that leads nowhere"),
        "{refused}"
    );
    remove_all(&store);
}

#[test]
fn files_that_appear_meanwhile_stay() {
    let store_path = place("meanwhile");
    let unfinished = PendingFolder::begin(&store_path).unwrap();
    fs::create_dir(&store_path).unwrap();
    let refused = unfinished.finish(false).unwrap_err().to_string();
    assert!(refused.contains("exists by now"), "{refused}");
    assert_eq!(names(&store_path), ["run.zarr"]);
    remove_all(&store_path);
}
