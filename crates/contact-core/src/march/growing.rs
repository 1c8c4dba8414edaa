//! Substeps of an increment in which the contact grows by much.
//!
//! A cell that comes into contact sticks where it entered, and its motion before entry depends on
//! the contact at that time. An increment that starts without contact, or with a small one, has
//! little information on that contact: the cells that enter last get a ring of wrong shear, which
//! stays in the stick zone. In an increment from the radius b to a the relative error of the shear
//! in the ring is about 1.2 (1 - b/a)^2, and 2 for b = 0. Since the shear itself grows like a,
//! steps of equal a^(1/2) give the same absolute error everywhere. Steps at small radii are solved
//! in small windows and cost little.
//!
//! For similar bodies that are sheared while the contact grows, only the first contact has this
//! error: the first of n increments uniform in W reaches the radius n^(-1/3) a. Steps of equal
//! radius suffice there: the error of the shear is about 0.12, 0.033, 0.012, 0.007 with 1, 2, 4, 8
//! of them (nu = 0.3, T = W/4). Similar bodies under the load alone have no shear.

use super::State;
use super::problem::Problem;
use crate::plan::Plan;
use crate::scene::{LoadPoint, RigidMotion, Scene, Shape};

/// Principal curvatures that differ by less than this part belong to a round contact.
const ROUND: f64 = 1e-9;

/// Tolerance in the number of steps, so that the same scene in other units gets the same number.
const ROUNDING: f64 = 1e-9;
/// Exponents n of W ~ a^n and delta_z ~ a^n of a paraboloid.
const FORCE: i32 = 3;
const APPROACH: i32 = 2;

/// Intermediate loads of the substeps of an increment, the last excepted; empty where one step is
/// enough.
pub(super) fn steps(problem: &Problem, state: &State, point: &LoadPoint) -> Vec<LoadPoint> {
    let plan = &problem.plan;
    let [from, to] = radii(problem, state, point);
    // NaN where nothing presses.
    if !(plan.methods.entry && plan.friction && to > from) {
        return Vec::new();
    }
    let steps_to_largest = plan.methods.growth_steps as f64;
    // The steps are even in this power of the radius.
    let (power, steps) = if plan.coupling && are_paraboloids(&problem.scene) {
        (0.5, steps_to_largest * (to.sqrt() - from.sqrt()))
    } else if from == 0.0 && is_sheared(point) {
        (1.0, 0.5 * steps_to_largest * to)
    } else {
        return Vec::new();
    };
    let approach_is_prescribed = point.loads.given.delta_z.is_some();
    let of_load = if approach_is_prescribed {
        APPROACH
    } else {
        FORCE
    };
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
        .map(|k| point.interpolate_to(loads, motions, part(k)))
        .collect()
}

/// The contact radius before and after an increment over the largest of the path, as of a
/// paraboloid: a ~ delta_z^(1/2), a ~ W^(1/3).
fn radii(problem: &Problem, state: &State, point: &LoadPoint) -> [f64; 2] {
    let largest = problem.largest;
    let touches = state.interface.p.iter().any(|&p| p > 0.0);
    let part =
        |to: f64, of: f64, power: i32| (to / of).clamp(0.0, 1.0).powf(1.0 / f64::from(power));
    if let Some(delta_z) = point.loads.given.delta_z {
        let now = state.motion.delta_z;
        // Bodies in contact first touched near delta_z = 0.
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

/// Whether the contact grows from a point: smooth convex shapes.
pub(super) fn are_paraboloids(scene: &Scene) -> bool {
    let smooth = |shape: &Shape| {
        matches!(
            shape,
            Shape::Flat | Shape::Sphere { .. } | Shape::Ellipsoid { .. }
        )
    };
    let both_smooth = smooth(&scene.body1.shape) && smooth(&scene.body2.shape);
    both_smooth && !scene.grid.plane_strain && scene.hertz().is_some()
}

/// Whether the first branch of a path is an indentation whose stick zone remembers a function of the
/// radius: round smooth bodies, coupled, with friction that is the same everywhere.
pub(crate) fn is_remembered(scene: &Scene, plan: &Plan) -> bool {
    let (steep, shallow) = scene.principal_curvatures();
    let law = &scene.friction;
    are_paraboloids(scene)
        && steep - shallow <= ROUND * steep
        && (plan.coupling && plan.friction && plan.methods.entry)
        && law.map.is_none()
        && !law.varies()
        && law.axis_ratio() == 1.0
        && scene.path.branches[0].only_presses()
}

/// Whether a load or a motion along the plane is given.
fn is_sheared(point: &LoadPoint) -> bool {
    let mut in_plane = RigidMotion::ALL.into_iter().filter(|of| of.is_in_plane());
    in_plane.any(|of| point.loads.prescribed(of).value() != 0.0)
}
