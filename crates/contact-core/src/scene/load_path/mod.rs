//! The load history: branches, each cut into increments.

mod build;
mod check;
mod cycles;
mod history;
mod point;
mod units;
mod waypoints;

pub use cycles::Open;
pub use point::LoadPoint;
pub use units::ForceUnits;
pub use waypoints::{Increments, Samples, Swing, sample_period};

use super::{Loads, RigidMotion};

/// Spacing of the increments of a branch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// Equal increments of force (default).
    #[default]
    Uniform,
    /// Increments of equal contact radius for a paraboloid: the force grows with the cube of the
    /// count, a prescribed approach with the square. The natural spacing of an indentation.
    EqualRadius,
    /// A short first increment, at whose end the branch has its largest stick zone and the
    /// stiffness right after the reversal, then equal ones. Chosen automatically after a reversal.
    ShortFirst,
}

/// Fraction of a branch that a short first increment covers. Right after a reversal by 2 mu W the
/// secant stiffness of a Cattaneo-Mindlin contact is low by a sixth of this fraction, its stick ratio
/// by two thirds.
const SHORT_FRACTION: f64 = 1.0 / 64.0;

impl Spacing {
    /// Number of increments besides the equal ones.
    fn unequal_increments(self) -> usize {
        match self {
            Self::Uniform | Self::EqualRadius => 0,
            Self::ShortFirst => 1,
        }
    }

    /// Fractions of the branch, and of its path time, covered after `i` of its `n` increments.
    pub(crate) fn covered_fraction(self, i: usize, n: usize, approach_given: bool) -> (f64, f64) {
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
                    SHORT_FRACTION + (1.0 - SHORT_FRACTION) * equal
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
    /// Spacing of the increments.
    pub spacing: Spacing,
    /// Path time at the end of the branch; only a label, the contact is quasi-static.
    pub t_end: f64,
    /// Estimated error of the shear at the end of the branch due to its increments: relative to
    /// the largest shear of the path (L2), as estimated before a run
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

    /// Number of increments; one where the number is not yet chosen.
    pub fn count(&self) -> usize {
        self.increments.unwrap_or(1)
    }

    /// Number of equal increments (a shorter first one is not counted).
    pub(crate) fn equal_increments(&self) -> usize {
        self.count()
            .saturating_sub(self.spacing.unequal_increments())
            .max(1)
    }

    /// Sets the number of equal increments.
    pub(crate) fn set_equal_increments(&mut self, count: usize) {
        self.increments = Some(count + self.spacing.unequal_increments());
    }

    /// Whether only normal forces and tilting moments, or their motions, act at its end.
    pub(crate) fn only_presses(&self) -> bool {
        let to = &self.to;
        let shears_along = |of: RigidMotion| of.is_in_plane() && to.prescribed(of).value() != 0.0;
        let is_sheared = RigidMotion::ALL.into_iter().any(shears_along);
        let other_loads = [to.sigma_B, to.sigma_B1, to.rolled];
        !is_sheared && other_loads.iter().all(|s| *s == 0.0)
    }
}

/// The load history, from the unloaded state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadPath {
    /// Branches in the order they are run through.
    pub branches: Vec<Branch>,
    /// Stiffness along x of a rig, a spring in series with the contact through which the shift
    /// delta_x is prescribed or read \[N/m\]; `None`: the bodies themselves are moved. With the end of the
    /// spring at u the shift of the contact is u - T_x/K.
    pub rig_stiffness: Option<f64>,
    /// The units in which forces were written, if as texts.
    pub units: ForceUnits,
    /// Path time of a cycle; `None` (default): cycles are found where the loads return.
    pub period: Option<f64>,
}

impl LoadPath {
    /// Number of increments of the whole path; a branch whose number is not yet chosen counts as
    /// one.
    pub fn increments(&self) -> usize {
        let counts = self.branches.iter().map(Branch::count);
        counts.fold(0, usize::saturating_add)
    }

    /// Whether only normal forces and tilting moments, or their motions, act.
    pub(crate) fn only_presses(&self) -> bool {
        self.branches.iter().all(Branch::only_presses)
    }

    /// Whether the increments of a branch are not yet chosen.
    pub fn has_open_increments(&self) -> bool {
        self.branches.iter().any(|b| b.increments.is_none())
    }

    /// The largest prescribed normal force \[N\].
    pub fn W_max(&self) -> f64 {
        let prescribing = self
            .branches
            .iter()
            .filter(|b| b.to.given.delta_z.is_none());
        prescribing.fold(0.0, |m, b| m.max(b.to.W))
    }

    /// The largest prescribed approach \[m\].
    pub fn delta_z_max(&self) -> f64 {
        let approaches = self.branches.iter().filter_map(|b| b.to.given.delta_z);
        approaches.fold(0.0, f64::max)
    }
}
