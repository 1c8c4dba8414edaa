//! kill -9 at random moments: nothing that was saved is lost, and the result is that of a run that
//! nobody disturbed, bit by bit.
//!
//! `make kill` kills a hundred times, measures what the checkpoints cost, and writes both into
//! `docs/reliability.md`; the test kills a few times. `FRET_KILLS` is the number of kills,
//! `FRET_KILL_REPORT` the document.

#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::print_stdout)]

#[path = "../../contact-core/tests/document/mod.rs"]
mod document;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Instant;

use contact_core::output::Store;

const SCENE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../scenes/coated_small.toml"
);
/// The paper's scene, as it stands: 1000 increments on 256 x 256 cells.
const PAPER: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../scenes/coated_fretting.toml"
);
/// Largest part of a run's time that its checkpoints may take \[%\].
const SHARE: f64 = 3.0;
/// Kills, unless the environment says how many.
const KILLS: usize = 12;
/// Kills in one run at most; then it is let go to its end.
const KILLS_PER_RUN: usize = 4;

fn free(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    path
}

fn fret(arguments: &[&str], checkpoint: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fret"));
    command
        .args(arguments)
        .args(["--quiet", "--checkpoint", checkpoint])
        .stderr(Stdio::piped());
    command
}

fn new_run(out: &Path, checkpoint: &str) -> Command {
    let out = out.to_str().unwrap();
    fret(&["run", SCENE, "--set", "grid.n=32", "-o", out], checkpoint)
}

/// Every file of the store and its bytes.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path).into_iter().map(|(name, bytes)| {
                let below = Path::new(path.file_name().unwrap()).join(name);
                (below, bytes)
            }));
        } else {
            let name = path.file_name().unwrap().into();
            found.insert(name, fs::read(&path).unwrap());
        }
    }
    found
}

/// What the killed run says it has saved is there, and is right.
fn check(killed: &Store, whole: &Store) {
    let n = killed.increments();
    for name in ["t", "delta_x", "p_max", "convolutions"] {
        if n > 0 {
            assert_eq!(
                killed.column(name).unwrap(),
                whole.column(name).unwrap()[..n]
            );
        }
    }
    for saved in 0..killed.saved() {
        for name in ["p", "q_x", "slip_x"] {
            let field = whole.field(name, saved).unwrap();
            assert_eq!(killed.field(name, saved).unwrap(), field);
        }
    }
}

/// The same numbers in every run: a congruential sequence, 0 to 1.
struct Chance(u64);

impl Chance {
    fn draw(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn killed_runs_are_resumed_to_the_same_bits() {
    let asked_for = std::env::var("FRET_KILLS").ok();
    let kills = asked_for.map_or(KILLS, |n| n.parse().unwrap());
    let whole = free("undisturbed.zarr");
    let begun = Instant::now();
    assert!(new_run(&whole, "5").status().unwrap().success());
    let duration = begun.elapsed();
    let expected = files(&whole);
    let whole = Store::open(&whole).unwrap();

    let mut chance = Chance(7);
    let (mut done, mut taken_up, mut runs) = (0, 0, 0);
    while done < kills {
        // Half of the runs write a checkpoint after every increment: most kills hit one.
        let checkpoint = if chance.draw() < 0.5 { "0" } else { "0.02" };
        let out = free("killed.zarr");
        runs += 1;
        let (mut increments, mut saved) = (0, 0);
        for _ in 0..KILLS_PER_RUN.min(kills - done) {
            let mut run = if out.exists() {
                fret(&["resume", out.to_str().unwrap()], checkpoint)
            } else {
                new_run(&out, checkpoint)
            };
            let mut run = run.spawn().unwrap();
            sleep(duration.mul_f64(chance.draw()));
            if let Some(status) = run.try_wait().unwrap() {
                assert!(status.success());
                break;
            }
            run.kill().unwrap();
            run.wait().unwrap();
            done += 1;
            if !out.exists() {
                continue;
            }
            let store = Store::open(&out).unwrap();
            assert!(store.increments() >= increments && store.saved() >= saved);
            (increments, saved) = (store.increments(), store.saved());
            check(&store, &whole);
        }
        if out.exists() {
            taken_up += usize::from(increments > 0);
            let end = fret(&["resume", out.to_str().unwrap()], "5")
                .output()
                .unwrap();
            assert!(
                end.status.success(),
                "{}",
                String::from_utf8_lossy(&end.stderr)
            );
            assert!(files(&out) == expected, "{done} kills");
        }
    }
    // The kills are no formality: most runs had something to go on from.
    assert!(
        4 * taken_up * KILLS_PER_RUN > kills,
        "{taken_up} of {kills}"
    );
    report(
        "kills",
        &format!(
            "{done} kills in {runs} runs, of which {taken_up} had increments to go on from; no \
             increment and no field reported as saved was lost, and every run ended with the same \
             bytes in every file as one that nobody disturbed."
        ),
    );
}

/// Writes into the document, if there is one to write into.
fn report(name: &str, text: &str) {
    println!("{text}");
    if let Ok(document) = std::env::var("FRET_KILL_REPORT") {
        document::insert(&document, name, text);
    }
}

/// What the summary says of the checkpoints of a run: all seconds, those for the checkpoints, their
/// share in percent and their number.
fn checkpoints(scene: &str, out: &Path, more: &[&str]) -> [f64; 4] {
    let run = Command::new(env!("CARGO_BIN_EXE_fret"))
        .args(["run", scene, "-o", out.to_str().unwrap()])
        .args(more)
        .output()
        .unwrap();
    let text = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.success(), "{text}");
    let line = text.lines().find(|line| line.ends_with(" checkpoints"));
    let numbers = line.unwrap_or_else(|| panic!("{text}"));
    let numbers = numbers
        .split([' ', '('])
        .filter_map(|word| word.parse().ok());
    numbers.collect::<Vec<_>>().try_into().unwrap()
}

/// The summary tells the cost; for the paper's scene `make kill` puts it down.
#[test]
fn checkpoints_take_little_of_the_time() {
    let out = free("small.zarr");
    let short = (0..6).flat_map(|n| ["--set".to_owned(), format!("path.{n}.increments=3")]);
    let more: Vec<_> = short
        .chain(["--checkpoint".to_owned(), "0".to_owned()])
        .collect();
    let more: Vec<_> = more.iter().map(String::as_str).collect();
    let [_, _, _, count] = checkpoints(SCENE, &out, &more);
    let increments = Store::open(&out).unwrap().increments();
    assert_eq!(count as usize, increments);

    if std::env::var_os("FRET_KILL_REPORT").is_some() {
        let [all, spent, share, count] = checkpoints(PAPER, &free("paper.zarr"), &[]);
        assert!(share < SHARE, "{share} %");
        report(
            "checkpoints",
            &format!(
                "`fret run scenes/coated_fretting.toml`, 256 x 256 cells, as it comes: {all:.1} s, \
                 of these {spent:.2} s ({share:.1} %) for {count} checkpoints."
            ),
        );
    }
}
