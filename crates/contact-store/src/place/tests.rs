//! What is at a place whenever a process dies.

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
    assert!(crate::resume(&place, None).unwrap().is_none());
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
fn a_store_with_something_else_in_it_is_not_replaced() {
    let place = place("else");
    run(&place, "old", false).unwrap();
    for theirs in ["thesis.tex", "p/notes.txt", "p/0.0.0.png"] {
        fs::write(place.join(theirs), "").unwrap();
        let refused = run(&place, "new", true).unwrap_err().to_string();
        assert!(
            refused.contains(&format!("{theirs} in it is no part")),
            "{refused}"
        );
        assert_eq!(title(&place), "old");
        fs::remove_file(place.join(theirs)).unwrap();
    }
    run(&place, "new", true).unwrap();
    assert_eq!(title(&place), "new");
    remove_all(&place);
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
fn what_came_to_the_place_meanwhile_stays() {
    let place = place("meanwhile");
    let unfinished = Unfinished::begin(&place).unwrap();
    fs::create_dir(&place).unwrap();
    let refused = unfinished.finish(false).unwrap_err().to_string();
    assert!(refused.contains("exists by now"), "{refused}");
    assert_eq!(names(&place), ["run.zarr"]);
    remove_all(&place);
}
