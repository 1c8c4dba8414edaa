//! The intermediate loop: pressure and shear of one increment in turn (figure 2 of the paper).
//!
//! The pressure is found for known shear, then the shear for known pressure, until the gap that the
//! shear causes is within the tolerance. Where the bodies are similar neither changes the other and
//! one pass is exact. The displacements are kept: each solver adds the response to its own change
//! of the tractions. As long as a pass leaves a gap that the next one must close, the inner loops
//! end early (inexact steps: R. S. Dembo, S. C. Eisenstat, T. Steihaug, SIAM J. Numer. Anal. 19
//! (1982) 400-408).

use super::known_pressure::{
    bring_within_bound, incipient_shift, let_new_cells_slip, solve_shear,
    update_tangential_displacement,
};
use super::problem::{AlternationInfo, AlternationParams, AlternationWorkspace, IncrementProblem};
use crate::solvers::inner::{NormalProblem, Sliding, assess_gap, solve_normal};
use crate::solvers::no_slip::NoSlip;
use crate::solvers::{Interface, Response, SolverError};

/// Solves pressure and shear in turn, from a guess of the tractions in `now` to the solution.
pub(super) fn alternate_pressure_and_shear(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    no_slip: &mut NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    params: &AlternationParams,
) -> Result<AlternationInfo, SolverError> {
    let friction = problem.friction;
    let coupled = response.op.is_coupled() && friction;
    let gap = problem.normal_problem();
    let mut info = AlternationInfo::default();
    let mut sliding = Sliding::default();
    if friction {
        sliding = bring_within_bound(problem, no_slip, now, ws, [0.0; 3]);
    }
    now.evaluate(response, friction);
    ws.begin_solution(params);
    let mut residual = if coupled {
        assess_gap(&gap, &now.p, &now.u_z).misfit()
    } else {
        0.0
    };
    loop {
        info.alternations += 1;
        let (inner, last) = params.params_of_pass(residual);

        // Pressure for known shear.
        ws.save_tractions(now);
        let (p, u_z) = (&mut now.p, &mut now.u_z);
        let solution = solve_normal(response, &gap, p, u_z, &mut ws.normal, &inner.normal)?;
        info.normal_iterations += solution.iterations;
        info.approach = solution.motion;
        if !friction {
            return Ok(info);
        }

        // Shear for known pressure: the bound moves with the pressure.
        if solution.iterations > 0 {
            sliding = update_bound_and_shear(response, problem, no_slip, now, ws, (params, &info));
        }
        info.friction_used = sliding.used;
        if info.exceeds_friction() {
            return Ok(info);
        }
        if sliding.is_full() {
            no_slip.clear_turn();
            info.shift = incipient_shift(problem, no_slip, sliding.motion, now, ws);
        } else {
            solve_shear(response, problem, no_slip, now, ws, &inner, &mut info)?;
        }
        if !coupled {
            return Ok(info);
        }

        // The gap after the change of shear.
        residual = gap_after_shear(response, &gap, now, ws, &mut info);
        if last && residual <= params.tolerance {
            return Ok(info);
        }
        if info.alternations >= params.max_alternations {
            return Err(error_without_convergence(residual, &info, params));
        }
        ws.anderson.extrapolate(&now.p, &mut now.u_z);
    }
}

/// Updates bound, shear and u_t for the pressure of the normal solver; returns the loads over the
/// limit of friction.
fn update_bound_and_shear(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    no_slip: &NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    (params, info): (&AlternationParams, &AlternationInfo),
) -> Sliding {
    let coupled = response.op.is_coupled();
    (ws.lifted).add_lifted(info.alternations, problem.mu, &ws.p_before, now);
    if params.new_cells_slip && (info.alternations > 1 || !problem.enters) {
        let (c_xx, _) = response.op.self_coefficients();
        let_new_cells_slip(problem, no_slip, now, ws, (info, c_xx));
    }
    let sliding = bring_within_bound(problem, no_slip, now, ws, info.shift);
    update_tangential_displacement(response, now, ws, coupled);
    sliding
}

/// Adds the response to the change of shear to u_z. Returns the residual of the gap \[m\]; 0 if the
/// shear has not changed, since the gap is then the one of the normal solver.
fn gap_after_shear(
    response: &mut Response<'_>,
    problem: &NormalProblem<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    info: &mut AlternationInfo,
) -> f64 {
    let change = ws.compute_change_of_shear(now);
    if !change && !ws.anderson.accelerates() {
        return 0.0;
    }
    if change {
        let [x, y] = &ws.change;
        response.respond_normally_to_shear([x, y], &mut ws.response[0]);
    } else {
        ws.response[0].fill(0.0);
    }
    ws.anderson.close_pass(&ws.response[0], &mut now.u_z);
    let check = assess_gap(problem, &now.p, &now.u_z);
    info.approach = check.motion;
    check.misfit()
}

/// The error of an alternation that has not converged.
fn error_without_convergence(
    residual: f64,
    info: &AlternationInfo,
    params: &AlternationParams,
) -> SolverError {
    SolverError {
        solver: "coupled",
        residual,
        tolerance: params.tolerance,
        iterations: info.alternations,
    }
}
