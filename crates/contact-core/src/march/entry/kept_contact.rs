//! The solution of an increment on the old contact: closing of gaps and motion of the cells
//! outside.

use super::neighbours::Neighbours;
use super::screened::Screened;
use super::view::REACH;
use crate::march::setup::Setup;
use crate::solvers::Interface;
use crate::solvers::intermediate::AlternationInfo;
use crate::solvers::no_slip::slip;

/// Gaps, closings and motions of all cells outside the old contact, with the contact held as it
/// was.
pub(super) struct KeptContact {
    /// Gap at the start \[m\].
    pub(super) gap: Vec<f64>,
    /// Closing of the gap in the increment \[m\].
    pub(super) closing: Vec<f64>,
    /// Motion relative to the rigid shift \[m\].
    pub(super) motion: [Vec<f64>; 2],
    pub(super) cells: Neighbours,
    pub(super) screened: Screened,
    /// Whether cells next to the contact enter one by one.
    pub(super) ordered: bool,
}

impl KeptContact {
    /// Keeps what entry needs of a solution in which the contact is kept to the old cells: gaps, closing and
    /// motion of the cells outside.
    pub(super) fn new(setup: &Setup<'_>, kept: &Interface, info: &AlternationInfo) -> Self {
        let (geometry, mirror) = (setup.geometry, setup.problem.plan.mirror);
        let (last, arms) = (setup.last(), &geometry.arms);
        let approach = setup.state.approach(arms);
        let cells = 0..geometry.h_init.len();
        let gap = |u_z: &[f64], approach: [f64; 3], n: usize| {
            u_z[n] + geometry.h_init[n] - arms.displacement_across(approach, n)
        };
        let before = |n: usize| {
            let wider = setup.roll.gap_at(geometry, mirror, n);
            (gap(&last.u_z, approach, n) - wider).max(0.0)
        };
        let motion = |n: usize| {
            let at = |u: &[Vec<f64>; 2]| [u[0][n], u[1][n]];
            slip(
                at(&kept.u),
                at(&last.u),
                arms.displacement_in_plane(info.shift, n),
            )
        };
        Self {
            motion: [0, 1].map(|c| cells.clone().map(|n| motion(n)[c]).collect()),
            gap: cells.clone().map(before).collect(),
            closing: cells
                .map(|n| before(n) - gap(&kept.u_z, info.approach, n))
                .collect(),
            cells: Neighbours::new(&geometry.grid, mirror, REACH, setup.kernel),
            screened: Screened::new(&geometry.grid, setup.kernel),
            ordered: setup.problem.plan.methods.order_of_entry,
        }
    }
}
