//! The tangential problem: shear for known pressure.
//!
//! ```text
//! minimise  1/2 q.C_tt q + q.w   over  |q| <= g = mu p,  sum of q dA = T, moment of q dA = M_z
//! ```
//!
//! with w = C_tz p - u_ref: convex, its multiplier is the rigid motion d(delta), its gradient the
//! slip ds = u - u_ref - d(delta). A motion that is given enters w, and its force has
//! no constraint. Eq. (7)-(8) and (20) of the paper are its optimality conditions.
//!
//! A semi-smooth Newton method: on stick cells both components are free; on slip cells q = g e and
//! only the motion along the circle is, where the constraint adds the diagonal |ds|/g. Each step is
//! a linear system on that tangent space with the force constraint projected out, solved by
//! conjugate gradients preconditioned with a guess of the inverse (`newton_step`). Then q returns
//! to the circle, stick cells beyond it start to slip, and slip cells whose slip would go along q
//! stick again. A step that raises the energy is taken back and projected gradients, which cannot, go
//! on from there; so they do where the slip set goes in circles.

use std::sync::atomic::{AtomicBool, Ordering};

use super::admissible;
use super::contact_shear::{Before, ContactShear};
use super::newton_step::NewtonStep;
use super::projected_gradient::ProjectedGradient;
use super::shear_gradient::GradientBuffers;
use super::{Shear, TangentialInfo, TangentialParams, TangentialProblem, first_shift};
use crate::cells::ContactCells;
use crate::cells::{set_cells, size};
use crate::solvers::{Response, SolverError};

/// Buffers of the tangential solver.
#[derive(Debug)]
pub struct TangentialWorkspace {
    cells: ContactCells,
    contact: ContactShear,
    before: Before,
    step: NewtonStep,
    pub(crate) descent: ProjectedGradient,
    pub(crate) gradient: GradientBuffers,
}

impl TangentialWorkspace {
    /// For fields of `cells` cells.
    pub fn new(cells: usize) -> Self {
        Self {
            cells: ContactCells::default(),
            contact: ContactShear::default(),
            before: Before::default(),
            step: NewtonStep::new(cells),
            descent: ProjectedGradient::default(),
            gradient: GradientBuffers::default(),
        }
    }
}

/// A slip set counts as settled when no slip cell moves along its shear by more than this part of
/// the tolerance, and a change of q is negligible when it moves no cell by more than that.
const SETTLED: f64 = 0.1;

/// Part of the tolerance that the last conjugate gradients aim at: what the circles bend adds to it.
const AIM: f64 = 0.4;

/// Part of the tolerance that shear may move the surfaces by and yet be owed; only where the displacements
/// that mean no slip follow, since other steps may be taken back.
const LEFT: f64 = 0.6;

/// Passes of projected gradients after a Newton step that would have raised the energy.
const DESCENT: usize = 10;

/// Newton steps without a smaller misfit after which the slip set is taken to go in circles, and
/// projected gradients go on; and after which nothing is hoped for.
const CIRCLES: usize = 10;
const STALLED: usize = 100;

/// Solves for the shear. On entry it must be admissible: within the bound and balanced.
pub fn tangential(
    response: &mut Response<'_>,
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    ws: &mut TangentialWorkspace,
    params: &TangentialParams,
) -> Result<TangentialInfo, SolverError> {
    let (c_xx, _) = response.op.self_coefficients();
    let settled = SETTLED * params.tolerance;
    let TangentialWorkspace {
        cells,
        contact,
        before,
        step,
        ..
    } = ws;
    cells.find(problem.bound.len(), |n| problem.bound[n] > 0.0);
    contact.pack(cells, problem, shear);
    let (inside, mut now) = contact.parts(problem.drive);
    step.set_contact(&inside);
    let root_of_contact = (cells.count() as f64).sqrt();
    let mut info = TangentialInfo {
        shift: first_shift(&inside, &now),
        ..Default::default()
    };
    let follows = !problem.turning.is_empty();
    let mut fits = 0;
    let (mut least, mut stalled) = (f64::INFINITY, 0);
    loop {
        let released = release(&inside, &mut now, info.shift, settled);
        let fitted = step.linearise(&inside, &now, info.shift, c_xx);
        info.misfit = step.residual_norm() / root_of_contact;
        let solved = !released && info.misfit <= params.tolerance;
        if now.owed.owes()
            && (!follows || solved && info.misfit + now.owed.moves > params.tolerance)
        {
            step.restart();
            step.answer(response, cells, &mut now);
            step.follow_on_grid(shear);
            continue;
        }
        let ahead = |k: usize| (fitted[k] - info.shift[k]).abs();
        if solved && (0..3).all(|k| ahead(k) <= settled) {
            now.unpack(cells, shear);
            return Ok(info);
        }
        stalled = if info.misfit < least { 0 } else { stalled + 1 };
        least = least.min(info.misfit);
        let ended = stalled == STALLED || info.iterations + fits == params.max_iterations;
        if ended || response.stopped() {
            return Err(SolverError {
                solver: "tangential",
                residual: info.misfit,
                tolerance: params.tolerance,
                iterations: info.iterations,
            });
        }
        if solved {
            // The slip cells were judged by another shift.
            info.shift = fitted;
            fits += 1;
            continue;
        }
        info.iterations += 1;
        if !follows {
            before.keep(&now);
        }
        let target = (params.forcing * info.misfit).max(AIM * params.tolerance);
        info.passes += step.solve(response, cells, target * root_of_contact, params.max_passes);
        info.shift = step.take(cells, &inside, &mut now);
        mark_slip(&inside, &mut now, info.shift);
        now.owed.take(now.q.each_ref().map(|q| &**q));
        admissible(&inside, &mut now.q, now.slip);
        let norm = response.op.norm() / root_of_contact;
        let changed = now.owed.put(now.q.each_ref().map(|q| &**q), norm);
        let negligible = if follows {
            now.owed.moves <= LEFT * params.tolerance
        } else {
            changed <= settled / c_xx
        };
        if !negligible {
            step.answer(response, cells, &mut now);
        } else if !follows {
            now.owed.settle();
        }
        let circles = stalled > 0 && stalled.is_multiple_of(CIRCLES);
        if !follows && (circles || before.is_lower(&inside, &now, info.shift, settled)) {
            before.restore(&mut now);
            now.unpack(cells, shear);
            info.shift = ws.descent.run(response, problem, shear, DESCENT);
            info.passes += DESCENT;
            now.pack(cells, shear);
        } else {
            step.follow_on_grid(shear);
        }
        if follows {
            now.unpack(cells, shear);
            return Ok(info);
        }
    }
}

/// Stick cells beyond the bound start to slip; slip cells whose slip goes along q stick.
fn mark_slip(problem: &TangentialProblem<'_>, shear: &mut Shear<'_>, shift: [f64; 3]) {
    let Shear { q, u, slip, .. } = shear;
    set_cells(slip, |n, slips| {
        let q = [q[0][n], q[1][n]];
        if slips {
            power(q, problem.slip(u, shift, n)) <= 0.0
        } else {
            size(q) > problem.bound[n]
        }
    });
}

/// Releases slip cells that move along their shear by more than `tolerance` \[m\]; whether any did.
fn release(
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    shift: [f64; 3],
    tolerance: f64,
) -> bool {
    let Shear { q, u, slip, .. } = shear;
    let released = AtomicBool::new(false);
    set_cells(slip, |n, slips| {
        let along = |slip| power([q[0][n], q[1][n]], slip) > tolerance * problem.bound[n];
        if slips && along(problem.slip(u, shift, n)) {
            released.store(true, Ordering::Relaxed);
            return false;
        }
        slips
    });
    released.into_inner()
}

/// q . ds, negative where friction dissipates \[Pa m\].
fn power(q: [f64; 2], slip: [f64; 2]) -> f64 {
    q[0] * slip[0] + q[1] * slip[1]
}
