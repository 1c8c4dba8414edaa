//! The growth of a contact from nothing within one increment.
//!
//! A cell that comes into contact sticks where it entered, and how it moved before depends on the contact that there
//! was then. Of an increment that begins without contact nothing is known of that but the solution at its end. Where
//! shear grows together with the load that leaves the shear off by a fifth, and by a third on dissimilar bodies. What
//! the first increment errs by stays: of n increments uniform in W it covers n^(-1/3) of the radius, and
//! the shear at the end is off by n^(-2/3) of that. So a contact that is sheared as it grows does so in steps of equal
//! radius. Of dissimilar bodies under the load alone, whose shear is that of the coupling, the increments are given or
//! chosen: steps would take 28 % more work with 20 of them.

use super::State;
use super::problem::Problem;
use crate::scene::{LoadPoint, RigidMotion, Spacing};

/// Steps in which a contact grows to the largest of the path: the error of the shear is about 0.12, 0.033, 0.012, 0.007
/// with 1, 2, 4, 8 of them (similar bodies, nu = 0.3, T = W/4), and 0.36, 0.12, 0.033, 0.012 on bodies of 70 and 210
/// GPa.
const STEPS: f64 = 8.0;

/// The ends of the steps in which an increment is solved that begins without contact, but the last; none of one that
/// begins with a contact, is small against the path, or has no shear given.
pub(super) fn steps(problem: &Problem, state: &State, point: &LoadPoint) -> Vec<LoadPoint> {
    let touches = state.interface.p.iter().any(|&p| p > 0.0);
    let plan = &problem.plan;
    if touches || !plan.methods.entry || !plan.friction || !is_sheared(point) {
        return Vec::new();
    }
    let path = &problem.scene.path;
    let given = point.loads.given.delta_z;
    let touching = state.motion.delta_z;
    // Of a paraboloid the radius goes with the root of the approach, the cube root of the load.
    let radius = match given {
        Some(delta_z) => ((delta_z - touching) / (path.delta_z_max() - touching)).sqrt(),
        None => (point.loads.W / path.W_max()).cbrt(),
    };
    // Not a number where nothing presses.
    let steps = if radius > 0.0 {
        (STEPS * radius.min(1.0)).ceil() as usize
    } else {
        1
    };
    let (loads, motions) = (&state.loads, state.motion.motions());
    let part = |k: usize| Spacing::EqualRadius.covered(k, steps, given.is_some()).0;
    (1..steps)
        .map(|k| point.on_the_way(loads, motions, part(k)))
        .collect()
}

/// Whether a load or a motion along the plane is given.
fn is_sheared(point: &LoadPoint) -> bool {
    let mut in_plane = RigidMotion::ALL.into_iter().filter(|of| of.is_in_plane());
    in_plane.any(|of| point.loads.prescribed(of).value() != 0.0)
}
