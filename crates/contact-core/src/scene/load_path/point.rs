//! The loads at the end of each increment of a load path.

use serde::{Deserialize, Serialize};

use super::LoadPath;
use crate::scene::{Loads, PrescribedMotions};

/// One point of the load history: the loads at the end of an increment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadPoint {
    /// Branch of the increment, from 0.
    pub branch: usize,
    /// Whether it is the last increment of its branch.
    pub ends_branch: bool,
    /// Path time.
    pub t: f64,
    /// Fraction of the remaining branch that the increment covers.
    pub part: f64,
    /// Loads at the end of the increment; NaN before the solution for loads that follow from it.
    pub loads: Loads,
}

impl LoadPoint {
    /// Interpolates from `loads` and `motions` towards this point; the result is not the end of a
    /// branch.
    pub(crate) fn interpolate_to(&self, loads: &Loads, motions: [f64; 6], fraction: f64) -> Self {
        let interpolate = |a: f64, b: f64| a + fraction * (b - a);
        let forces = loads.forces();
        let (ends, given) = (self.loads.forces(), self.loads.given.motions());
        let forces_between = std::array::from_fn(|k| interpolate(forces[k], ends[k]));
        let motions_between =
            std::array::from_fn(|k| given[k].map(|end| interpolate(motions[k], end)));
        Self {
            ends_branch: false,
            loads: Loads {
                sigma_B: interpolate(loads.sigma_B, self.loads.sigma_B),
                sigma_B1: interpolate(loads.sigma_B1, self.loads.sigma_B1),
                rolled: interpolate(loads.rolled, self.loads.rolled),
                ..Loads::default()
            }
            .with_forces(
                forces_between,
                PrescribedMotions::from_motions(motions_between),
            ),
            ..*self
        }
    }

    /// Resolves loads or motions that are NaN since they were not prescribed in the branch before: they go
    /// straight from their present values, `forces` and `motions`, to the `end` of the
    /// branch.
    pub(crate) fn resolved(&self, end: &Loads, forces: [f64; 6], motions: [f64; 6]) -> Self {
        let fill_in = |value: f64, now: f64, end: f64| {
            if value.is_nan() {
                now + self.part * (end - now)
            } else {
                value
            }
        };
        let (planned, given) = (self.loads.forces(), self.loads.given.motions());
        let (ends, given_ends) = (end.forces(), end.given.motions());
        let resolved_forces = std::array::from_fn(|k| fill_in(planned[k], forces[k], ends[k]));
        let resolved_motions = std::array::from_fn(|k| {
            let end = given_ends[k].unwrap_or_default();
            given[k].map(|value| fill_in(value, motions[k], end))
        });
        Self {
            loads: self.loads.with_forces(
                resolved_forces,
                PrescribedMotions::from_motions(resolved_motions),
            ),
            ..*self
        }
    }
}

impl LoadPath {
    /// Returns the loads at the end of every increment. NaN stands for numbers that only the solution
    /// gives: the load of a prescribed motion, and inside a branch a quantity that the branch before did not prescribe.
    pub fn points(&self) -> Vec<LoadPoint> {
        let mut points = Vec::with_capacity(self.increments());
        let (mut forces, mut motions, mut t0) = ([0.0; 6], [0.0; 6], 0.0);
        let mut start = Loads::default();
        for (branch, b) in self.branches.iter().enumerate() {
            let (to, given) = (b.to.forces(), b.to.given.motions());
            let mut f_before = 0.0;
            for i in 1..=b.count() {
                let is_last = i == b.count();
                let approach_given = b.to.given.delta_z.is_some();
                let (f, s) = b.spacing.covered_fraction(i, b.count(), approach_given);
                let interpolate = |a: f64, c: f64| if is_last { c } else { a + f * (c - a) };
                let force =
                    |k: usize| given[k].map_or_else(|| interpolate(forces[k], to[k]), |_| f64::NAN);
                let motion = |k: usize| given[k].map(|to| interpolate(motions[k], to));
                points.push(LoadPoint {
                    branch,
                    ends_branch: is_last,
                    t: if is_last {
                        b.t_end
                    } else {
                        t0 + s * (b.t_end - t0)
                    },
                    part: if is_last {
                        1.0
                    } else {
                        (f - f_before) / (1.0 - f_before)
                    },
                    loads: Loads {
                        sigma_B: interpolate(start.sigma_B, b.to.sigma_B),
                        sigma_B1: interpolate(start.sigma_B1, b.to.sigma_B1),
                        rolled: interpolate(start.rolled, b.to.rolled),
                        ..Loads::default()
                    }
                    .with_forces(
                        std::array::from_fn(force),
                        PrescribedMotions::from_motions(std::array::from_fn(motion)),
                    ),
                });
                f_before = f;
            }
            for k in 0..6 {
                (forces[k], motions[k]) = match given[k] {
                    None => (to[k], f64::NAN),
                    Some(motion) => (f64::NAN, motion),
                };
            }
            (t0, start) = (b.t_end, b.to);
        }
        points
    }
}
