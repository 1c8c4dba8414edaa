//! The load history: branches, each cut into increments.

use serde::{Deserialize, Serialize};

use crate::error::Error;

/// The forces that the contact transmits at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Loads {
    /// Normal force W \[N\], compression positive.
    pub W: f64,
    /// Tangential force along x on body 2 \[N\].
    pub T_x: f64,
    /// Tangential force along y on body 2 \[N\].
    pub T_y: f64,
}

/// How the increments of a branch are spaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// Equal increments of force (default).
    #[default]
    Uniform,
    /// Increments of equal contact radius for a paraboloid: the force grows with the cube of the
    /// count. The natural spacing of an indentation.
    EqualRadius,
}

/// One straight piece of the load history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Loads at the end of the branch.
    pub to: Loads,
    /// Number of increments, at least one.
    pub increments: usize,
    /// How they are spaced.
    pub spacing: Spacing,
    /// Path time at the end of the branch; only a label, the contact is quasi-static.
    pub t_end: f64,
}

/// Most increments of a path: the points alone take some 60 bytes each.
const MOST_INCREMENTS: usize = 100_000_000;

/// The load history, from the unloaded state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadPath {
    /// Branches in the order they are run through.
    pub branches: Vec<Branch>,
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
    /// Loads at the end of the increment.
    pub loads: Loads,
}

impl LoadPoint {
    /// Half of the way from the loads `from` to this point; not the end of a branch.
    pub(crate) fn middle(&self, from: &Loads) -> Self {
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        Self {
            ends_branch: false,
            loads: Loads {
                W: mean(from.W, self.loads.W),
                T_x: mean(from.T_x, self.loads.T_x),
                T_y: mean(from.T_y, self.loads.T_y),
            },
            ..*self
        }
    }
}

impl LoadPath {
    /// A path that starts from two bodies just touching.
    pub fn start() -> Self {
        Self::default()
    }

    fn last(&self) -> (Loads, f64) {
        self.branches
            .last()
            .map_or((Loads::default(), 0.0), |b| (b.to, b.t_end))
    }

    /// Goes to the normal force `W` \[N\], the tangential forces kept, in one unit of path time.
    #[must_use]
    pub fn normal(self, W: f64, increments: usize) -> Self {
        let (at, t) = self.last();
        self.branch(Branch {
            to: Loads { W, ..at },
            increments,
            spacing: Spacing::Uniform,
            t_end: t + 1.0,
        })
    }

    /// Visits the values `T_x` \[N\] in turn and shares `increments` out in proportion to the
    /// change of force; each branch takes path time in proportion to its increments, one unit in
    /// all for as many increments as the first branch of the path has.
    #[must_use]
    pub fn tangential(mut self, T_x: &[f64], increments: usize) -> Self {
        let (at, _) = self.last();
        let per_unit = self
            .branches
            .first()
            .map_or(increments, |b| b.increments)
            .max(1);
        let mut changes = Vec::with_capacity(T_x.len());
        let mut from = at.T_x;
        for &T in T_x {
            changes.push((T - from).abs());
            from = T;
        }
        let total: f64 = changes.iter().sum();
        let (mut passed, mut taken) = (0.0, 0);
        for (&T, change) in T_x.iter().zip(&changes) {
            passed += change;
            let share = if total > 0.0 { passed / total } else { 1.0 };
            let upto = (increments as f64 * share).round() as usize;
            let n = upto.saturating_sub(taken).max(1);
            taken += n;
            let (at, t) = self.last();
            self.branches.push(Branch {
                to: Loads { T_x: T, ..at },
                increments: n,
                spacing: Spacing::Uniform,
                t_end: t + n as f64 / per_unit as f64,
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

    /// Number of increments of the whole path.
    pub fn increments(&self) -> usize {
        self.branches.iter().map(|b| b.increments).sum()
    }

    /// The largest normal force of the path \[N\].
    pub fn W_max(&self) -> f64 {
        self.branches.iter().fold(0.0, |m, b| m.max(b.to.W))
    }

    /// The loads at the end of every increment.
    pub fn points(&self) -> Vec<LoadPoint> {
        let mut points = Vec::with_capacity(self.increments());
        let (mut from, mut t0) = (Loads::default(), 0.0);
        for (branch, b) in self.branches.iter().enumerate() {
            for i in 1..=b.increments {
                let s = i as f64 / b.increments as f64;
                let f = match b.spacing {
                    Spacing::Uniform => s,
                    Spacing::EqualRadius => s.powi(3),
                };
                let between = |a: f64, c: f64| {
                    if i == b.increments {
                        c
                    } else {
                        a + f * (c - a)
                    }
                };
                points.push(LoadPoint {
                    branch,
                    ends_branch: i == b.increments,
                    t: if i == b.increments {
                        b.t_end
                    } else {
                        t0 + s * (b.t_end - t0)
                    },
                    loads: Loads {
                        W: between(from.W, b.to.W),
                        T_x: between(from.T_x, b.to.T_x),
                        T_y: between(from.T_y, b.to.T_y),
                    },
                });
            }
            (from, t0) = (b.to, b.t_end);
        }
        points
    }

    pub(crate) fn check(&self, mu: f64) -> Result<(), Error> {
        if self.branches.is_empty() {
            return Err(Error::invalid("path", "empty", "at least one branch"));
        }
        let total = self.branches.iter().map(|b| b.increments);
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
            if !(b.t_end > t && b.t_end.is_finite()) {
                return Err(Error::invalid(
                    key("t"),
                    b.t_end,
                    format!("a time after {t}, the end of the branch before"),
                ));
            }
            t = b.t_end;
            if b.increments == 0 {
                return Err(Error::invalid(
                    key("increments"),
                    0,
                    "at least one increment",
                ));
            }
            if !(b.to.W >= 0.0 && b.to.W.is_finite()) {
                return Err(Error::invalid(
                    key("W"),
                    b.to.W,
                    "a finite compressive force >= 0 in N",
                ));
            }
            for (name, T) in [("T_x", b.to.T_x), ("T_y", b.to.T_y)] {
                if !T.is_finite() {
                    return Err(Error::invalid(key(name), T, "a finite force in N"));
                }
            }
            let T = b.to.T_x.hypot(b.to.T_y);
            let limit = mu * b.to.W;
            if T > limit * (1.0 + 1e-12) {
                return Err(Error::invalid(
                    key(if b.to.T_x.abs() >= b.to.T_y.abs() {
                        "T_x"
                    } else {
                        "T_y"
                    }),
                    T,
                    format!("|T| <= mu W = {limit} N, the largest force that friction can carry"),
                ));
            }
        }
        Ok(())
    }
}
