//! Disks that are full, folders that cannot be written, files that are cut off: a clear error, and
//! the rest intact.

#![cfg(unix)]
#![allow(clippy::unwrap_used)]

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use contact_store::Store;

const SCENE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../scenes/coated_small.toml"
);
/// Fields of 144 x 144 cells take 1 to 100 kB, a state 1200 kB, the metadata 50 kB.
const SETTINGS: &str = "--set grid.n=144 --set path.0.increments=8 --set output.save=all --quiet --set path.2.increments=2 \
                        --set path.3.increments=2 --set path.4.increments=2 --set path.5.increments=2";

fn free(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    path
}

/// A shell command with the variables $FRET, $SCENE and $OUT.
fn shell(script: &str, out: &Path) -> Output {
    Command::new("sh")
        .args(["-c", script])
        .env("FRET", env!("CARGO_BIN_EXE_fret"))
        .env("SCENE", SCENE)
        .env("OUT", out)
        .output()
        .unwrap()
}

fn error(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Fields and scalars of all increments that the store holds can be read, and are those of `whole`.
fn assert_intact(store: &Store, whole: &Store) {
    let n = store.increments();
    assert!(n > 0);
    assert!(store.saved() >= n - 1);
    assert_eq!(
        store.column("p_max").unwrap(),
        whole.column("p_max").unwrap()[..n]
    );
    for saved in 0..store.saved() {
        assert_eq!(
            store.field("q_x", saved).unwrap(),
            whole.field("q_x", saved).unwrap()
        );
    }
}

/// No file may grow beyond a limit, as if the disk were full: the run ends with the reason, what it
/// had is there, and with room again it goes on.
fn full_disk(name: &str, blocks: usize, checkpoint: f64, full: &str) {
    let whole = free(&format!("room_for_{name}"));
    let run = format!("$FRET run $SCENE -o $OUT {SETTINGS}");
    assert!(shell(&run, &whole).status.success());
    let whole = Store::open(whole).unwrap();

    let out = free(name);
    let limit = format!("trap '' XFSZ; ulimit -f {blocks}; exec");
    let ended = shell(&format!("{limit} {run} --checkpoint {checkpoint}"), &out);
    let text = error(&ended);
    assert_eq!(ended.status.code(), Some(1), "{text}");
    assert!(text.contains(&format!("{name}: {full}")), "{text}");
    assert!(text.contains("File too large"), "{text}");
    let store = Store::open(&out).unwrap();
    assert!(store.increments() < whole.increments());
    assert_intact(&store, &whole);

    let resumed = shell("$FRET resume $OUT --quiet", &out);
    assert!(resumed.status.success(), "{}", error(&resumed));
    let store = Store::open(&out).unwrap();
    assert_eq!(store.status(), "done");
    assert_eq!(store.increments(), whole.increments());
    assert_intact(&store, &whole);
}

#[test]
fn a_checkpoint_that_does_not_fit_on_the_disk() {
    full_disk("no_state.zarr", 512, 0.0, "checkpoint/state.");
}

/// Displacements are the first fields to outgrow 60 kB.
#[test]
fn fields_that_do_not_fit_on_the_disk() {
    full_disk("no_field.zarr", 120, 1000.0, "");
}

/// A folder without the right to write; root, who has that right everywhere, is refused by `/proc`.
#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = free("read_only");
    fs::create_dir_all(&folder).unwrap();
    fs::set_permissions(&folder, Permissions::from_mode(0o555)).unwrap();
    let root = fs::write(folder.join("try"), "").is_ok();
    let (place, reason) = if root {
        (Path::new("/proc/a.zarr").to_owned(), "os error")
    } else {
        (folder.join("a.zarr"), "ermission denied")
    };
    let ended = shell(&format!("$FRET run $SCENE -o $OUT {SETTINGS}"), &place);
    let text = error(&ended);
    assert_eq!(ended.status.code(), Some(1), "{text}");
    assert!(text.contains(&format!("{}: ", place.display())), "{text}");
    assert!(text.contains(reason), "{text}");
    assert!(!text.contains("are kept"), "{text}");
    assert!(!place.exists());
    fs::set_permissions(&folder, Permissions::from_mode(0o755)).unwrap();
}
