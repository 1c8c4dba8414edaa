//! Load paths built branch by branch.

use std::f64::consts::TAU;

use super::{Branch, LoadPath};
use crate::scene::{Loads, Prescribed, RigidMotion};

/// Branches of the turn of an ellipse whose increments are yet to be chosen: the middle of a chord
/// lies within the ellipse by less than 0.13 % of its radius.
pub(super) const CHORDS: usize = 64;

impl LoadPath {
    /// A path that starts from two bodies just touching.
    pub fn start() -> Self {
        Self::default()
    }

    /// Loads and path time at the end of the path so far.
    pub fn last(&self) -> (Loads, f64) {
        self.branches
            .last()
            .map_or((Loads::default(), 0.0), |b| (b.to, b.t_end))
    }

    /// Appends a branch.
    #[must_use]
    pub fn branch(mut self, branch: Branch) -> Self {
        self.branches.push(branch);
        self
    }

    /// Goes to the loads and motions that `change` makes of the present ones, in one unit of path
    /// time.
    #[must_use]
    pub fn to(self, change: impl FnOnce(&mut Loads), increments: impl Into<Option<usize>>) -> Self {
        let (mut to, t) = self.last();
        change(&mut to);
        self.branch(Branch::new(to, increments, t + 1.0))
    }

    /// Goes to the normal force `W` \[N\], the tangential forces unchanged, in one unit of path
    /// time.
    #[must_use]
    pub fn normal(self, W: f64, increments: impl Into<Option<usize>>) -> Self {
        let press = |to: &mut Loads| to.prescribe(RigidMotion::DeltaZ, Prescribed::Load(W));
        self.to(press, increments)
    }

    /// Visits the values `T_x` \[N\] in turn and shares `increments` out in proportion to the
    /// change of force; each branch takes path time in proportion to its increments, one unit in
    /// all for as many increments as the first branch of the path has.
    #[must_use]
    pub fn tangential(self, T_x: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.visit(RigidMotion::DeltaX, T_x, increments.into())
    }

    /// Visits the torsional moments `M_z` \[N m\] in turn, as [`Self::tangential`] does the forces.
    #[must_use]
    pub fn torsion(self, M_z: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.visit(RigidMotion::PhiZ, M_z, increments.into())
    }

    /// Presses with the normal forces `W` \[N\] in turn, as [`Self::tangential`] visits its values:
    /// radial fretting, mode II.
    #[must_use]
    pub fn radial(self, W: &[f64], increments: impl Into<Option<usize>>) -> Self {
        self.visit(RigidMotion::DeltaZ, W, increments.into())
    }

    /// Visits the loads of a motion, or the motion itself, in turn: what `prescribed` makes of the
    /// values, as [`Self::tangential`] visits forces. A motion that was free counts from 0.
    #[must_use]
    pub fn through(
        self,
        of: RigidMotion,
        prescribed: fn(f64) -> Prescribed,
        values: &[f64],
        increments: impl Into<Option<usize>>,
    ) -> Self {
        self.visit_as(of, prescribed, values, increments.into())
    }

    /// Stays where it is for some increments, one unit of path time: what friction makes of its
    /// history goes on.
    #[must_use]
    pub fn hold(self, increments: usize) -> Self {
        self.to(|_| (), increments)
    }

    /// The values of `n` cycles of an amplitude: to it, then `n` times to its opposite and back.
    pub fn cycle(amplitude: f64, n: usize) -> Vec<f64> {
        let cycles = std::iter::repeat_n([-amplitude, amplitude], n);
        std::iter::once(amplitude).chain(cycles.flatten()).collect()
    }

    /// Turns the tangential force around an ellipse of the semi-axes `T_x`, `T_y` \[N\] about its
    /// present value, from (T_x, 0) on towards (0, T_y), `turns` times. It goes there in
    /// `increments` and takes as many for a turn, each a branch of its own, since the path bends at
    /// each. Where they are yet to be chosen a turn has 64 branches.
    #[must_use]
    pub fn ellipse(
        mut self,
        (T_x, T_y): (f64, f64),
        turns: usize,
        increments: impl Into<Option<usize>>,
    ) -> Self {
        let increments = increments.into();
        let (middle, t0) = self.last();
        let at = |part: f64| {
            let mut to = middle;
            // The sine of half a turn is 1e-16 in floating point, and no force.
            let exact = |x: f64| if x.abs() < f64::EPSILON { 0.0 } else { x };
            let (sin, cos) = (TAU * part.fract()).sin_cos();
            let (along, across) = (T_x * exact(cos), T_y * exact(sin));
            to.prescribe(RigidMotion::DeltaX, Prescribed::Load(middle.T_x + along));
            to.prescribe(RigidMotion::DeltaY, Prescribed::Load(middle.T_y + across));
            to
        };
        self.branches
            .push(Branch::new(at(0.0), increments, t0 + 1.0));
        let chords = increments.unwrap_or(CHORDS);
        for i in 1..=turns * chords {
            let part = i as f64 / chords as f64;
            let t = t0 + 1.0 + part;
            let of_chord = increments.map(|_| 1);
            self.branches.push(Branch::new(at(part), of_chord, t));
        }
        self
    }

    /// Visits loads of a motion in turn, the increments in proportion to the change.
    fn visit(self, of: RigidMotion, values: &[f64], increments: Option<usize>) -> Self {
        self.visit_as(of, Prescribed::Load, values, increments)
    }

    /// The same of what `prescribed` makes of the values.
    fn visit_as(
        mut self,
        of: RigidMotion,
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
        let at = self.last().0.prescribed(of);
        let same_kind = at.is_motion() == prescribed(0.0).is_motion();
        let mut from = if same_kind { at.value() } else { 0.0 };
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
            to.prescribe(of, prescribed(value));
            let t_end = t + n.map_or(1.0, |n| n as f64 / per_unit as f64);
            self.branches.push(Branch::new(to, n, t_end));
        }
        self
    }
}
