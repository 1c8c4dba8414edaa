//! Existence of a contact with mu = infinity: cells that the shear would lift off.
//!
//! On dissimilar bodies shear along the surface moves it up or down. At the rim of a sticking
//! contact there may be cells with no admissible state: sticking, they would be under tension;
//! separated, they overlap. Such a cell is pressed without shear
//! ([`solvers::intermediate`](crate::solvers::intermediate)), the limit of large mu, where cells
//! slip in a region that shrinks towards the rim. If cells inside the contact are lifted, or all
//! cells, no contact that sticks everywhere is in equilibrium under this shift.

use super::setup::Setup;
use crate::cells::Lattice;
use crate::error::Error;
use crate::solvers::Interface;

/// The error for an increment in which shear lifts more cells than a rim; none if it does not.
pub(super) fn lifted(setup: &Setup<'_>, now: &Interface) -> Option<Error> {
    if setup.problem.scene.friction.mu.is_finite() {
        return None;
    }
    let zone: Vec<bool> = now.p.iter().map(|&p| p > 0.0).collect();
    let slips = |&n: &usize| zone[n] && now.slips[n] && setup.mu[n].is_infinite();
    let contact = zone.iter().filter(|&&inside| inside).count();
    let lifted = (0..zone.len()).filter(slips).count();
    if lifted == 0 {
        return None;
    }
    let lattice = Lattice::new(&setup.geometry.grid, setup.problem.plan.mirror);
    let at_rim = lattice.border(&zone).into_iter().filter(slips).count();
    let within = lifted - at_rim;
    (within > 0 || lifted == contact).then_some(Error::Lifted {
        increment: setup.state.increments + 1,
        contact,
        lifted,
        within,
    })
}
