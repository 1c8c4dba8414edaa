//! The load history: branches, each cut into increments.

use serde::{Deserialize, Serialize};

use super::Friction;
use crate::error::Error;

/// The loads that the contact transmits at one moment, on body 2, and the rigid motions that are
/// given instead of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Loads {
    /// Normal force W \[N\], compression positive.
    pub W: f64,
    /// Tangential force along x on body 2 \[N\].
    pub T_x: f64,
    /// Tangential force along y on body 2 \[N\].
    pub T_y: f64,
    /// Tilting moment about x, the sum of y p dA \[N m\].
    pub M_x: f64,
    /// Tilting moment about y, the sum of -x p dA \[N m\].
    pub M_y: f64,
    /// Torsional moment about z, the sum of (x q_y - y q_x) dA \[N m\].
    pub M_z: f64,
    /// Motions that are given. The load that goes with each is what the solution says; in a path
    /// its value has no meaning.
    pub given: Given,
}

/// Rigid motions of body 1 against body 2 that are given; `None` where the load is. Without a word
/// the forces are given and the bodies do not rotate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Given {
    /// Approach \[m\], instead of W.
    pub delta_z: Option<f64>,
    /// Shift along x \[m\], instead of T_x.
    pub delta_x: Option<f64>,
    /// Shift along y \[m\], instead of T_y.
    pub delta_y: Option<f64>,
    /// Tilt about x \[rad\], instead of M_x (default 0).
    pub phi_x: Option<f64>,
    /// Tilt about y \[rad\], instead of M_y (default 0).
    pub phi_y: Option<f64>,
    /// Rotation about z \[rad\], instead of M_z (default 0).
    pub phi_z: Option<f64>,
}

impl Default for Given {
    fn default() -> Self {
        Self {
            delta_z: None,
            delta_x: None,
            delta_y: None,
            phi_x: Some(0.0),
            phi_y: Some(0.0),
            phi_z: Some(0.0),
        }
    }
}

/// Names of the loads and of the motions that they drive, in the order of [`Loads::forces`].
pub const LOADS: [&str; 6] = ["W", "M_x", "M_y", "T_x", "T_y", "M_z"];
/// Names of the rigid motions, in the order of [`LOADS`].
pub const MOTIONS: [&str; 6] = ["delta_z", "phi_x", "phi_y", "delta_x", "delta_y", "phi_z"];

impl Loads {
    /// The six loads: W, M_x, M_y across the contact plane, T_x, T_y, M_z in it.
    pub fn forces(&self) -> [f64; 6] {
        [self.W, self.M_x, self.M_y, self.T_x, self.T_y, self.M_z]
    }

    /// The loads of [`Self::forces`] with the motions given.
    pub fn from_forces(forces: [f64; 6], given: Given) -> Self {
        let [W, M_x, M_y, T_x, T_y, M_z] = forces;
        Self {
            W,
            T_x,
            T_y,
            M_x,
            M_y,
            M_z,
            given,
        }
    }
}

impl Given {
    /// The six motions in the order of [`MOTIONS`].
    pub fn motions(&self) -> [Option<f64>; 6] {
        [
            self.delta_z,
            self.phi_x,
            self.phi_y,
            self.delta_x,
            self.delta_y,
            self.phi_z,
        ]
    }

    /// The motions of [`Self::motions`].
    pub fn from_motions(motions: [Option<f64>; 6]) -> Self {
        let [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z] = motions;
        Self {
            delta_z,
            delta_x,
            delta_y,
            phi_x,
            phi_y,
            phi_z,
        }
    }
}

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
    /// Part of what is left of the branch that the increment covers.
    pub part: f64,
    /// Loads at the end of the increment; before the solution, NaN stands for what it has to say.
    pub loads: Loads,
}

impl LoadPoint {
    /// Half of the way to this point from where `forces` and `motions` stand; not the end of a
    /// branch.
    pub(crate) fn middle(&self, forces: [f64; 6], motions: [f64; 6]) -> Self {
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let (ends, given) = (self.loads.forces(), self.loads.given.motions());
        let halfway = std::array::from_fn(|k| mean(forces[k], ends[k]));
        let moved = std::array::from_fn(|k| given[k].map(|end| mean(motions[k], end)));
        Self {
            ends_branch: false,
            loads: Loads::from_forces(halfway, Given::from_motions(moved)),
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
            loads: Loads::from_forces(resolved, Given::from_motions(moved)),
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
            to: Loads {
                W,
                given: Given {
                    delta_z: None,
                    ..at.given
                },
                ..at
            },
            increments,
            spacing: Spacing::Uniform,
            t_end: t + 1.0,
        })
    }

    /// Visits the values `T_x` \[N\] in turn and shares `increments` out in proportion to the
    /// change of force; each branch takes path time in proportion to its increments, one unit in
    /// all for as many increments as the first branch of the path has.
    #[must_use]
    pub fn tangential(self, T_x: &[f64], increments: usize) -> Self {
        self.visit(
            T_x,
            increments,
            |at| at.T_x,
            |at, T_x| {
                at.given.delta_x = None;
                at.T_x = T_x;
            },
        )
    }

    /// Visits the torsional moments `M_z` \[N m\] in turn, as [`Self::tangential`] does the forces.
    #[must_use]
    pub fn torsion(self, M_z: &[f64], increments: usize) -> Self {
        self.visit(
            M_z,
            increments,
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
    pub fn to(self, change: impl FnOnce(&mut Loads), increments: usize) -> Self {
        let (mut to, t) = self.last();
        change(&mut to);
        self.branch(Branch {
            to,
            increments,
            spacing: Spacing::Uniform,
            t_end: t + 1.0,
        })
    }

    /// Visits values in turn, the increments in proportion to the change.
    fn visit(
        mut self,
        values: &[f64],
        increments: usize,
        get: impl Fn(&Loads) -> f64,
        set: impl Fn(&mut Loads, f64),
    ) -> Self {
        let per_unit = self
            .branches
            .first()
            .map_or(increments, |b| b.increments)
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
            let upto = (increments as f64 * share).round() as usize;
            let n = upto.saturating_sub(taken).max(1);
            taken += n;
            let (mut to, t) = self.last();
            set(&mut to, value);
            self.branches.push(Branch {
                to,
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
        for (branch, b) in self.branches.iter().enumerate() {
            let (to, given) = (b.to.forces(), b.to.given.motions());
            let mut before = 0.0;
            for i in 1..=b.increments {
                let last = i == b.increments;
                let s = i as f64 / b.increments as f64;
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
                    loads: Loads::from_forces(
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
            t0 = b.t_end;
        }
        points
    }

    pub(crate) fn check(&self, friction: &Friction) -> Result<(), Error> {
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
            b.to.check(&key, friction)?;
        }
        Ok(())
    }
}

impl Loads {
    fn check(&self, key: &dyn Fn(&str) -> String, friction: &Friction) -> Result<(), Error> {
        let (forces, given) = (self.forces(), self.given.motions());
        for k in 0..6 {
            match given[k] {
                Some(motion) if !motion.is_finite() => {
                    let unit = if MOTIONS[k].starts_with("phi") {
                        "rotation in rad"
                    } else {
                        "shift in m"
                    };
                    return Err(Error::invalid(
                        key(MOTIONS[k]),
                        motion,
                        format!("a finite {unit}"),
                    ));
                }
                None if !forces[k].is_finite() => {
                    let unit = if LOADS[k].starts_with('M') {
                        "moment in N m"
                    } else {
                        "force in N"
                    };
                    return Err(Error::invalid(
                        key(LOADS[k]),
                        forces[k],
                        format!("a finite {unit}"),
                    ));
                }
                _ => {}
            }
        }
        if given[0].is_some() {
            return Ok(());
        }
        if self.W < 0.0 {
            return Err(Error::invalid(
                key("W"),
                self.W,
                "a finite compressive force >= 0 in N",
            ));
        }
        for k in 1..6 {
            if self.W == 0.0 && given[k].is_none() && forces[k] != 0.0 {
                return Err(Error::invalid(
                    key(LOADS[k]),
                    forces[k],
                    "0 where W = 0: the bodies part",
                ));
            }
        }
        let part = |k: usize| if given[k].is_none() { forces[k] } else { 0.0 };
        let (T_x, T_y) = (part(3), part(4));
        let Some(limit) = friction.limit(self.W) else {
            return Ok(());
        };
        let T = T_x.hypot(T_y);
        if T > limit * (1.0 + 1e-12) {
            return Err(Error::invalid(
                key(if T_x.abs() >= T_y.abs() { "T_x" } else { "T_y" }),
                T,
                format!("|T| <= mu W = {limit} N, the largest force that friction can carry"),
            ));
        }
        Ok(())
    }
}
