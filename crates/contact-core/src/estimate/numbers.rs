//! The numbers whose errors are estimated.

use crate::march::BranchSummary;

/// Places of the numbers of a branch that have an error bar, in the order of
/// [`ErrorBars`](super::ErrorBars).
pub(crate) const CONTACT_RADIUS: usize = 0;
pub(crate) const STICK_RATIO: usize = 1;
pub(crate) const P_MAX: usize = 2;
pub(crate) const DISSIPATED: usize = 3;
pub(crate) const Q_MAX: usize = 4;
/// Indices of the first motion and of the first load; the others follow in the order of
/// [`RigidMotion::ALL`](crate::scene::RigidMotion::ALL).
pub(crate) const MOTIONS: usize = 5;
pub(crate) const LOADS: usize = MOTIONS + 6;
/// Indices for bodies that yield: plastic work, volume that has yielded, largest plastic strain.
pub(crate) const PLASTIC: usize = LOADS + 6;
/// How many there are.
pub(crate) const NUMBERS: usize = PLASTIC + 3;

/// The numbers of a branch that get an error bar, in a fixed order.
pub(crate) fn numbers(branch: &BranchSummary) -> [f64; NUMBERS] {
    let mut numbers = [0.0; NUMBERS];
    numbers[CONTACT_RADIUS] = branch.contact_radius;
    // Without contact there is no stick ratio, and no error of one.
    if branch.contact_radius > 0.0 {
        numbers[STICK_RATIO] = branch.stick_ratio;
    }
    numbers[P_MAX] = branch.p_max;
    numbers[DISSIPATED] = branch.dissipated;
    numbers[Q_MAX] = branch.q_max;
    numbers[MOTIONS..LOADS].copy_from_slice(&branch.motion.motions());
    numbers[LOADS..PLASTIC].copy_from_slice(&branch.loads.forces());
    numbers[PLASTIC..].copy_from_slice(&[
        branch.plastic_work,
        branch.plastic_volume,
        branch.largest_plastic_strain,
    ]);
    numbers
}

/// Whether a number of a branch is prescribed by the path and so has no error: of each motion and its load one
/// is given.
pub(crate) fn is_given(branch: &BranchSummary, number: usize) -> bool {
    let is_prescribed = branch.loads.given.motions().map(|motion| motion.is_some());
    match number.checked_sub(MOTIONS) {
        Some(motion) if motion < 6 => is_prescribed[motion],
        Some(load) if load < 12 => !is_prescribed[load - 6],
        _ => false,
    }
}
