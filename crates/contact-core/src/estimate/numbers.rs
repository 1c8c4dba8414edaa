//! The numbers whose errors are estimated.

use crate::march::BranchSummary;

/// How many there are.
pub(crate) const NUMBERS: usize = 8;

/// The numbers of a branch that have an error bar, in the order of [`ErrorBars`](super::ErrorBars).
pub(crate) fn numbers(branch: &BranchSummary) -> [f64; NUMBERS] {
    [
        branch.contact_radius,
        branch.stick_ratio,
        branch.p_max,
        branch.motion.delta_z,
        branch.motion.delta_x,
        branch.motion.delta_y,
        branch.motion.phi_z,
        branch.dissipated,
    ]
}
