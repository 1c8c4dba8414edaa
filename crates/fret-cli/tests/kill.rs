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
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

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
const KILLS: usize = 8;
/// Kills in one run at most; then it is let go to its end.
const KILLS_PER_RUN: usize = 4;
/// Time between two looks at what a run has reported.
const LOOK: Duration = Duration::from_millis(5);

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

/// What is killed: a scene, and the seconds between its checkpoints.
struct Victim {
    settings: Vec<String>,
    checkpoint: &'static str,
    /// Time of a run that nobody disturbs, and its result.
    duration: Duration,
    whole: Store,
    expected: BTreeMap<PathBuf, Vec<u8>>,
}

impl Victim {
    fn new(name: &str, settings: Vec<String>, checkpoint: &'static str) -> Self {
        let out = free(name);
        let begun = Instant::now();
        let run = new_run(&settings, &out, checkpoint).status();
        let duration = begun.elapsed();
        assert!(run.unwrap().success());
        Self {
            settings,
            checkpoint,
            duration,
            expected: files(&out),
            whole: Store::open(&out).unwrap(),
        }
    }

    /// Kills a run at moments over its whole length, each given as a part of it, or until it is
    /// done; if `reported`, once it has reported an increment at least. How many increments every
    /// killed run had reported.
    fn kill(&self, mut moments: Vec<f64>, reported: bool) -> Vec<usize> {
        let out = free("killed.zarr");
        moments.sort_by(f64::total_cmp);
        let (mut killed, mut saved) = (Vec::new(), 0);
        for moment in moments {
            let mut run = if out.exists() {
                fret(&["resume", out.to_str().unwrap()], self.checkpoint)
            } else {
                new_run(&self.settings, &out, self.checkpoint)
            };
            let before = killed.last().copied().unwrap_or(0);
            let mut run = run.spawn().unwrap();
            if reported {
                wait_for_an_increment(&mut run, &out);
            }
            let reached = before as f64 / self.whole.increments() as f64;
            sleep(self.duration.mul_f64((moment - reached).max(0.0)));
            if let Some(status) = run.try_wait().unwrap() {
                assert!(status.success());
                break;
            }
            run.kill().unwrap();
            run.wait().unwrap();
            let mut increments = 0;
            if out.exists() && !out.join(".zmetadata").exists() {
                // Killed while the store was laid out: nothing had been reported.
                assert_eq!((before, saved), (0, 0));
                fs::remove_dir_all(&out).unwrap();
            }
            if out.exists() {
                let store = Store::open(&out).unwrap();
                increments = store.increments();
                assert!(increments >= before && store.saved() >= saved);
                saved = store.saved();
                check(&store, &self.whole);
            }
            killed.push(increments);
        }
        if out.exists() {
            let end = fret(&["resume", out.to_str().unwrap()], "5").output();
            let end = end.unwrap();
            let text = String::from_utf8_lossy(&end.stderr);
            assert!(end.status.success(), "{text}");
            assert!(files(&out) == self.expected, "killed after {killed:?}");
        }
        killed
    }
}

fn wait_for_an_increment(run: &mut Child, out: &Path) {
    let reported = || Store::open(out).is_ok_and(|store| store.increments() > 0);
    while !reported() && run.try_wait().unwrap().is_none() {
        sleep(LOOK);
    }
}

fn new_run(settings: &[String], out: &Path, checkpoint: &str) -> Command {
    let mut arguments = vec!["run", SCENE, "-o", out.to_str().unwrap()];
    for setting in settings {
        arguments.extend(["--set", setting]);
    }
    fret(&arguments, checkpoint)
}

/// A path of `increments` in each branch.
fn short(increments: usize) -> Vec<String> {
    let branches = 0..6;
    branches
        .map(|n| format!("path.{n}.increments={increments}"))
        .collect()
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
    // A checkpoint after every increment: most kills hit one; and as few as run time allows, so
    // that a kill costs many increments.
    let mut often = short(10);
    often.push("grid.n=32".into());
    let victims = [
        Victim::new("often.zarr", often, "0"),
        Victim::new("seldom.zarr", vec!["grid.n=128".into()], "0.02"),
    ];
    let mut chance = Chance(7);
    let (mut killed, mut runs) = (Vec::new(), 0);
    while killed.len() < kills {
        let moments = KILLS_PER_RUN.min(kills - killed.len());
        let moments = (0..moments).map(|_| chance.draw()).collect();
        killed.extend(victims[runs % 2].kill(moments, runs / 2 % 2 == 1));
        runs += 1;
    }
    let went_on = killed.iter().filter(|&&increments| increments > 0).count();
    // The kills are no formality: after most of them there was something to go on from.
    assert!(2 * went_on > kills, "{went_on} of {kills}: {killed:?}");
    report(
        "kills",
        &format!(
            "{kills} kills in {runs} runs; after {went_on} of them there were increments to go on \
             from. No increment and no field reported as saved was lost, and every run ended with \
             the same bytes in every file as one that nobody disturbed."
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
    let short = short(3);
    let mut more = vec!["--checkpoint", "0"];
    for setting in &short {
        more.extend(["--set", setting]);
    }
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
