//! The tangential problem: shear for known pressure.
//!
//! ```text
//! minimise  1/2 q.C_tt q + q.w   over  |q| <= g = mu p,  sum of q dA = T, moment of q dA = M_z
//! ```
//!
//! with w = C_tz p - u_ref: convex, its multiplier is the rigid motion d(delta), its gradient the
//! slip ds = u - u_ref - d(delta). A motion that is given enters w, and its force has no constraint. Eq. (7)-(8) and (20) of the paper are its optimality conditions.
//!
//! A semi-smooth Newton method: on stick cells both components are free; on slip cells q = g e and
//! only the motion along the circle is, where the constraint adds the diagonal |ds|/g. Each step is
//! a linear system on that tangent space with the force constraint projected out, solved by
//! conjugate gradients preconditioned with S P S, P the inverse of the operator and
//! S = (1 + diag/C_xx(0,0))^(-1/2). Then q returns to the circle, stick cells beyond it start to
//! slip, and slip cells whose slip would go along q stick again. A step that raises the energy is
//! taken back and projected gradients, which cannot, go on from there.

use super::admissible::admissible;
use super::newton_step::NewtonStep;
use super::projected_gradient::ProjectedGradient;
use super::shear::{
    Shear, TangentialInfo, TangentialParams, TangentialProblem, first_shift, power,
};
use super::vector::{add_scaled, size, sum_cells};
use super::{Response, SolverError};

/// Buffers of the tangential solver.
#[derive(Debug)]
pub struct TangentialWorkspace {
    step: NewtonStep,
    pub(crate) descent: ProjectedGradient,
    u_before: [Vec<f64>; 2],
    pub(crate) q_before: [Vec<f64>; 2],
    pub(crate) residual: [Vec<f64>; 2],
    pub(crate) direction: [Vec<f64>; 2],
    pub(crate) change: [Vec<f64>; 2],
    pub(crate) response: [Vec<f64>; 2],
}

impl TangentialWorkspace {
    /// For fields of `cells` cells.
    pub fn new(cells: usize) -> Self {
        let pair = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            step: NewtonStep::new(cells),
            descent: ProjectedGradient::new(cells),
            u_before: pair(),
            q_before: pair(),
            residual: pair(),
            direction: pair(),
            change: pair(),
            response: pair(),
        }
    }
}

/// A slip set counts as settled when no slip cell moves along its shear by more than this part of
/// the tolerance, and a change of q is negligible when it moves no cell by more than that.
const SETTLED: f64 = 0.1;

/// Passes of projected gradients after a Newton step that would have raised the energy.
const DESCENT: usize = 30;

/// Solves for the shear. On entry it must be admissible: within the bound and balanced.
pub fn tangential(
    response: &mut Response<'_>,
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    ws: &mut TangentialWorkspace,
    params: &TangentialParams,
) -> Result<TangentialInfo, SolverError> {
    let root_of_contact = (problem.bound.iter().filter(|&&g| g > 0.0).count() as f64).sqrt();
    ws.step.set_contact(problem);
    let (c_xx, _) = response.op.self_coefficients();
    let negligible = SETTLED * params.tolerance / c_xx;
    let mut info = TangentialInfo {
        shift: first_shift(problem, shear),
        ..Default::default()
    };
    loop {
        let released = release(problem, shear, info.shift, SETTLED * params.tolerance);
        ws.step.linearise(problem, shear, info.shift, c_xx);
        info.misfit = ws.step.residual_norm() / root_of_contact;
        if released == 0 && info.misfit <= params.tolerance {
            return Ok(info);
        }
        if info.iterations == params.max_iterations || response.stopped() {
            return Err(SolverError {
                solver: "tangential",
                residual: info.misfit,
                tolerance: params.tolerance,
                iterations: info.iterations,
            });
        }
        info.iterations += 1;
        let target = (params.forcing * info.misfit).max(0.3 * params.tolerance);
        info.passes += ws
            .step
            .solve(response, target * root_of_contact, params.max_passes);
        for c in 0..2 {
            ws.q_before[c].copy_from_slice(shear.q[c]);
            ws.u_before[c].copy_from_slice(shear.u[c]);
        }
        info.shift = ws.step.take(problem, shear);
        mark_slip(problem, shear, info.shift);
        if admissible(problem, &mut shear.q, shear.slip, &mut ws.change) > negligible {
            let [change_x, change_y] = &ws.change;
            let [response_x, response_y] = &mut ws.response;
            response.tangential([change_x, change_y], [response_x, response_y]);
            for c in 0..2 {
                add_scaled(shear.u[c], 1.0, &ws.response[c]);
            }
        }
        if rises(problem, shear, ws, params.tolerance) {
            for c in 0..2 {
                shear.q[c].copy_from_slice(&ws.q_before[c]);
                shear.u[c].copy_from_slice(&ws.u_before[c]);
            }
            info.shift = ws.descent.run(response, problem, shear, DESCENT);
            info.passes += DESCENT;
        }
    }
}

/// Whether the energy is higher than before the step, by more than the tolerance makes of the
/// change of shear. With C symmetric and the sum of the change zero, the difference of the energy
/// is the change times the mean slip.
fn rises(
    problem: &TangentialProblem<'_>,
    shear: &Shear<'_>,
    ws: &TangentialWorkspace,
    tolerance: f64,
) -> bool {
    let given = problem.drive.given;
    let [rise, moved] = sum_cells(problem.bound.len(), |n| {
        let given = problem.arms.in_plane(given, n);
        let (mut rise, mut moved) = (0.0, 0.0);
        for c in 0..2 {
            let change = shear.q[c][n] - ws.q_before[c][n];
            let mean = 0.5 * (shear.u[c][n] + ws.u_before[c][n]) - problem.u_ref[c][n];
            rise += change * (mean - given[c]);
            moved += change.abs();
        }
        [rise, moved]
    });
    rise > SETTLED * tolerance * moved
}

/// Stick cells beyond the bound start to slip; slip cells whose slip goes along q stick.
fn mark_slip(problem: &TangentialProblem<'_>, shear: &mut Shear<'_>, shift: [f64; 3]) {
    for n in 0..problem.bound.len() {
        shear.slip[n] = if shear.slip[n] {
            power(problem, shear, shift, n) <= 0.0
        } else {
            let g = problem.bound[n];
            g > 0.0 && size([shear.q[0][n], shear.q[1][n]]) > g
        };
    }
}

/// Releases slip cells that move along their shear by more than `tolerance` \[m\]; how many.
fn release(
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    shift: [f64; 3],
    tolerance: f64,
) -> usize {
    let mut released = 0;
    for n in 0..problem.bound.len() {
        if shear.slip[n] && power(problem, shear, shift, n) > tolerance * problem.bound[n] {
            shear.slip[n] = false;
            released += 1;
        }
    }
    released
}
