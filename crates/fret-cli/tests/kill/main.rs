//! kill -9 at random moments: nothing that was saved is lost, and the result is that of a run that
//! nobody disturbed, bit by bit.
//!
//! `make kill` kills a hundred times, measures what the checkpoints cost, and writes both into
//! `docs/reliability.md`; the test kills a few times. `FRET_KILLS` is the number of kills,
//! `FRET_KILL_REPORT` the document.

#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::print_stdout)]

#[path = "../../../contact-core/tests/document/mod.rs"]
mod document;
#[path = "../../../contact-core/tests/files/mod.rs"]
mod files;
mod victim;
mod worn;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use contact_store::Store;

use files::files;
use victim::{Chance, Moment, Victim};

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

fn kills() -> usize {
    let asked_for = std::env::var("FRET_KILLS").ok();
    asked_for.map_or(KILLS, |n| n.parse().unwrap())
}

#[test]
#[ignore = "slow"]
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

/// Killed as soon as something lies beside the place of the store, which is new every third time
/// and replaces another one the others: the path holds nothing, the old store or the new one.
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
