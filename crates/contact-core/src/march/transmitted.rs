//! The loads that the tractions of an increment transmit.

use super::setup::Setup;
use crate::cells::sums;
use crate::scene::{LoadPoint, Loads};
use crate::solvers::Interface;

/// The loads of an increment to `point`: those given, and for given motions the resultants of the
/// tractions.
pub(super) fn transmitted(setup: &Setup<'_>, point: &LoadPoint, now: &Interface) -> Loads {
    let (problem, arms) = (setup.problem, &setup.geometry.arms);
    let cell_area = problem.cell_area();
    let sums = [
        sums([&now.p[..]], |n, [p]| arms.loads_across(p, n)),
        sums([&now.q[0][..], &now.q[1]], |n, q| arms.loads_in_plane(q, n)),
    ];
    let (forces, given) = (point.loads.forces(), point.loads.given);
    let motions = given.motions();
    let transmitted = std::array::from_fn(|k| match motions[k] {
        None => forces[k],
        // The mirrored half has the opposite sign.
        Some(_) if problem.is_odd(k) => 0.0,
        Some(_) => sums[k / 3][k % 3] * cell_area * arms.motion_unit(k),
    });
    point.loads.with_forces(transmitted, given)
}
