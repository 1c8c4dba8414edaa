//! The same of runs of wear: killed at any moment and taken up by `fret resume`, they end in the
//! same bytes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::files::files;
use crate::victim::Chance;
use crate::{KILLS_PER_RUN, free, kills, report};

/// Time between two looks at what a run has written.
const LOOK: Duration = Duration::from_millis(1);

/// A run of wear, the time it takes when nobody disturbs it, and what it ends with.
struct Victim {
    scene: String,
    settings: Vec<&'static str>,
    duration: Duration,
    jumps: usize,
    expected: BTreeMap<PathBuf, Vec<u8>>,
}

impl Victim {
    fn new(scene: &str, settings: &[&'static str]) -> Self {
        let out = free("worn.zarr");
        let mut victim = Self {
            scene: format!("{}/../../scenes/{scene}", env!("CARGO_MANIFEST_DIR")),
            settings: settings.to_vec(),
            duration: Duration::ZERO,
            jumps: 0,
            expected: BTreeMap::new(),
        };
        let begun = Instant::now();
        let mut run = victim.begin(&out);
        assert!(run.wait().unwrap().success());
        victim.duration = begun.elapsed();
        victim.jumps = jumps(&out);
        victim.expected = files(&out);
        assert!(victim.jumps >= 4);
        victim
    }

    fn begin(&self, out: &Path) -> Child {
        let mut command = fret(&["wear", &self.scene, "-o", out.to_str().unwrap()]);
        for setting in &self.settings {
            command.args(["--set", setting]);
        }
        command.spawn().unwrap()
    }

    /// Kills a run up to so many times, and lets it go to its end. How many jumps were kept at each
    /// kill.
    fn kill(&self, times: usize, chance: &mut Chance) -> Vec<usize> {
        let out = free("worn_killed.zarr");
        let mut kept = Vec::new();
        for n in 0..times {
            let mut run = if out.exists() {
                resume(&out).spawn().unwrap()
            } else {
                self.begin(&out)
            };
            let before = jumps(&out);
            // One in two once a further jump is there, then at any moment of the next; the others
            // by time alone.
            let then = if n % 2 == 0 {
                while jumps(&out) <= before && run.try_wait().unwrap().is_none() {
                    sleep(LOOK);
                }
                2.0 * chance.draw() / self.jumps as f64
            } else {
                chance.draw()
            };
            sleep(self.duration.mul_f64(then));
            if let Some(status) = run.try_wait().unwrap() {
                assert!(status.success());
                break;
            }
            run.kill().unwrap();
            run.wait().unwrap();
            let now = jumps(&out);
            assert!(now >= before, "{now} of {before} jumps");
            kept.push(now);
        }
        let end = if out.exists() {
            resume(&out).output().unwrap()
        } else {
            self.begin(&out).wait_with_output().unwrap()
        };
        let text = String::from_utf8_lossy(&end.stderr);
        assert!(end.status.success(), "{text}");
        let found = files(&out);
        let odd: Vec<_> = (found
            .keys()
            .filter(|name| !self.expected.contains_key(*name)))
        .chain(
            self.expected
                .keys()
                .filter(|name| !found.contains_key(*name)),
        )
        .collect();
        assert!(odd.is_empty(), "{odd:?}, killed after {kept:?}");
        for (name, bytes) in &self.expected {
            let same = found[name] == *bytes;
            assert!(same, "{} differs, killed after {kept:?}", name.display());
        }
        kept
    }
}

fn fret(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fret"));
    command
        .args(arguments)
        .arg("--quiet")
        .stderr(Stdio::piped());
    command
}

fn resume(out: &Path) -> Command {
    fret(&["resume", out.to_str().unwrap()])
}

/// Jumps that a store holds, 0 where there is none.
fn jumps(out: &Path) -> usize {
    let document = std::fs::read_to_string(out.join("cycles/.zarray"));
    let number = |text: String| {
        let shape = text
            .split("\"shape\":")
            .nth(1)?
            .split(']')
            .next()?
            .to_owned();
        shape.trim_matches([' ', '[', '\n']).parse().ok()
    };
    document.ok().and_then(number).unwrap_or(0)
}

#[test]
#[ignore = "slow"]
fn killed_runs_of_wear_are_resumed_to_the_same_bits() {
    let kills = kills();
    let victims = [
        Victim::new(
            "wear_mccoll.toml",
            &["grid.n=160", "wear.cycles=6000", "wear.tolerance=0.005"],
        ),
        Victim::new(
            "wear_coated.toml",
            &["grid.n=24", "wear.cycles=4000", "wear.tolerance=0.01"],
        ),
    ];
    let mut chance = Chance(13);
    let (mut killed, mut runs) = (Vec::new(), 0);
    while killed.len() < kills {
        let count = KILLS_PER_RUN.min(kills - killed.len());
        killed.extend(victims[runs % 2].kill(count, &mut chance));
        runs += 1;
    }
    let went_on = killed.iter().filter(|&&jumps| jumps > 0).count();
    report(
        "kills of wear",
        &format!(
            "{kills} kills in {runs} runs of wear, a cylinder in gross slip and a coated sphere in partial slip: \
             after {went_on} of them there were jumps to go on from. Every run ended with the same bytes in every \
             file as one that nobody disturbed."
        ),
    );
}
