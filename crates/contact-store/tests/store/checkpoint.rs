//! Runs that end early and are resumed: to the same bits, or to an error that says why not.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use crate::files::files;
use contact_core::estimate::{ErrorMethod, choose_increments, error_bars};
use contact_core::march::{Increment, March, Observer, solve};
use contact_core::{Error, Scene};
use contact_store::{Resumed, Store, StoreWriter, resume};

/// Unlike bodies, forces in both directions: everything that a state has is in use.
const SCENE: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 70e9, nu = 0.2 }
friction.mu = 0.3
grid = { n = [16, 14], extent = { a_H = 3.0 } }
path = [
    { W = 1000.0, increments = 3 },
    { T_x = { mu_W = 0.5 }, T_y = { mu_W = 0.2 }, increments = 4 },
    { T_x = { mu_W = -0.5 }, increments = 5 },
]
"#;
const END: usize = 12;

fn scene() -> Scene {
    Scene::from_toml_str(SCENE, "small.toml", &[]).unwrap()
}

fn free(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    path
}

/// Writes a checkpoint after every increment and stops after one of them: for good, or as if the
/// process had died, without a word.
struct Stop {
    writer: StoreWriter,
    after: usize,
    dies: bool,
}

impl Observer for Stop {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        self.writer.on_increment(march, increment)?;
        if increment.index == self.after {
            return Err(Error::Interrupted {
                increment: self.after,
            });
        }
        Ok(())
    }

    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        if self.dies {
            return Ok(());
        }
        self.writer.on_end(march, failure)
    }
}

/// A run that ends after an increment.
fn ended(path: &Path, after: usize, dies: bool) {
    let writer = StoreWriter::create(path, false)
        .unwrap()
        .with_interval(Duration::ZERO);
    solve(
        &scene(),
        &mut Stop {
            writer,
            after,
            dies,
        },
    )
    .unwrap_err();
}

fn taken_up(path: &Path) -> Resumed {
    resume(path, None).unwrap().expect("a run that is not done")
}

/// Goes on to the end, or to an increment before.
fn go_on(run: Resumed, after: usize) -> Result<Vec<Increment>, Error> {
    let mut writer = Stop {
        writer: run.writer.with_interval(Duration::ZERO),
        after,
        dies: false,
    };
    run.march.run(run.increments, &mut writer)
}

fn undisturbed(name: &str) -> (Vec<Increment>, BTreeMap<PathBuf, Vec<u8>>) {
    let path = free(name);
    let mut writer = StoreWriter::create(&path, false).unwrap();
    let increments = solve(&scene(), &mut writer).unwrap();
    (increments, files(&path))
}

#[test]
fn a_resumed_run_ends_with_the_same_bits_wherever_it_ended() {
    let (increments, whole) = undisturbed("undisturbed.zarr");
    for dies in [false, true] {
        for after in [1, 3, 4, 9, 11] {
            let path = free("resumed.zarr");
            ended(&path, after, dies);
            // Once more on the way, if there is room.
            let again = go_on(taken_up(&path), usize::midpoint(after, END));
            assert_eq!(
                again.is_ok(),
                after == END - 1 && usize::midpoint(after, END) == after
            );
            let all = match resume(&path, None).unwrap() {
                Some(run) => go_on(run, 0).unwrap(),
                None => again.unwrap(),
            };
            assert_eq!(all, increments);
            assert!(files(&path) == whole, "after {after}");
        }
    }
}

#[test]
fn a_run_that_is_done_has_nothing_to_resume() {
    let path = free("done.zarr");
    let mut writer = StoreWriter::create(&path, false).unwrap();
    solve(&scene(), &mut writer).unwrap();
    assert!(resume(&path, None).unwrap().is_none());
    assert!(!path.join("checkpoint").exists());
    assert!(resume(free("nothing.zarr"), None).is_err());
}

#[test]
fn a_damaged_checkpoint_falls_back_on_the_one_before() {
    let path = free("older.zarr");
    ended(&path, 9, true);
    let newest = ["checkpoint/state.0", "checkpoint/state.1"]
        .map(|name| path.join(name))
        .into_iter()
        .max_by_key(|file| fs::metadata(file).unwrap().modified().unwrap())
        .unwrap();
    let mut bytes = fs::read(&newest).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&newest, bytes).unwrap();

    let run = taken_up(&path);
    assert_eq!(run.increments.len(), 8);
    go_on(run, 0).unwrap();
    assert!(files(&path) == undisturbed("older_undisturbed.zarr").1);
}

/// A run without a checkpoint begins anew; meanwhile readers find what had been saved.
#[test]
fn what_was_saved_stays_while_the_run_catches_up() {
    let path = free("anew.zarr");
    ended(&path, 9, false);
    let shift = Store::open(&path).unwrap().column("delta_x").unwrap();
    for name in ["checkpoint/state.0", "checkpoint/state.1"] {
        fs::remove_file(path.join(name)).unwrap();
    }
    let run = taken_up(&path);
    assert!(run.increments.is_empty());
    go_on(run, 4).unwrap_err();
    let store = Store::open(&path).unwrap();
    assert_eq!(store.column("delta_x").unwrap(), shift);
    assert_eq!(store.column("saved_increment").unwrap(), [3.0, 7.0]);
    assert_eq!(store.status(), "stopped after increment 4");
    let run = taken_up(&path);
    assert_eq!(run.increments.len(), 4);
    go_on(run, 0).unwrap();
    assert!(files(&path) == undisturbed("anew_undisturbed.zarr").1);
}

/// The message of an error about a store that nothing was done to.
fn refusal(path: &Path) -> String {
    let before = files(path);
    let error = resume(path, None).err().unwrap().to_string();
    assert!(files(path) == before, "{error}");
    assert!(error.starts_with(&path.display().to_string()), "{error}");
    error
}

#[test]
fn damaged_checkpoints_are_named() {
    let path = free("damaged_checkpoint.zarr");
    ended(&path, 9, false);
    let states = ["checkpoint/state.0", "checkpoint/state.1"].map(|name| path.join(name));
    let whole = states.each_ref().map(|file| fs::read(file).unwrap());
    for state in &states {
        fs::write(state, "").unwrap();
    }
    let error = refusal(&path);
    assert!(error.contains("state.0 is damaged"), "{error}");
    assert!(error.contains("state.1 is damaged"), "{error}");
    for length in (0..whole[0].len()).step_by(97) {
        fs::write(&states[0], &whole[0][..length]).unwrap();
        refusal(&path);
    }
    for (state, bytes) in states.iter().zip(&whole) {
        fs::write(state, bytes).unwrap();
    }
    let increments = path.join("checkpoint/increments");
    let log = fs::read(&increments).unwrap();
    fs::write(&increments, &log[..20]).unwrap();
    let error = refusal(&path);
    assert!(error.contains("checkpoint/increments"), "{error}");
    fs::write(&increments, log).unwrap();
    go_on(taken_up(&path), 0).unwrap();
}

#[test]
fn a_checkpoint_of_another_version_or_scene_is_refused() {
    let path = free("other.zarr");
    ended(&path, 9, false);
    let state = path.join("checkpoint/state.0");
    fs::remove_file(path.join("checkpoint/state.1")).unwrap();
    let whole = fs::read(&state).unwrap();
    let with = |from: &[u8], to: &[u8]| {
        let at = whole.windows(from.len()).position(|w| w == from).unwrap();
        let mut content = whole[..whole.len() - 4].to_vec();
        content[at..at + from.len()].copy_from_slice(to);
        let crc = crc32fast::hash(&content);
        content.extend(crc.to_le_bytes());
        fs::write(&state, content).unwrap();
        refusal(&path)
    };
    let error = with(env!("CARGO_PKG_VERSION").as_bytes(), b"9.9.9");
    assert!(
        error.contains("is of version 9.9.9, this is version"),
        "{error}"
    );
    let error = with(b"checkpoint 7", b"checkpoint 8");
    assert!(error.contains("is of another layout"), "{error}");

    fs::write(&state, &whole).unwrap();
    let metadata = fs::read_to_string(path.join(".zmetadata")).unwrap();
    fs::write(
        path.join(".zmetadata"),
        metadata.replace("mu = 0.3", "mu = 0.4"),
    )
    .unwrap();
    let error = refusal(&path);
    assert!(error.contains("is damaged"), "{error}");
}

#[test]
fn a_store_has_one_writer() {
    let path = free("one_writer.zarr");
    ended(&path, 5, false);
    let run = taken_up(&path);
    let error = resume(&path, None).err().unwrap().to_string();
    assert!(error.contains("by another process"), "{error}");
    let mut other = StoreWriter::create(&path, true).unwrap();
    let error = solve(&scene(), &mut other).unwrap_err().to_string();
    assert!(error.contains("by another process"), "{error}");
    go_on(run, 0).unwrap();
}

/// The flag ends the run in the middle of an increment; the state is that of the last whole one.
#[test]
fn a_raised_flag_ends_the_increment() {
    struct Flagged {
        writer: StoreWriter,
        stop: Arc<AtomicBool>,
    }
    impl Observer for Flagged {
        fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
            self.stop.store(increment.index == 6, Ordering::Relaxed);
            self.writer.on_increment(march, increment)
        }
        fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
            self.writer.on_end(march, failure)
        }
        fn stop(&self) -> Option<Arc<AtomicBool>> {
            Some(self.stop.clone())
        }
    }
    let path = free("flagged.zarr");
    let mut watch = Flagged {
        writer: StoreWriter::create(&path, false).unwrap(),
        stop: Arc::default(),
    };
    let error = solve(&scene(), &mut watch).unwrap_err();
    assert_eq!(error, Error::Interrupted { increment: 6 });
    drop(watch);
    assert_eq!(
        Store::open(&path).unwrap().status(),
        "stopped after increment 6"
    );
    go_on(taken_up(&path), 0).unwrap();
    assert!(files(&path) == undisturbed("flagged_undisturbed.zarr").1);
}

/// On a large grid the fields of the increment that a run happened to be stopped after are not
/// waited for; those that the scene asks for are there at its end.
#[test]
fn a_stopped_run_on_a_large_grid_keeps_no_more_fields_than_asked_for() {
    let settings = [
        "friction.mu=0.0",
        "grid.n=[1449, 1448]",
        "grid.extent={ a_H = 40.0 }",
        "body2={ shape = \"flat\", E = 210e9, nu = 0.3 }",
        "path=[{ W = 1000.0, increments = 2 }]",
    ];
    let scene = Scene::from_toml_str(SCENE, "large.toml", &settings.map(String::from)).unwrap();
    let path = free("large.zarr");
    let mut writer = Stop {
        writer: StoreWriter::create(&path, false).unwrap(),
        after: 1,
        dies: false,
    };
    let stopped = solve(&scene, &mut writer);
    assert_eq!(stopped, Err(Error::Interrupted { increment: 1 }));
    drop(writer);
    let store = Store::open(&path).unwrap();
    assert_eq!((store.increments(), store.saved()), (1, 0));
    assert_eq!(go_on(taken_up(&path), 0).unwrap().len(), 2);
    let store = Store::open(&path).unwrap();
    assert_eq!((store.increments(), store.saved()), (2, 1));
}

/// So it does while the increments are chosen, and while the errors of the cells are found.
#[test]
fn a_raised_flag_ends_what_comes_before_and_after_the_increments() {
    let mut open = scene();
    for branch in &mut open.path.branches {
        branch.increments = None;
    }
    // Seconds of work, so that the flag is raised in the middle of it on any machine.
    open.settings.solver.path_tolerance = 1e-6;
    let stop = Arc::<AtomicBool>::default();
    thread::scope(|scope| {
        scope.spawn(|| {
            thread::sleep(Duration::from_millis(100));
            stop.store(true, Ordering::Relaxed);
        });
        let chosen = choose_increments(&open, &stop);
        assert_eq!(chosen, Err(Error::Interrupted { increment: 0 }));
    });
    let bars = error_bars(&scene(), &[], &[], ErrorMethod::FinerGrid, &stop);
    assert!(matches!(bars, Err(Error::Interrupted { .. })), "{bars:?}");
}
