//! The loads at the end of each increment of a load path.

use serde::{Deserialize, Serialize};

use super::LoadPath;
use crate::scene::{Given, Loads};

/// One point of the load history: the loads at the end of an increment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadPoint {
    /// Branch the increment belongs to, from 0.
    pub branch: usize,
    /// Whether it is the last increment of its branch.
    pub ends_branch: bool,
    /// Path time.
    pub t: f64,
    /// Part of the rest of the branch that the increment covers.
    pub part: f64,
    /// Loads at the end of the increment; NaN before the solution for loads that follow from it.
    pub loads: Loads,
}

impl LoadPoint {
    /// A part of the way to this point from where `loads` and `motions` stand; not the end of a
    /// branch.
    pub(crate) fn on_the_way(&self, loads: &Loads, motions: [f64; 6], part: f64) -> Self {
        let between = |a: f64, b: f64| a + part * (b - a);
        let forces = loads.forces();
        let (ends, given) = (self.loads.forces(), self.loads.given.motions());
        let reached = std::array::from_fn(|k| between(forces[k], ends[k]));
        let moved = std::array::from_fn(|k| given[k].map(|end| between(motions[k], end)));
        Self {
            ends_branch: false,
            loads: Loads {
                sigma_B: between(loads.sigma_B, self.loads.sigma_B),
                sigma_B1: between(loads.sigma_B1, self.loads.sigma_B1),
                rolled: between(loads.rolled, self.loads.rolled),
                ..Loads::default()
            }
            .with_forces(reached, Given::from_motions(moved)),
            ..*self
        }
    }

    /// The point with what is given in full: a load or a motion that was not given in the branch
    /// before goes straight from where it stands, `forces` and `motions`, to the `end` of the
    /// branch.
    pub(crate) fn resolved(&self, end: &Loads, forces: [f64; 6], motions: [f64; 6]) -> Self {
        let onward = |value: f64, now: f64, end: f64| {
            if value.is_nan() {
                now + self.part * (end - now)
            } else {
                value
            }
        };
        let (planned, given) = (self.loads.forces(), self.loads.given.motions());
        let (ends, given_ends) = (end.forces(), end.given.motions());
        let resolved = std::array::from_fn(|k| onward(planned[k], forces[k], ends[k]));
        let moved = std::array::from_fn(|k| {
            let end = given_ends[k].unwrap_or_default();
            given[k].map(|value| onward(value, motions[k], end))
        });
        Self {
            loads: self.loads.with_forces(resolved, Given::from_motions(moved)),
            ..*self
        }
    }
}

impl LoadPath {
    /// The loads at the end of every increment. What only the solution can say is NaN: the load of
    /// a motion that is given, and inside a branch whatever was not given in the branch before.
    pub fn points(&self) -> Vec<LoadPoint> {
        let mut points = Vec::with_capacity(self.increments());
        let (mut forces, mut motions, mut t0) = ([0.0; 6], [0.0; 6], 0.0);
        let mut from = Loads::default();
        for (branch, b) in self.branches.iter().enumerate() {
            let (to, given) = (b.to.forces(), b.to.given.motions());
            let mut before = 0.0;
            for i in 1..=b.count() {
                let last = i == b.count();
                let approach_given = b.to.given.delta_z.is_some();
                let (f, s) = b.spacing.covered(i, b.count(), approach_given);
                let between = |a: f64, c: f64| if last { c } else { a + f * (c - a) };
                let force =
                    |k: usize| given[k].map_or_else(|| between(forces[k], to[k]), |_| f64::NAN);
                let motion = |k: usize| given[k].map(|to| between(motions[k], to));
                points.push(LoadPoint {
                    branch,
                    ends_branch: last,
                    t: if last {
                        b.t_end
                    } else {
                        t0 + s * (b.t_end - t0)
                    },
                    part: if last {
                        1.0
                    } else {
                        (f - before) / (1.0 - before)
                    },
                    loads: Loads {
                        sigma_B: between(from.sigma_B, b.to.sigma_B),
                        sigma_B1: between(from.sigma_B1, b.to.sigma_B1),
                        rolled: between(from.rolled, b.to.rolled),
                        ..Loads::default()
                    }
                    .with_forces(
                        std::array::from_fn(force),
                        Given::from_motions(std::array::from_fn(motion)),
                    ),
                });
                before = f;
            }
            for k in 0..6 {
                (forces[k], motions[k]) = match given[k] {
                    None => (to[k], f64::NAN),
                    Some(motion) => (f64::NAN, motion),
                };
            }
            (t0, from) = (b.t_end, b.to);
        }
        points
    }
}
