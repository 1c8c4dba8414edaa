//! Growth of a contact within one increment: in steps where it grows by much.
//!
//! A cell that comes into contact sticks where it entered, and how it moved before depends on the contact that there
//! was then. Of an increment that begins without contact nothing is known of that but the solution at its end, and of
//! one that begins with a small contact little: the cells that enter last keep a ring of wrong shear, which later
//! increments bury in the stick zone as it is. From the radius b to a the ring is off by about 1.2 (1 - b/a)^2 of
//! the shear then, by 2 from nothing, and the shear goes with a: steps of equal sqrt(a) leave the same error everywhere.
//! Those at small radii are solved in a small window and cost little.
//!
//! Where similar bodies are sheared as they grow the error is that of the first contact alone: of n increments uniform in
//! W it covers n^(-1/3) of the radius. Steps of equal radius do there: the error of the shear is about 0.12, 0.033, 0.012,
//! 0.007 with 1, 2, 4, 8 of them (nu = 0.3, T = W/4). Similar bodies under the load alone have no shear.

use super::State;
use super::problem::Problem;
use crate::scene::{LoadPoint, RigidMotion, Scene, Shape};

/// What rounding makes of a whole number of steps: the same scene in other units is solved in as many.
const ROUNDING: f64 = 1e-9;
/// Powers of the radius that load and approach of a paraboloid go with.
const FORCE: i32 = 3;
const APPROACH: i32 = 2;

/// The ends of the steps in which an increment is solved whose contact grows, but the last; none where one step will do.
pub(super) fn steps(problem: &Problem, state: &State, point: &LoadPoint) -> Vec<LoadPoint> {
    let plan = &problem.plan;
    let [from, to] = radii(problem, state, point);
    // Not numbers where nothing presses.
    if !(plan.methods.entry && plan.friction && to > from) {
        return Vec::new();
    }
    let most = plan.methods.growth_steps as f64;
    // What goes evenly is this power of the radius.
    let (power, steps) = if plan.coupling && are_paraboloids(&problem.scene) {
        (0.5, most * (to.sqrt() - from.sqrt()))
    } else if from == 0.0 && is_sheared(point) {
        (1.0, 0.5 * most * to)
    } else {
        return Vec::new();
    };
    let given = point.loads.given.delta_z.is_some();
    let of_load = if given { APPROACH } else { FORCE };
    let steps = (steps - ROUNDING).ceil() as usize;
    let part = |k: usize| {
        let even = k as f64 / steps as f64;
        let [from_evenly, to_evenly] = [from, to].map(|a| a.powf(power));
        let radius = (from_evenly + even * (to_evenly - from_evenly)).powf(1.0 / power);
        let [from, to, radius] = [from, to, radius].map(|a: f64| a.powi(of_load));
        (radius - from) / (to - from)
    };
    let (loads, motions) = (&state.loads, state.motion.motions());
    (1..steps)
        .map(|k| point.on_the_way(loads, motions, part(k)))
        .collect()
}

/// The radius of the contact before and after an increment over the largest of the path: of a paraboloid it goes with
/// the root of the approach, the cube root of the load.
fn radii(problem: &Problem, state: &State, point: &LoadPoint) -> [f64; 2] {
    let largest = problem.largest;
    let touches = state.interface.p.iter().any(|&p| p > 0.0);
    let part =
        |to: f64, of: f64, power: i32| (to / of).clamp(0.0, 1.0).powf(1.0 / f64::from(power));
    if let Some(delta_z) = point.loads.given.delta_z {
        let now = state.motion.delta_z;
        // Bodies that have touched did so about where their middles met.
        let touching = if touches { 0.0 } else { now };
        let at = |approach: f64| part(approach - touching, largest.delta_z - touching, APPROACH);
        [if touches { at(now) } else { 0.0 }, at(delta_z)]
    } else {
        let at = |W: f64| part(W, largest.W, FORCE);
        [
            if touches { at(state.loads.W) } else { 0.0 },
            at(point.loads.W),
        ]
    }
}

/// Whether the bodies are such that their contact grows from a point.
fn are_paraboloids(scene: &Scene) -> bool {
    let smooth = |shape: &Shape| {
        matches!(
            shape,
            Shape::Flat | Shape::Sphere { .. } | Shape::Ellipsoid { .. }
        )
    };
    let both = smooth(&scene.body1.shape) && smooth(&scene.body2.shape);
    both && !scene.grid.plane_strain && scene.hertz().is_some()
}

/// Whether a load or a motion along the plane is given.
fn is_sheared(point: &LoadPoint) -> bool {
    let mut in_plane = RigidMotion::ALL.into_iter().filter(|of| of.is_in_plane());
    in_plane.any(|of| point.loads.prescribed(of).value() != 0.0)
}
