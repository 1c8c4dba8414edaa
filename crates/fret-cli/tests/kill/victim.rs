//! A run that is killed at chosen moments and resumed, and what is expected of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

use contact_store::Store;

use crate::{files, free, fret, new_run};

/// Time between two looks at what a run has reported.
const LOOK: Duration = Duration::from_millis(1);
/// A run that is killed by its progress is killed at most so many increments after the report.
const AFTER_REPORT: f64 = 3.0;

/// What is killed: a scene, and the seconds between its checkpoints.
pub(crate) struct Victim {
    settings: Vec<String>,
    checkpoint: &'static str,
    /// Time of a run that nobody disturbs, and its result.
    duration: Duration,
    whole: Store,
    expected: BTreeMap<PathBuf, Vec<u8>>,
}

impl Victim {
    pub(crate) fn new(name: &str, settings: Vec<String>, checkpoint: &'static str) -> Self {
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
    pub(crate) fn kill(&self, moments: &[Moment]) -> Vec<(Moment, usize)> {
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
pub(crate) enum Moment {
    /// So much of the time of a whole run after its begin, or after what is left of it was begun:
    /// where in the run that is, depends on how busy the machine is.
    Time(f64),
    /// Once the run has reported so much of its increments, and more than when it began; then after
    /// the time of so many increments.
    Progress { part: f64, then: f64 },
}

impl Moment {
    /// Moments over the whole length of a run, in their order; one in two by its progress.
    pub(crate) fn draw(count: usize, first_by_progress: bool, chance: &mut Chance) -> Vec<Self> {
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

    pub(crate) fn is_time(self) -> bool {
        matches!(self, Self::Time(_))
    }
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
pub(crate) struct Chance(pub(crate) u64);

impl Chance {
    pub(crate) fn draw(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
