//! Shear for known pressure: the bound mu p, the sliding that the loads may drive, the tangential
//! solver.

use super::problem::{AlternationInfo, AlternationParams, AlternationWorkspace, IncrementProblem};
use crate::cells::{add_vectors, length, set_cells, set_fields};
use crate::convolution::{Displacements, Tractions};
use crate::plan::TangentialMethod;
use crate::solvers::inner::{
    Sliding, TangentialInfo, compute_sliding, first_shift, make_admissible, newton_step,
    shear_gradient, solve_tangential,
};
use crate::solvers::no_slip::{NoSlip, slip};
use crate::solvers::{Interface, Response, SolverError, friction_bound};

/// After STALLED Newton steps without a smaller misfit, each of which halves the relaxation of u_0,
/// the turn term of u_0 is dropped in this pass; after UNSETTLED such passes in the whole
/// increment.
const STALLED: usize = 5;
const UNSETTLED: usize = 3;

/// Brings the shear within the bound mu p of the present pressure and to the prescribed loads; returns
/// these loads over the limit of friction. `shift` is an estimate of the rigid motion \[m\]. Contact
/// cells without friction slip; cells out of contact carry no shear.
pub(super) fn bring_within_bound(
    problem: &IncrementProblem<'_>,
    no_slip: &NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    shift: [f64; 3],
) -> Sliding {
    set_fields([problem.mu, &now.p], [&mut ws.bound], |_, [mu, p], _| {
        [friction_bound(mu, p)]
    });
    ws.lifted.clear_bound(&mut ws.bound);
    let (p, bound) = (&now.p, &ws.bound);
    set_cells(&mut now.slips, |n, slips| {
        if bound[n] > 0.0 {
            slips && bound[n].is_finite()
        } else {
            p[n] > 0.0
        }
    });
    let shear = problem.tangential_problem(&ws.bound, no_slip.displacement());
    let sliding = compute_sliding(&shear);
    if sliding.is_full() {
        for n in 0..now.p.len() {
            now.slips[n] = now.p[n] > 0.0;
            let direction = problem.arms.displacement_in_plane(sliding.motion, n);
            let size = length(direction).max(f64::MIN_POSITIVE);
            for c in 0..2 {
                now.q[c][n] = ws.bound[n] * direction[c] / size;
            }
        }
    } else {
        make_admissible(&shear, &mut now.shear(), shift);
    }
    sliding
}

/// Lets cells slip that the normal solver has brought into contact if |ds| > 2 C_xx(0,0) mu p: more than
/// the displacement that the largest shear of such a cell alone can prevent. If they stuck, they
/// would have the largest misfit of all cells. In the first pass the shift is fitted to the cells
/// that have stuck so far.
pub(super) fn let_new_cells_slip(
    problem: &IncrementProblem<'_>,
    no_slip: &NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    (info, c_xx): (&AlternationInfo, f64),
) {
    let mut shift = info.shift;
    if info.alternations == 1 {
        set_fields(
            [problem.mu, &ws.p_before],
            [&mut ws.bound],
            |_, [mu, p], _| [friction_bound(mu, p)],
        );
        let shear = problem.tangential_problem(&ws.bound, no_slip.displacement());
        shift = first_shift(&shear, &now.shear());
    }
    let [x_0, y_0] = no_slip.displacement();
    for n in (0..now.p.len()).filter(|&n| ws.p_before[n] <= 0.0 && now.p[n] > 0.0) {
        let u = [now.u[0][n], now.u[1][n]];
        let slip = slip(
            u,
            [x_0[n], y_0[n]],
            problem.arms.displacement_in_plane(shift, n),
        );
        let (slip_size, bound) = (length(slip), friction_bound(problem.mu[n], now.p[n]));
        if slip_size > 2.0 * c_xx * bound {
            now.slips[n] = true;
            for c in 0..2 {
                now.q[c][n] = -bound * slip[c] / slip_size;
            }
        }
    }
}

/// Updates u_t for the changes of the pressure from `p_before` and of the shear from `q_before`.
pub(super) fn update_tangential_displacement(
    response: &mut Response<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    coupled: bool,
) {
    let shear_changed = ws.compute_change_of_shear(now);
    set_fields([&now.p[..]], [&mut ws.p_before], |_, [p], [before]| {
        [p - before]
    });
    let pressure_changed = coupled && ws.p_before.iter().any(|&change| change != 0.0);
    if !shear_changed && !pressure_changed {
        return;
    }
    let [u_x, u_y] = &mut ws.response;
    let tractions = Tractions {
        q_x: shear_changed.then_some(&ws.change[0][..]),
        q_y: shear_changed.then_some(&ws.change[1][..]),
        p: pressure_changed.then_some(&ws.p_before[..]),
    };
    response.respond(
        tractions,
        Displacements {
            u_x: Some(u_x),
            u_y: Some(u_y),
            u_z: None,
        },
    );
    let ([response_x, response_y], [u_x, u_y]) = (&ws.response, &mut now.u);
    set_fields([&response_x[..], response_y], [u_x, u_y], |_, of, u| {
        [u[0] + of[0], u[1] + of[1]]
    });
}

/// Solves for the shear under the present pressure, with its shift.
pub(super) fn solve_shear(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    no_slip: &mut NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    params: &AlternationParams,
    info: &mut AlternationInfo,
) -> Result<(), SolverError> {
    if info.alternations == 1 {
        let shear = problem.tangential_problem(&ws.bound, no_slip.displacement());
        info.shift = first_shift(&shear, &now.shear());
    }
    if ws.bound.iter().all(|&bound| bound <= 0.0) {
        // No cell carries shear: free motions are undetermined and taken as zero.
        info.shift = problem.tangential.given;
        return Ok(());
    }
    if iterate_with_turn(response, problem, no_slip, now, ws, params, info) {
        return Ok(());
    }
    no_slip.clear_turn();
    let shear = problem.tangential_problem(&ws.bound, no_slip.displacement());
    let (mut unknowns, params) = (now.shear(), &params.tangential);
    let buffers = &mut ws.tangential;
    let solution = match params.method {
        TangentialMethod::Newton => {
            solve_tangential(response, &shear, &mut unknowns, buffers, params)
        }
        TangentialMethod::Gradient => {
            let buffers = (&mut buffers.descent, &mut buffers.gradient);
            shear_gradient(response, &shear, &mut unknowns, buffers, params)
        }
    }?;
    record_solution(info, &solution);
    Ok(())
}

/// Takes Newton steps, and updates the turn term of u_0 between them as long as the misfit falls; returns
/// whether shear and u_0 agree at the end.
fn iterate_with_turn(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    no_slip: &mut NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    params: &AlternationParams,
    info: &mut AlternationInfo,
) -> bool {
    let (mut least_misfit, mut stalled, mut relaxation) = (f64::INFINITY, 0, 1.0);
    for _ in 0..params.tangential.max_iterations {
        if ws.unsettled == UNSETTLED || response.must_stop() {
            return false;
        }
        if !no_slip.update_turn(now, info.shift, relaxation) {
            return false;
        }
        let shear = problem.tangential_problem(&ws.bound, no_slip.displacement());
        let (turning, buffers) = (no_slip.turning(), &mut ws.tangential);
        let solution = newton_step(
            response,
            &shear,
            turning,
            &mut now.shear(),
            buffers,
            &params.tangential,
        );
        record_solution(info, &solution);
        if solution.iterations == 0 {
            return true;
        }
        if solution.misfit < least_misfit {
            (least_misfit, stalled) = (solution.misfit, 0);
        } else {
            stalled += 1;
            relaxation *= 0.5;
        }
        if stalled == STALLED {
            break;
        }
    }
    ws.unsettled += 1;
    false
}

/// Takes shift and iterations of a tangential solution into the account.
fn record_solution(info: &mut AlternationInfo, solution: &TangentialInfo) {
    info.tangential_iterations += solution.passes;
    info.shift = solution.shift;
}

/// The smallest motion of the kind `sliding` at which every contact cell slips \[m\].
pub(super) fn incipient_shift(
    problem: &IncrementProblem<'_>,
    no_slip: &NoSlip<'_>,
    sliding: [f64; 3],
    now: &mut Interface,
    ws: &AlternationWorkspace,
) -> [f64; 3] {
    let problem = problem.tangential_problem(&ws.bound, no_slip.displacement());
    let prescribed = problem.drive.given;
    let u = now.shear().u;
    let required_motion = |n: usize| -> f64 {
        let direction = problem.arms.displacement_in_plane(sliding, n);
        let slip = problem.slip(&u, prescribed, n);
        (slip[0] * direction[0] + slip[1] * direction[1])
            / (direction[0] * direction[0] + direction[1] * direction[1])
    };
    let largest = (0..problem.bound.len())
        .filter(|&n| problem.bound[n] > 0.0)
        .map(required_motion)
        .filter(|needed| needed.is_finite())
        .fold(f64::NEG_INFINITY, f64::max);
    add_vectors(prescribed, sliding.map(|s| largest * s))
}
