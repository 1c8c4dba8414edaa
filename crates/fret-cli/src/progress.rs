//! A bar with the time left, and one line per loading branch.

use std::time::{Duration, Instant};

use contact_core::Scene;
use contact_core::march::{Increment, summarise};
use indicatif::{ProgressBar, ProgressStyle};

use crate::summary;
use crate::terminal::{can_draw, print_message};

const TEMPLATE: &str = "{bar:10} {pos}/{len} increments, {elapsed}, {eta} left  {wide_msg}";
const TICK: Duration = Duration::from_millis(200);

/// The display on the standard error during the run.
pub(crate) struct Progress {
    /// None if quiet.
    shown: Option<Display>,
}

struct Display {
    bar: ProgressBar,
    scene: Scene,
    branch_began: Instant,
}

impl Progress {
    /// A bar for the increments of a scene: none if `quiet`, invisible outside of a terminal.
    pub(crate) fn new(scene: &Scene, quiet: bool) -> Self {
        if quiet {
            return Self { shown: None };
        }
        let bar = if can_draw() {
            ProgressBar::new(scene.path.increments() as u64)
        } else {
            ProgressBar::hidden()
        };
        if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
            bar.set_style(style);
        }
        bar.set_message("influence coefficients");
        bar.enable_steady_tick(TICK);
        let shown = Display {
            bar,
            scene: scene.clone(),
            branch_began: Instant::now(),
        };
        Self { shown: Some(shown) }
    }

    /// Advances the display by the last of the increments so far.
    pub(crate) fn on_increment(&mut self, increments: &[Increment]) {
        let (Some(shown), Some(last)) = (&mut self.shown, increments.last()) else {
            return;
        };
        shown.bar.set_message("");
        shown.bar.set_position(last.index as u64);
        if !last.point.ends_branch {
            return;
        }
        let of_branch = increments
            .iter()
            .rposition(|i| i.point.branch != last.point.branch)
            .map_or(increments, |before| &increments[before + 1..]);
        let seconds = shown.branch_began.elapsed().as_secs_f64();
        shown.branch_began = Instant::now();
        for branch in summarise(of_branch) {
            let line = summary::line(&shown.scene, &branch, last.point.t);
            shown
                .bar
                .suspend(|| print_message(&format!("{line}, {seconds:.1} s")));
        }
    }

    /// Removes the bar.
    pub(crate) fn end(self) {
        if let Some(shown) = self.shown {
            shown.bar.finish_and_clear();
        }
    }
}
