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
/// Kills at the moment at which a store is laid out, for each of those.
const KILLS_OF_LAYOUTS: f64 = 0.5;
/// Time within which a store is laid out and put in its place, more or less.
const LAYOUT: Duration = Duration::from_millis(1);
/// Kills in one run at most; then it is let go to its end.
const KILLS_PER_RUN: usize = 4;
/// Time between two looks at what a run has reported.
const LOOK: Duration = Duration::from_millis(1);
/// A run that is killed by its progress is killed at most so many increments after the report.
const AFTER_REPORT: f64 = 3.0;

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

    /// Kills a run at these moments, or until it is done, and resumes it to its end. How many
    /// increments it had reported, by kill.
    fn kill(&self, moments: &[Moment]) -> Vec<(Moment, usize)> {
        let out = free("killed.zarr");
        let (mut killed, mut before, mut saved) = (Vec::new(), 0, 0);
        for &moment in moments {
            let mut run = if out.exists() {
                fret(&["resume", out.to_str().unwrap()], self.checkpoint)
            } else {
                new_run(&self.settings, &out, self.checkpoint)
            };
            let mut run = run.spawn().unwrap();
            let seen = self.wait_for(moment, &mut run, &out, before);
            if let Some(status) = run.try_wait().unwrap() {
                assert!(status.success());
                break;
            }
            run.kill().unwrap();
            run.wait().unwrap();
            let mut increments = 0;
            if out.exists() {
                let store = Store::open(&out).unwrap();
                increments = store.increments();
                assert!(store.saved() >= saved);
                saved = store.saved();
                check(&store, &self.whole);
            }
            assert!(
                increments >= seen,
                "{increments} of {seen} after {moment:?}"
            );
            killed.push((moment, increments));
            before = increments;
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

    /// Waits for the moment, or for the end of a run that had reported `before` increments when it
    /// began. How many it has been seen to report.
    fn wait_for(&self, moment: Moment, run: &mut Child, out: &Path, before: usize) -> usize {
        let whole = self.whole.increments();
        match moment {
            Moment::Time(part) => {
                let reached = before as f64 / whole as f64;
                sleep(self.duration.mul_f64((part - reached).max(0.0)));
                before
            }
            Moment::Progress { part, then } => {
                let wanted = ((part * whole as f64) as usize).max(before + 1);
                let reported = || Store::open(out).map_or(0, |store| store.increments());
                let mut seen = reported();
                while seen < wanted && run.try_wait().unwrap().is_none() {
                    sleep(LOOK);
                    seen = reported();
                }
                sleep(self.duration.mul_f64(then / whole as f64));
                seen
            }
        }
    }
}

/// When a run is killed.
#[derive(Clone, Copy, Debug)]
enum Moment {
    /// So much of the time of a whole run after its begin, or after what is left of it was begun:
    /// where in the run that is, depends on how busy the machine is.
    Time(f64),
    /// Once the run has reported so much of its increments, and more than when it began; then after
    /// the time of so many increments.
    Progress { part: f64, then: f64 },
}

impl Moment {
    /// Moments over the whole length of a run, in their order; one in two by its progress.
    fn draw(count: usize, first_by_progress: bool, chance: &mut Chance) -> Vec<Self> {
        let mut parts: Vec<_> = (0..count).map(|_| chance.draw()).collect();
        parts.sort_by(f64::total_cmp);
        let moment = |(n, part)| {
            if (n % 2 == 0) == first_by_progress {
                let then = AFTER_REPORT * chance.draw();
                Self::Progress { part, then }
            } else {
                Self::Time(part)
            }
        };
        parts.into_iter().enumerate().map(moment).collect()
    }

    fn is_time(self) -> bool {
        matches!(self, Self::Time(_))
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

fn kills() -> usize {
    let asked_for = std::env::var("FRET_KILLS").ok();
    asked_for.map_or(KILLS, |n| n.parse().unwrap())
}

#[test]
fn killed_runs_are_resumed_to_the_same_bits() {
    let kills = kills();
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
        let count = KILLS_PER_RUN.min(kills - killed.len());
        let moments = Moment::draw(count, runs / 2 % 2 == 1, &mut chance);
        killed.extend(victims[runs % 2].kill(&moments));
        runs += 1;
    }
    // How far a run is after a while depends on the machine; one that has reported an increment has
    // something to go on from on every machine.
    let (by_time, by_progress): (Vec<_>, Vec<_>) =
        killed.into_iter().partition(|(moment, _)| moment.is_time());
    assert!(!by_progress.is_empty() && by_progress.iter().all(|&(_, increments)| increments > 0));
    let went_on = by_time.iter().filter(|&&(_, increments)| increments > 0);
    report(
        "kills",
        &format!(
            "{kills} kills in {runs} runs: {} at random times, after {} of which there were \
             increments to go on from, and {} after random numbers of increments, all of which were \
             there. No increment and no field reported as saved was lost, and every run ended with \
             the same bytes in every file as one that nobody disturbed.",
            by_time.len(),
            went_on.count(),
            by_progress.len()
        ),
    );
}

/// What a process was killed over, beside the place of its store.
fn left_beside(out: &Path) -> Vec<PathBuf> {
    let name = out.file_name().unwrap().to_str().unwrap();
    let beside = |suffix| out.with_file_name(format!(".{name}.{suffix}"));
    let both = ["unfinished", "replaced"].map(beside);
    both.into_iter().filter(|path| path.exists()).collect()
}

fn title(out: &Path) -> Option<String> {
    let store = out.exists().then(|| Store::open(out).unwrap());
    store.map(|store| store.scene().title.clone())
}

/// Killed as soon as something lies beside the place of the store, which is new every third time and
/// replaces another one the others: the path holds nothing, the old store or the new one.
#[test]
fn a_path_holds_a_store_or_nothing_while_one_is_laid_out() {
    let out = free("replaced.zarr");
    for path in left_beside(&out) {
        fs::remove_dir_all(path).unwrap();
    }
    let run = |title: &str, overwrite: bool| {
        let mut settings = short(1);
        settings.extend(["grid.n=16".into(), format!("title={title:?}")]);
        let mut run = new_run(&settings, &out, "0");
        if overwrite {
            run.arg("--overwrite");
        }
        run
    };
    let mut chance = Chance(11);
    let kills = (KILLS_OF_LAYOUTS * kills() as f64) as usize;
    let (mut killed, mut between) = (0, 0);
    for n in 0..kills {
        if n % 3 == 0 && out.exists() {
            fs::remove_dir_all(&out).unwrap();
        }
        let (old, new) = (title(&out), format!("run {n}"));
        let before = left_beside(&out);
        let mut process = run(&new, true).spawn().unwrap();
        while left_beside(&out) == before && process.try_wait().unwrap().is_none() {
            std::hint::spin_loop();
        }
        let seen = Instant::now();
        let then = LAYOUT.mul_f64(chance.draw());
        while seen.elapsed() < then {
            std::hint::spin_loop();
        }
        process.kill().unwrap();
        process.wait().unwrap();
        killed += usize::from(!left_beside(&out).is_empty());
        match (title(&out), old) {
            // Killed between the two: the next run finds the old store, and refuses to replace it.
            (None, Some(old)) => {
                between += 1;
                assert_eq!(run(&new, false).status().unwrap().code(), Some(2));
                assert_eq!(title(&out), Some(old));
            }
            (found, old) => assert!(found == old || found == Some(new), "{found:?}"),
        }
    }
    assert!(run("the last", true).status().unwrap().success());
    assert_eq!(title(&out), Some("the last".into()));
    assert_eq!(left_beside(&out), Vec::<PathBuf>::new());
    report(
        "layouts",
        &format!(
            "{kills} kills as soon as a store was laid out, two in three to replace another one: {killed} \
             left something unfinished behind, {between} of them just when the old store was moved \
             aside. Every path held nothing, the old store or the new one, or the next run put the \
             old one back; the last run cleared what the others had left."
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
