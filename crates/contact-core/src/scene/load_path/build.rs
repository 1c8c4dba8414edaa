//! Load paths built branch by branch.

use std::f64::consts::TAU;

use super::{Branch, LoadPath};
use crate::scene::{Loads, Prescribed, RigidMotion};

/// Branches for a full turn around an ellipse whose increments are not yet chosen: the middle of a
/// chord lies inside the ellipse by less than 0.13 % of its radius.
pub(super) const CHORDS: usize = 64;

impl LoadPath {
    /// A path that starts from two bodies just touching.
    pub fn start() -> Self {
        Self::default()
    }

    /// Loads and path time at the end of the path so far.
    pub fn end_point(&self) -> (Loads, f64) {
        self.branches
            .last()
            .map_or((Loads::default(), 0.0), |b| (b.to, b.t_end))
    }

    /// Appends a branch.
    #[must_use]
    pub fn push_branch(mut self, branch: Branch) -> Self {
        self.branches.push(branch);
        self
    }

    /// Goes to the loads and motions that `change` sets, starting from the present ones, in one unit of path
    /// time.
    #[must_use]
    pub fn change_to(
        self,
        change: impl FnOnce(&mut Loads),
        increments: impl Into<Option<usize>>,
    ) -> Self {
        let (mut to, t) = self.end_point();
        change(&mut to);
        self.push_branch(Branch::new(to, increments, t + 1.0))
    }

    /// Goes to the normal force `W` \[N\], the tangential forces unchanged, in one unit of path
    /// time.
    #[must_use]
    pub fn normal(self, W: f64, increments: impl Into<Option<usize>>) -> Self {
        let press = |to: &mut Loads| to.prescribe(RigidMotion::DeltaZ, Prescribed::Load(W));
        self.change_to(press, increments)
    }

    /// Visits the values `T_x` \[N\] in turn and shares `increments` out in proportion to the
    /// change of force; each branch takes path time in proportion to its increments, one unit in
    /// all for as many increments as the first branch of the path has.
    #[must_use]
    pub fn tangential(self, T_x: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.append_loads(RigidMotion::DeltaX, T_x, increments.into())
    }

    /// Visits the torsional moments `M_z` \[N m\] in turn, as [`Self::tangential`] does the forces.
    #[must_use]
    pub fn torsion(self, M_z: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.append_loads(RigidMotion::PhiZ, M_z, increments.into())
    }

    /// Presses with the normal forces `W` \[N\] in turn, as [`Self::tangential`] visits its values:
    /// radial fretting, mode II.
    #[must_use]
    pub fn radial(self, W: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.append_loads(RigidMotion::DeltaZ, W, increments.into())
    }

    /// Visits the values of a motion in turn; `prescribed` makes them loads or motions, as
    /// [`Self::tangential`] visits forces. A motion that was free counts from 0.
    #[must_use]
    pub fn visit_values(
        self,
        motion: RigidMotion,
        prescribed: fn(f64) -> Prescribed,
        values: &[f64],
        increments: impl Into<Option<usize>>,
    ) -> Self {
        self.append_prescribed(motion, prescribed, values, increments.into())
    }

    /// Holds the loads for some increments, one unit of path time, while the history of friction
    /// goes on.
    #[must_use]
    pub fn hold(self, increments: usize) -> Self {
        self.change_to(|_| (), increments)
    }

    /// Returns the values of `n` cycles of an amplitude: to it, then `n` times to its opposite and back.
    pub fn cycle(amplitude: f64, n: usize) -> Vec<f64> {
        let cycles = std::iter::repeat_n([-amplitude, amplitude], n);
        std::iter::once(amplitude).chain(cycles.flatten()).collect()
    }

    /// Turns the tangential force around an ellipse of the semi-axes `T_x`, `T_y` \[N\] about its
    /// present value, from (T_x, 0) on towards (0, T_y), `turns` times. It reaches the ellipse in
    /// `increments` and takes as many for a turn, one branch each, since the direction of the path
    /// changes at each. Where the increments are not yet chosen a turn has 64 branches.
    #[must_use]
    pub fn ellipse(
        mut self,
        (T_x, T_y): (f64, f64),
        turns: usize,
        increments: impl Into<Option<usize>>,
    ) -> Self {
        let increments = increments.into();
        let (middle, t0) = self.end_point();
        let point_at = |part: f64| {
            let mut to = middle;
            // The sine of half a turn is 1e-16 in floating point, and no force.
            let exact = |x: f64| if x.abs() < f64::EPSILON { 0.0 } else { x };
            let (sin, cos) = (TAU * part.fract()).sin_cos();
            let (x, y) = (T_x * exact(cos), T_y * exact(sin));
            to.prescribe(RigidMotion::DeltaX, Prescribed::Load(middle.T_x + x));
            to.prescribe(RigidMotion::DeltaY, Prescribed::Load(middle.T_y + y));
            to
        };
        self.branches
            .push(Branch::new(point_at(0.0), increments, t0 + 1.0));
        let chords = increments.unwrap_or(CHORDS);
        for i in 1..=turns * chords {
            let part = i as f64 / chords as f64;
            let t = t0 + 1.0 + part;
            let chord_increments = increments.map(|_| 1);
            self.branches
                .push(Branch::new(point_at(part), chord_increments, t));
        }
        self
    }

    /// Appends a branch to each of the `values` of the load of a motion. `increments` are shared out in
    /// proportion to the change of the load.
    fn append_loads(self, motion: RigidMotion, values: &[f64], increments: Option<usize>) -> Self {
        self.append_prescribed(motion, Prescribed::Load, values, increments)
    }

    /// Appends a branch to each of the `values`, which `prescribed` makes loads or motions of `motion`.
    /// `increments` are shared out in proportion to the change.
    fn append_prescribed(
        mut self,
        motion: RigidMotion,
        prescribed: fn(f64) -> Prescribed,
        values: &[f64],
        increments: Option<usize>,
    ) -> Self {
        let per_unit = self
            .branches
            .first()
            .and_then(|b| b.increments)
            .or(increments)
            .unwrap_or(1)
            .max(1);
        let mut changes = Vec::with_capacity(values.len());
        let start = self.end_point().0.prescribed(motion);
        let same_kind = start.is_motion() == prescribed(0.0).is_motion();
        let mut value_before = if same_kind { start.value() } else { 0.0 };
        for &value in values {
            changes.push((value - value_before).abs());
            value_before = value;
        }
        let total: f64 = changes.iter().sum();
        let (mut changed, mut used) = (0.0, 0);
        for (&value, change) in values.iter().zip(&changes) {
            changed += change;
            let share = if total > 0.0 { changed / total } else { 1.0 };
            let n = increments.map(|increments| {
                let up_to_here = (increments as f64 * share).round() as usize;
                let n = up_to_here.saturating_sub(used).max(1);
                used += n;
                n
            });
            let (mut to, t) = self.end_point();
            to.prescribe(motion, prescribed(value));
            let t_end = t + n.map_or(1.0, |n| n as f64 / per_unit as f64);
            self.branches.push(Branch::new(to, n, t_end));
        }
        self
    }
}
