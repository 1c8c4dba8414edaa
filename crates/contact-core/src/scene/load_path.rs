//! The load history: branches, each cut into increments.

use serde::{Deserialize, Serialize};

use super::{Friction, Given, Grid, LOADS, Loads, MOTIONS};
use crate::error::Error;

/// How the increments of a branch are spaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// Equal increments of force (default).
    #[default]
    Uniform,
    /// Increments of equal contact radius for a paraboloid: the force grows with the cube of the
    /// count, an approach that is given with the square. The natural spacing of an indentation.
    EqualRadius,
}

impl Spacing {
    /// Part of the branch covered after the part `s` of its increments.
    fn covered(self, s: f64, approach_given: bool) -> f64 {
        match (self, approach_given) {
            (Self::Uniform, _) => s,
            (Self::EqualRadius, false) => s.powi(3),
            (Self::EqualRadius, true) => s.powi(2),
        }
    }
}

/// One straight piece of the load history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Loads at the end of the branch.
    pub to: Loads,
    /// Number of increments, at least one; `None`: as many as the error of the path asks for,
    /// [`choose_increments`](crate::march::choose_increments).
    pub increments: Option<usize>,
    /// How they are spaced.
    pub spacing: Spacing,
    /// Path time at the end of the branch; only a label, the contact is quasi-static.
    pub t_end: f64,
    /// What the increments so far leave of the error of the shear at the end of the branch, estimated:
    /// over the largest shear of the path (L2). `None` where it was not asked for.
    pub path_error: Option<f64>,
}

impl Branch {
    /// Increments, one where the number is yet to be chosen.
    pub(crate) fn count(&self) -> usize {
        self.increments.unwrap_or(1)
    }
}

/// Most increments of a path: the points alone take some 60 bytes each.
const MOST_INCREMENTS: usize = 100_000_000;

/// The load history, from the unloaded state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadPath {
    /// Branches in the order they are run through.
    pub branches: Vec<Branch>,
    /// Stiffness along x of a rig, a spring in series with the contact through which the shift delta_x is
    /// given or read \[N/m\]; `None`: the bodies themselves are moved. With the spring's end at u the
    /// contact's own shift is u - T_x/K.
    pub rig_stiffness: Option<f64>,
}

/// One point of the load history: the loads at the end of an increment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadPoint {
    /// Branch the increment belongs to, from 0.
    pub branch: usize,
    /// Whether it is the last increment of its branch.
    pub ends_branch: bool,
    /// Path time.
    pub t: f64,
    /// Part of what is left of the branch that the increment covers.
    pub part: f64,
    /// Loads at the end of the increment; before the solution, NaN stands for what it has to say.
    pub loads: Loads,
}

impl LoadPoint {
    /// Half of the way to this point from where `loads` and `motions` stand; not the end of a
    /// branch.
    pub(crate) fn middle(&self, loads: &Loads, motions: [f64; 6]) -> Self {
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let forces = loads.forces();
        let (ends, given) = (self.loads.forces(), self.loads.given.motions());
        let halfway = std::array::from_fn(|k| mean(forces[k], ends[k]));
        let moved = std::array::from_fn(|k| given[k].map(|end| mean(motions[k], end)));
        Self {
            ends_branch: false,
            loads: Loads {
                sigma_B: mean(loads.sigma_B, self.loads.sigma_B),
                sigma_B1: mean(loads.sigma_B1, self.loads.sigma_B1),
                rolled: mean(loads.rolled, self.loads.rolled),
                ..Loads::default()
            }
            .with_forces(halfway, Given::from_motions(moved)),
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
    /// A path that starts from two bodies just touching.
    pub fn start() -> Self {
        Self::default()
    }

    pub(super) fn last(&self) -> (Loads, f64) {
        self.branches
            .last()
            .map_or((Loads::default(), 0.0), |b| (b.to, b.t_end))
    }

    /// Goes to the normal force `W` \[N\], the tangential forces kept, in one unit of path time.
    #[must_use]
    pub fn normal(self, W: f64, increments: impl Into<Option<usize>>) -> Self {
        let (at, t) = self.last();
        self.branch(Branch {
            to: Loads {
                W,
                given: Given {
                    delta_z: None,
                    ..at.given
                },
                ..at
            },
            increments: increments.into(),
            spacing: Spacing::Uniform,
            t_end: t + 1.0,
            path_error: None,
        })
    }

    /// Visits the values `T_x` \[N\] in turn and shares `increments` out in proportion to the
    /// change of force; each branch takes path time in proportion to its increments, one unit in
    /// all for as many increments as the first branch of the path has.
    #[must_use]
    pub fn tangential(self, T_x: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.visit(
            T_x,
            increments.into(),
            |at| at.T_x,
            |at, T_x| {
                at.given.delta_x = None;
                at.T_x = T_x;
            },
        )
    }

    /// Visits the torsional moments `M_z` \[N m\] in turn, as [`Self::tangential`] does the forces.
    #[must_use]
    pub fn torsion(self, M_z: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.visit(
            M_z,
            increments.into(),
            |at| at.M_z,
            |at, M_z| {
                at.given.phi_z = None;
                at.M_z = M_z;
            },
        )
    }

    /// Goes to the loads and motions that `change` makes of the present ones, in one unit of path
    /// time.
    #[must_use]
    pub fn to(self, change: impl FnOnce(&mut Loads), increments: impl Into<Option<usize>>) -> Self {
        let (mut to, t) = self.last();
        change(&mut to);
        self.branch(Branch {
            to,
            increments: increments.into(),
            spacing: Spacing::Uniform,
            t_end: t + 1.0,
            path_error: None,
        })
    }

    /// Visits values in turn, the increments in proportion to the change.
    pub(super) fn visit(
        mut self,
        values: &[f64],
        increments: Option<usize>,
        get: impl Fn(&Loads) -> f64,
        set: impl Fn(&mut Loads, f64),
    ) -> Self {
        let per_unit = self
            .branches
            .first()
            .and_then(|b| b.increments)
            .or(increments)
            .unwrap_or(1)
            .max(1);
        let mut changes = Vec::with_capacity(values.len());
        let mut from = get(&self.last().0);
        for &value in values {
            changes.push((value - from).abs());
            from = value;
        }
        let total: f64 = changes.iter().sum();
        let (mut passed, mut taken) = (0.0, 0);
        for (&value, change) in values.iter().zip(&changes) {
            passed += change;
            let share = if total > 0.0 { passed / total } else { 1.0 };
            let n = increments.map(|increments| {
                let upto = (increments as f64 * share).round() as usize;
                let n = upto.saturating_sub(taken).max(1);
                taken += n;
                n
            });
            let (mut to, t) = self.last();
            set(&mut to, value);
            self.branches.push(Branch {
                to,
                increments: n,
                spacing: Spacing::Uniform,
                t_end: t + n.map_or(1.0, |n| n as f64 / per_unit as f64),
                path_error: None,
            });
        }
        self
    }

    /// Appends a branch.
    #[must_use]
    pub fn branch(mut self, branch: Branch) -> Self {
        self.branches.push(branch);
        self
    }

    /// Number of increments of the whole path; a branch whose number is yet to be chosen counts as one.
    pub fn increments(&self) -> usize {
        self.branches.iter().map(Branch::count).sum()
    }

    /// Whether nothing but normal forces and tilting moments, or their motions, act.
    pub(crate) fn only_presses(&self) -> bool {
        self.branches.iter().all(|Branch { to, .. }| {
            let shears = to.forces()[3..].iter().any(|f| *f != 0.0);
            let moves = to.given.motions()[3..].iter().flatten().any(|m| *m != 0.0);
            let strains = [to.sigma_B, to.sigma_B1, to.rolled]
                .iter()
                .any(|s| *s != 0.0);
            !(shears || moves || strains)
        })
    }

    /// Whether the increments of a branch are yet to be chosen.
    pub fn is_open(&self) -> bool {
        self.branches.iter().any(|b| b.increments.is_none())
    }

    /// The largest normal force that the path gives \[N\].
    pub fn W_max(&self) -> f64 {
        let given = self
            .branches
            .iter()
            .filter(|b| b.to.given.delta_z.is_none());
        given.fold(0.0, |m, b| m.max(b.to.W))
    }

    /// The largest approach that the path gives \[m\].
    pub fn delta_z_max(&self) -> f64 {
        let given = self.branches.iter().filter_map(|b| b.to.given.delta_z);
        given.fold(0.0, f64::max)
    }

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
                let s = i as f64 / b.count() as f64;
                let f = b.spacing.covered(s, b.to.given.delta_z.is_some());
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

    pub(crate) fn check(&self, friction: &Friction) -> Result<(), Error> {
        if self.branches.is_empty() {
            return Err(Error::invalid("path", "empty", "at least one branch"));
        }
        if let Some(K) = self.rig_stiffness.filter(|K| !(*K > 0.0 && K.is_finite())) {
            return Err(Error::invalid(
                "path.rig_stiffness",
                K,
                "a positive stiffness in N/m",
            ));
        }
        let total = self.branches.iter().map(Branch::count);
        if total.fold(0, usize::saturating_add) > MOST_INCREMENTS {
            return Err(Error::invalid(
                "path",
                "of more increments",
                format!("at most {MOST_INCREMENTS} increments in all"),
            ));
        }
        let mut t = 0.0;
        for (i, b) in self.branches.iter().enumerate() {
            let key = |name: &str| format!("path[{i}].{name}");
            for (name, value) in [
                ("sigma_B", b.to.sigma_B),
                ("sigma_B1", b.to.sigma_B1),
                ("rolled", b.to.rolled),
            ] {
                if !value.is_finite() {
                    return Err(Error::invalid(key(name), value, "a finite number"));
                }
            }
            if !(b.t_end > t && b.t_end.is_finite()) {
                return Err(Error::invalid(
                    key("t"),
                    b.t_end,
                    format!("a time after {t}, the end of the branch before"),
                ));
            }
            t = b.t_end;
            if b.increments == Some(0) {
                return Err(Error::invalid(
                    key("increments"),
                    0,
                    "at least one increment",
                ));
            }
            b.to.check(&key, friction)?;
        }
        Ok(())
    }

    /// Fails if the grid cannot follow: the contact rolls whole cells in an increment, along x and so
    /// about y, and a strip neither twists nor tilts about its length.
    pub(crate) fn check_on(&self, grid: &Grid) -> Result<(), Error> {
        let mut rolled = 0.0;
        for (i, b) in self.branches.iter().enumerate() {
            let key = |name: &str| format!("path[{i}].{name}");
            let given = b.to.given.motions();
            let held = |k: usize| given[k].is_some_and(|motion| motion == 0.0);
            let cells = (b.to.rolled - rolled) / grid.dx / b.count() as f64;
            if (cells - cells.round()).abs() > 1e-6 * cells.abs().max(1.0) {
                return Err(Error::invalid(
                    key("rolled"),
                    b.to.rolled,
                    format!(
                        "whole cells of {} m per increment further than before",
                        grid.dx
                    ),
                ));
            }
            let rolls = cells.round() != 0.0;
            for k in [1, 2, 5] {
                let allowed = match k {
                    2 if rolls => {
                        "left out while the contact rolls, which is a turn about y itself"
                    }
                    1 | 5 if grid.plane_strain => {
                        "left out in plane strain: nothing turns about x or z"
                    }
                    _ => continue,
                };
                if !held(k) {
                    let value = given[k].unwrap_or(b.to.forces()[k]);
                    let name = given[k].map_or(LOADS[k], |_| MOTIONS[k]);
                    return Err(Error::invalid(key(name), value, allowed));
                }
            }
            if rolls && b.increments.is_none() {
                return Err(Error::invalid(
                    key("increments"),
                    "auto",
                    "a number where the contact rolls: whole cells in each",
                ));
            }
            rolled = b.to.rolled;
        }
        Ok(())
    }
}
