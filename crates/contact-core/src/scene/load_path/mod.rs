//! The load history: branches, each cut into increments.

mod build;
mod check;
mod history;
mod point;
mod waypoints;

pub use point::LoadPoint;
pub use waypoints::Increments;

use super::{Loads, RigidMotion};

/// How the increments of a branch are spaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// Equal increments of force (default).
    #[default]
    Uniform,
    /// Increments of equal contact radius for a paraboloid: the force grows with the cube of the
    /// count, an approach that is given with the square. The natural spacing of an indentation.
    EqualRadius,
    /// A short first increment, at whose end the branch has its largest stick zone and the
    /// stiffness right after the reversal, then equal ones. Chosen automatically after a reversal.
    ShortFirst,
}

/// Part of a branch that a short first increment covers. Right after a reversal by 2 mu W the
/// secant stiffness of a Cattaneo-Mindlin contact is low by a sixth of that part, its stick ratio
/// by two thirds.
const SHORT: f64 = 1.0 / 64.0;

impl Spacing {
    /// Increments that are not those of equal size.
    fn extra(self) -> usize {
        match self {
            Self::Uniform | Self::EqualRadius => 0,
            Self::ShortFirst => 1,
        }
    }

    /// Part of the branch, and of its path time, covered after `i` of its `n` increments.
    pub(crate) fn covered(self, i: usize, n: usize, approach_given: bool) -> (f64, f64) {
        let s = i as f64 / n as f64;
        match (self, approach_given) {
            (Self::Uniform, _) => (s, s),
            (Self::EqualRadius, false) => (s.powi(3), s),
            (Self::EqualRadius, true) => (s.powi(2), s),
            (Self::ShortFirst, _) => {
                let equal = (i - 1) as f64 / (n - 1).max(1) as f64;
                let s = if n == 1 {
                    1.0
                } else {
                    SHORT + (1.0 - SHORT) * equal
                };
                (s, s)
            }
        }
    }
}

/// One straight piece of the load history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Loads at the end of the branch.
    pub to: Loads,
    /// Number of increments, at least one; `None`: as many as the tolerance on the path needs,
    /// [`choose_increments`](crate::estimate::choose_increments).
    pub increments: Option<usize>,
    /// How they are spaced.
    pub spacing: Spacing,
    /// Path time at the end of the branch; only a label, the contact is quasi-static.
    pub t_end: f64,
    /// Estimated error of the shear at the end of the branch that its increments leave: relative to
    /// the largest shear of the path (L2), as known before a run
    /// ([`shear_errors`](crate::march::shear_errors) after it). `None` without an estimate.
    pub path_error: Option<f64>,
}

impl Branch {
    /// A branch of equal increments.
    pub fn new(to: Loads, increments: impl Into<Option<usize>>, t_end: f64) -> Self {
        Self {
            to,
            increments: increments.into(),
            spacing: Spacing::Uniform,
            t_end,
            path_error: None,
        }
    }

    /// Increments, one where the number is yet to be chosen.
    pub fn count(&self) -> usize {
        self.increments.unwrap_or(1)
    }

    /// Those of them that are of equal size, a short first one left out.
    pub(crate) fn equal_increments(&self) -> usize {
        self.count().saturating_sub(self.spacing.extra()).max(1)
    }

    /// Sets the number of equal increments.
    pub(crate) fn set_equal_increments(&mut self, count: usize) {
        self.increments = Some(count + self.spacing.extra());
    }

    /// Whether nothing but normal forces and tilting moments, or their motions, act at its end.
    pub(crate) fn only_presses(&self) -> bool {
        let to = &self.to;
        let in_plane = |of: RigidMotion| of.is_in_plane() && to.prescribed(of).value() != 0.0;
        let shears = RigidMotion::ALL.into_iter().any(in_plane);
        let strained = [to.sigma_B, to.sigma_B1, to.rolled];
        !shears && strained.iter().all(|s| *s == 0.0)
    }
}

/// The load history, from the unloaded state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadPath {
    /// Branches in the order they are run through.
    pub branches: Vec<Branch>,
    /// Stiffness along x of a rig, a spring in series with the contact through which the shift
    /// delta_x is given or read \[N/m\]; `None`: the bodies themselves are moved. With the spring's
    /// end at u the contact's own shift is u - T_x/K.
    pub rig_stiffness: Option<f64>,
}

impl LoadPath {
    /// Number of increments of the whole path; a branch whose number is yet to be chosen counts as
    /// one.
    pub fn increments(&self) -> usize {
        let counts = self.branches.iter().map(Branch::count);
        counts.fold(0, usize::saturating_add)
    }

    /// Whether nothing but normal forces and tilting moments, or their motions, act.
    pub(crate) fn only_presses(&self) -> bool {
        self.branches.iter().all(Branch::only_presses)
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
}
