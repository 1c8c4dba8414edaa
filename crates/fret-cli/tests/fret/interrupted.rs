//! Runs that are interrupted or killed: what they say, and what they leave.

use std::process::{Command, Stdio};
use std::time::Duration;

use contact_store::Store;

use crate::{SCENE, free, run, text};

/// Ctrl-C: the run ends within an increment, the store is whole.
#[cfg(unix)]
#[test]
fn an_interrupted_run_ends_cleanly() {
    use std::io::{BufRead, BufReader};

    let out = free("interrupted.zarr");
    let mut child = Command::new(env!("CARGO_BIN_EXE_fret"))
        .args(["run", SCENE, "-o", out.to_str().unwrap()])
        .args(["--set", "path.2.increments=1000000", "--set", "grid.n=32"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
    // The handler is in place once the run has begun.
    lines.find(|line| line.as_ref().unwrap().starts_with("branch 1/4"));
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap()
            .success()
    );
    let rest: Vec<_> = lines.map(Result::unwrap).collect();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{rest:?}");
    assert!(rest.iter().any(|line| line.contains("fret: stopping")));
    assert!(
        rest.iter()
            .any(|line| line.contains("increments are kept in"))
    );
    let store = Store::open(&out).unwrap();
    let last = format!("stopped after increment {}", store.increments());
    assert_eq!(store.status(), last);
    assert!(rest.iter().any(|line| line.ends_with(&last)));
    let saved = store.column("saved_increment").unwrap();
    assert_eq!(saved.last().map(|&n| n as usize), Some(store.increments()));
}

/// Ctrl-C in the middle of a volume: nothing of it is left.
#[cfg(unix)]
#[test]
fn interrupted_stress_leaves_nothing() {
    let (store, volume) = (free("stressed.zarr"), free("volume.zarr"));
    let unfinished = volume.with_file_name(".volume.zarr.unfinished");
    assert!(run(&store, &["--quiet"]).status.success());
    let (from, to) = (store.to_str().unwrap(), volume.to_str().unwrap());
    let mut child = Command::new(env!("CARGO_BIN_EXE_fret"))
        .args(["stress", from, "-o", to, "--volume", "--depths", "65000"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while !unfinished.exists() {
        assert!(child.try_wait().unwrap().is_none());
        std::thread::sleep(Duration::from_millis(1));
    }
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains("stopped, nothing was written"), "{error}");
    assert!(!volume.exists() && !unfinished.exists());
}

/// Before the first increment there is nothing to keep: it ends without solving one.
#[cfg(unix)]
#[test]
fn a_run_without_an_increment_ends_at_once() {
    let out = free("not_begun.zarr");
    let mut child = Command::new(env!("CARGO_BIN_EXE_fret"))
        .args(["run", SCENE, "-o", out.to_str().unwrap()])
        .args(["--set", "grid.n=1024"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(300));
    let id = child.id().to_string();
    let killed = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(killed.success());
    assert!(!child.wait().unwrap().success());
    assert!(!out.exists());
}

/// kill -9 at any moment: the store opens, and is as it was at its last checkpoint.
#[test]
fn a_killed_run_leaves_a_whole_store() {
    let out = free("killed.zarr");
    let mut lengths = Vec::new();
    for milliseconds in [120, 230, 430, 900, 2500] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_fret"))
            .args([
                "run",
                SCENE,
                "-o",
                out.to_str().unwrap(),
                "--overwrite",
                "--quiet",
            ])
            .args(["--set", "path.2.increments=1000000", "--set", "grid.n=32"])
            .args(["--set", "output.save=all", "--checkpoint", "0"])
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        child.kill().unwrap();
        child.wait().unwrap();
        if !out.exists() {
            continue;
        }
        let store = Store::open(&out).unwrap();
        assert_eq!(store.status(), "running");
        let n = store.increments();
        assert_eq!(store.saved(), n);
        if n > 0 {
            assert!(store.column("W").unwrap().iter().all(|&W| W == 1000.0));
            let counts: Vec<_> = (1..=n).map(|i| i as f64).collect();
            assert_eq!(store.column("increment").unwrap(), counts);
            let p_max = store.column("p_max").unwrap()[n - 1];
            let p = store.field("p", n - 1).unwrap();
            assert_eq!(p.iter().copied().fold(0.0, f64::max), p_max);
        }
        lengths.push(n);
    }
    assert!(lengths.iter().any(|&n| n > 0), "{lengths:?}");
}
