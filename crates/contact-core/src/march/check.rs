//! Residuals of the equations at the end of an increment, from the fields alone.

use super::domain::{Domain, half_lengths};
use super::lifted::lifted;
use super::setup::{Failure, Setup};
use super::transmitted::transmitted;
use super::{Increment, Residuals, Status, off_grid};
use crate::cells::{length, sums, sums_and_maxima};
use crate::error::Error;
use crate::scene::{LoadPoint, Loads, PrescribedMotions, RigidMotion};
use crate::solvers::intermediate::AlternationInfo;
use crate::solvers::no_slip::{NoSlipTerms, slip, unopposed_part};
use crate::solvers::{Interface, friction_bound};

/// Relative difference of sums in different order.
const ROUNDING: f64 = 1e-9;
/// Largest relative residual of the balances and of Coulomb's law: they hold by construction,
/// moments to 1e-10.
const EXACT: f64 = 1e-9;

/// Whether the solution holds on the whole grid: loads within the limit of friction, a contact
/// within window and grid, no overlap beyond the window. Returns a lower bound of the gap there
/// \[m\].
pub(super) fn admissible(
    setup: &Setup<'_>,
    domain: &Domain,
    now: &Interface,
    info: &AlternationInfo,
) -> Result<f64, Failure> {
    let Setup {
        problem,
        geometry,
        state,
        point,
        ..
    } = *setup;
    setup.unless_stopped()?;
    if let Some(unresisted) = unresisted(setup, now) {
        return Err(unresisted.into());
    }
    if let Some(lifted) = lifted(setup, now) {
        return Err(lifted.into());
    }
    if info.exceeds_friction() {
        let (increment, used) = (state.increments + 1, info.friction_used);
        return Err(Error::BeyondFriction { increment, used }.into());
    }
    let shape = (geometry.grid.nx, geometry.grid.ny);
    let half = half_lengths(&now.p, problem.plan.mirror.rows(shape.1), shape);
    if domain.is_narrow(problem, state, point, half) {
        return Err(Failure::Narrow(half));
    }
    let clear = domain.clear_beyond(problem, state, now, info)?;
    off_grid::check(setup, now)?;
    clear.ok_or(Failure::Beyond)
}

/// The residuals of gap, overlap, slip and loads of a solution, each over its scale, and three tractions
/// \[Pa\]: the largest pressure, the largest shear, and the root mean square of the shear.
pub(super) fn residuals(
    setup: &Setup<'_>,
    no_slip: &NoSlipTerms,
    now: &Interface,
    info: &AlternationInfo,
) -> (Residuals, [f64; 3]) {
    let mu = setup.problem.scene.friction.reference_mu();
    let (approach, hardness) = (setup.problem.approach, setup.problem.hardness);
    let arms = &setup.geometry.arms;
    let [x_0, y_0] = no_slip.displacement();
    let tractions = [&now.p[..], &now.q[0], &now.q[1], setup.mu];
    let moved = [&now.u[0][..], &now.u[1], x_0, y_0];
    let heights = [&now.u_z[..], &setup.geometry.h_init];
    let fields = ((tractions, moved), (heights, &now.slips[..]));
    let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
    let (sums, largest) = sums_and_maxima(fields, |n, ((tractions, moved), ([u_z, h], slips))| {
        let ([p, q_x, q_y, mu], [u_x, u_y, x_0, y_0]) = (tractions, moved);
        let mut gap = u_z + h - arms.displacement_across(info.approach, n);
        if p >= hardness {
            // The overlap is the indentation.
            gap = gap.max(0.0);
        }
        let bound = friction_bound(mu, p);
        let (stretched, excess) = (
            length([q_x, arms.axis_ratio * q_y]),
            length([q_x, q_y]) - bound,
        );
        if p <= 0.0 {
            return ([0.0; 7], [p, stretched, excess, -gap]);
        }
        let largest = [p, stretched, excess, 0.0];
        let q = [q_x, q_y];
        let slip = slip(
            [u_x, u_y],
            [x_0, y_0],
            arms.displacement_in_plane(info.shift, n),
        );
        if !slips {
            let squares = [1.0, 0.0, gap * gap, square(slip), 0.0, 0.0, square(q)];
            return (squares, largest);
        }
        let off = unopposed_part(slip, q);
        let (off, slip) = (square(off), square(slip));
        ([1.0, 1.0, gap * gap, 0.0, off, slip, square(q)], largest)
    });
    let [
        contact,
        slipping,
        gap_squares,
        stick,
        direction,
        slipped,
        q_squares,
    ] = sums;
    let [p_max, q_max, excess, overlap] = largest;
    let mut r = Residuals {
        coulomb: excess,
        ..Residuals::default()
    };
    let rms = |squares: f64, count: f64| (squares / count.max(1.0)).sqrt();
    // A path that never presses has no approach as a scale.
    let over_approach = |length: f64| if length > 0.0 { length / approach } else { 0.0 };
    r.gap = over_approach(rms(gap_squares, contact));
    r.penetration = over_approach(overlap);
    if slipped > 0.0 {
        r.angle = (direction / slipped).sqrt().min(1.0).asin();
    }
    if mu > 0.0 && contact > 0.0 {
        r.stick = rms(stick, contact - slipping) / (mu * approach);
        r.direction = rms(direction, slipping) / (mu * approach);
    }
    if excess > 0.0 {
        r.coulomb = excess / (mu * p_max);
    }
    r.balance = missing_loads(setup, now);
    (r, [p_max, q_max, rms(q_squares, contact)])
}

/// Largest error of the balances of given loads over their scale: W for the normal force, the sum
/// of mu p dA for forces in the plane, either times the half-length of the grid for moments.
fn missing_loads(setup: &Setup<'_>, now: &Interface) -> f64 {
    let point = setup.point;
    let all_given = LoadPoint {
        loads: Loads {
            given: PrescribedMotions::from_motions([Some(0.0); 6]),
            ..point.loads
        },
        ..*point
    };
    let carried = transmitted(setup, &all_given, now).forces();
    let (prescribed, motions) = (point.loads.forces(), point.loads.given.motions());
    let [pressed, friction] = load_limits(setup, now);
    (0..6)
        .filter(|&k| motions[k].is_none() && carried[k] != prescribed[k])
        .fold(0.0, |worst, k| {
            let bears = if k < 3 { pressed } else { friction };
            let scale = bears * setup.geometry.arms.motion_unit(k);
            ((carried[k] - prescribed[k]) / scale).abs().max(worst)
        })
}

/// The normal force, and the limit of the shear force under it, sum of mu p dA \[N\]. Where mu is infinite both
/// are the normal force.
fn load_limits(setup: &Setup<'_>, now: &Interface) -> [f64; 2] {
    let [p, bounds, unbounded] = sums([&now.p[..], setup.mu], |_, [p, mu]| {
        let bound = friction_bound(mu, p);
        if bound.is_finite() {
            [p, bound, 0.0]
        } else {
            [p, 0.0, 1.0]
        }
    });
    let cell_area = setup.problem.cell_area();
    let friction = if unbounded > 0.0 { p } else { bounds };
    [p * cell_area, friction * cell_area]
}

/// The error for a given load whose motion is free and meets no resistance, for lack of contact or of friction;
/// none if there is no such load.
fn unresisted(setup: &Setup<'_>, now: &Interface) -> Option<Error> {
    let [pressed, friction] = load_limits(setup, now);
    let (prescribed, motions) = (
        setup.point.loads.forces(),
        setup.point.loads.given.motions(),
    );
    let bears = |k: usize| if k < 3 { pressed } else { friction };
    let k = (0..6).find(|&k| motions[k].is_none() && prescribed[k] != 0.0 && bears(k) <= 0.0)?;
    let motion = RigidMotion::ALL[k];
    Some(Error::Unresisted {
        increment: setup.state.increments + 1,
        load: motion.load_name(),
        value: prescribed[k],
        why: if pressed > 0.0 {
            "no cell in contact has friction"
        } else {
            "the bodies do not touch"
        },
        motion: motion.name(),
    })
}

/// Independently of the solvers' own tests: gap, overlap and residual slip over all contact cells
/// must be within the tolerance, the loads balanced and the shear within its bound; otherwise the
/// increment has not converged.
pub(super) fn within_tolerance(
    setup: &Setup<'_>,
    increment: &Increment,
    (contact, slipping): (usize, usize),
) -> Result<(), Error> {
    let (scene, approach) = (&setup.problem.scene, setup.problem.approach);
    let r = &increment.residuals;
    let mu = scene.friction.reference_mu();
    let slips = if increment.status == Status::GrossSlip {
        // In gross slip the shift is arbitrary beyond the incipient one.
        0.0
    } else {
        let stick = r.stick.powi(2) * (contact - slipping) as f64;
        let direction = r.direction.powi(2) * slipping as f64;
        mu.max(1.0) * ((stick + direction) / contact.max(1) as f64).sqrt()
    };
    // `f64::max` passes over what is not a number.
    let is_known = [r.gap, r.penetration, slips, increment.energy.work]
        .iter()
        .all(|x| x.is_finite());
    let lengths = if is_known {
        r.gap.max(r.penetration).max(slips)
    } else {
        f64::NAN
    };
    let tolerance = scene.tolerance();
    let (residual, allowed) = if !(lengths <= tolerance * (1.0 + ROUNDING)) {
        (lengths * approach, tolerance * approach)
    } else if !(r.balance <= EXACT) {
        (r.balance, EXACT)
    } else if !(r.coulomb <= EXACT) {
        (r.coulomb, EXACT)
    } else {
        return Ok(());
    };
    Err(Error::NotConverged {
        increment: increment.index,
        solver: "coupled",
        residual,
        tolerance: allowed,
        iterations: increment.work.alternations,
        why: String::new(),
    })
}
