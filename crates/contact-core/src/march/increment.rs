//! One increment: drives -> no_slip -> guess -> solve -> check -> account.

use super::accounts::Closing;
use super::domain::Domain;
use super::problem::{Drives, Problem};
use super::rolled::{Roll, Rolled};
use super::setup::{Failure, Setup, Solution, Solver, Workspace, count};
use super::{Increment, State, accounts, check, entry, friction, guess};
use crate::error::Error;
use crate::scene::LoadPoint;
use crate::solvers::Response;

/// Computes the increment to a point and makes it the present state, which after a failure is as before.
pub(super) fn increment(
    problem: &Problem,
    domain: &mut Domain,
    state: &mut State,
    ws: &mut Workspace,
    point: &LoadPoint,
    extrapolates: bool,
) -> Result<Increment, Failure> {
    let geometry = &domain.window.geometry;
    let roll = Roll::new(problem, state, point);
    let rolled = Rolled::new(&roll, geometry, problem.plan.mirror, state);
    let rolls = (&roll, rolled.as_ref());
    friction::update(problem, geometry, state, rolls, &mut ws.mu);
    let setup = Setup {
        problem,
        geometry,
        kernel: &domain.kernels.pair.zz,
        state,
        roll,
        rolled: rolled.as_ref(),
        mu: &ws.mu,
        point,
        drives: Drives::new(problem, &geometry.arms, state, point),
        goes_on: state.going_on(point),
    };
    let last_transform = domain.last_transform();
    ws.alternation.begin_increment();
    let mut solver = Solver {
        response: Response {
            inverse: domain.window.inverse.as_deref_mut().map(|of| of as _),
            stop: Some(&problem.stop),
            last_transform,
            ..Response::plain(&mut *domain.window.op)
        },
        no_slip: &mut ws.no_slip,
        workspace: &mut ws.alternation,
    };
    let (now, info) = solve(&setup, &mut solver, extrapolates)?;
    let clear = check::admissible(&setup, domain, &now, &info)?;
    let (mut increment, without_slip) = accounts::draw_up(&setup, &ws.no_slip, &now, &info);
    check::within_tolerance(&setup, &increment, count(&now))?;
    let closing = Closing {
        geometry,
        mirror: problem.plan.mirror,
        roll,
        rolled: rolled.as_ref(),
        mu: &ws.mu,
        no_slip: &ws.no_slip,
        keeps_residual: problem.plan.methods.residual_slip,
        shift: info.shift,
        without_slip,
        clear,
    };
    accounts::close(state, &increment, now, &closing);
    if state.work != 0.0 {
        increment.residuals.energy = increment.energy.imbalance() / state.work;
    }
    Ok(increment)
}

/// The solution from a first guess; of bodies that nothing presses together, that they carry nothing.
fn solve(
    setup: &Setup<'_>,
    solver: &mut Solver<'_>,
    extrapolates: bool,
) -> Result<Solution, Error> {
    // Without an approach of the path nothing ever presses, even where a moment could tilt a body against the other one.
    if setup.drives.press() && setup.problem.approach > 0.0 {
        let guess = guess::first_guess(setup, extrapolates);
        return entry::solve(setup, solver, guess);
    }
    let scene = &setup.problem.scene;
    let touching = (setup.geometry).touching(scene, setup.drives.normal.given);
    Ok(solver.apart(setup, touching))
}
