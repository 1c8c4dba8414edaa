//! Whether a contact that never slips holds: friction without a limit, and cells that their shear would lift.
//!
//! On dissimilar bodies shear along the surface moves it up or down. At the rim of a contact that sticks there may be
//! cells that have no place: held, they would be under tension; parted, they overlap. Such a cell is pressed without
//! shear ([`solvers::intermediate`](crate::solvers::intermediate)): what large coefficients of friction tend to are
//! cells that slip in a region that shrinks towards the rim. Where cells within the contact are
//! lifted, or all of them, the bodies are shifted so far that no contact that sticks everywhere is in equilibrium.

use super::setup::Setup;
use crate::cells::Lattice;
use crate::error::Error;
use crate::solvers::Interface;

/// Says so where more is lifted than a rim.
pub(super) fn lifted(setup: &Setup<'_>, now: &Interface) -> Option<Error> {
    if setup.problem.scene.friction.mu.is_finite() {
        return None;
    }
    let zone: Vec<bool> = now.p.iter().map(|&p| p > 0.0).collect();
    let slips = |&n: &usize| zone[n] && now.slip[n] && setup.mu[n].is_infinite();
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
