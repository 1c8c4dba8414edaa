//! Digits of the displacements: changes of the tractions may be answered in single precision.
//!
//! What that rounds adds up over the changes. Where it comes to matter, a convolution in double precision
//! ties the displacements to the tractions again; where it keeps the iteration from its end, all is
//! answered in double precision.

use super::alternation::alternate;
use super::problem::{AlternationInfo, AlternationParams, AlternationWorkspace, IncrementProblem};
use crate::solvers::no_slip::NoSlip;
use crate::solvers::{Interface, Response, SolverError};

/// Part of the tolerances that rounding may come to.
const ROUNDED: f64 = 0.1;
/// Iterations whose changes are about what they change together; where it takes more, some go back and
/// forth, and what that has rounded is not known.
const STRAIGHT: usize = 30;
/// Most evaluations in double precision.
const EVALUATIONS: usize = 5;

/// Solves one increment, from a guess of the tractions in `now` to the solution.
pub fn alternation(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    no_slip: &mut NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    params: &AlternationParams,
) -> Result<AlternationInfo, SolverError> {
    let rounds = response.rounding() > 0.0;
    match evaluated(response, problem, no_slip, now, ws, params) {
        Err(_) if rounds && !response.stopped() => {
            response.exact = true;
            let solved = evaluated(response, problem, no_slip, now, ws, params);
            response.exact = false;
            solved
        }
        ended => ended,
    }
}

/// Alternates, again from displacements in double precision where rounding comes to matter.
fn evaluated(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    no_slip: &mut NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    params: &AlternationParams,
) -> Result<AlternationInfo, SolverError> {
    let allowed = ROUNDED * params.tolerance.min(params.tangential.tolerance);
    let mut work = AlternationInfo::default();
    for _ in 0..EVALUATIONS {
        let mut info = alternate(response, problem, no_slip, now, ws, params)?;
        let straight = info.iterations() <= STRAIGHT;
        info.add_work(&work);
        work = info;
        let [q_x, q_y, p] = &ws.evaluated;
        let rounding = response.rounding() * now.differs([q_x, q_y, p]);
        if response.rounding() == 0.0 || (straight && rounding <= allowed) {
            break;
        }
    }
    Ok(work)
}
