//! Precision of the displacements: responses to changes of the tractions may be computed in single
//! precision.
//!
//! The rounding errors of the changes add up, also of changes that are undone: a contact that
//! slides far passes through tractions many times larger than its solution. Where their estimate
//! exceeds the tolerance, the displacements are evaluated once in double precision, and the
//! iteration continues from there with smaller changes; where the iteration does not converge, all
//! responses are computed in double precision.

use super::alternation::alternate_pressure_and_shear;
use super::problem::{AlternationInfo, AlternationParams, AlternationWorkspace, IncrementProblem};
use crate::solvers::no_slip::NoSlip;
use crate::solvers::{Interface, Response, SolverError};

/// Largest estimate of the rounding error over the tolerances.
const ROUNDED: f64 = 0.1;
/// Most evaluations in double precision between changes in single precision.
const EVALUATIONS: usize = 5;

/// Solves one increment, from a guess of the tractions in `now` to the solution.
pub fn solve_increment(
    response: &mut Response<'_>,
    problem: &IncrementProblem<'_>,
    no_slip: &mut NoSlip<'_>,
    now: &mut Interface,
    ws: &mut AlternationWorkspace,
    params: &AlternationParams,
) -> Result<AlternationInfo, SolverError> {
    let allowed_error = ROUNDED * params.tolerance.min(params.tangential.tolerance);
    let mut work = AlternationInfo::default();
    for _ in 0..EVALUATIONS {
        match alternate_pressure_and_shear(response, problem, no_slip, now, ws, params) {
            Ok(mut info) => {
                info.add_work(&work);
                work = info;
                if response.rounding_error() <= allowed_error {
                    return Ok(work);
                }
            }
            Err(failed) if response.op.rounding() == 0.0 || response.must_stop() => {
                return Err(failed);
            }
            Err(_) => break,
        }
    }
    response.exact = true;
    let solution = alternate_pressure_and_shear(response, problem, no_slip, now, ws, params);
    response.exact = false;
    solution.map(|mut info| {
        info.add_work(&work);
        info
    })
}
