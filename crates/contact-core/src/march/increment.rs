//! One increment: drives -> no_slip -> guess -> solve -> check -> account.

use super::accounts::Closing;
use super::domain::{Domain, half_lengths};
use super::problem::{Drives, Problem};
use super::rolled::{Roll, Rolled, RollsOff};
use super::setup::{Failure, Setup, Solution, Solver, Workspace, count};
use super::{Increment, State, accounts, check, entry, friction, guess};
use crate::error::Error;
use crate::scene::{History, LoadPoint};
use crate::solvers::{Interface, Response};

/// Computes the increment to a point and makes it the present state, which after a failure is as
/// before.
pub(super) fn increment(
    problem: &Problem,
    domain: &mut Domain,
    state: &mut State,
    ws: &mut Workspace,
    point: &LoadPoint,
    extrapolates: bool,
) -> Result<Increment, Failure> {
    domain.window.geometry.indent(&state.indented);
    let geometry = &domain.window.geometry;
    let roll = Roll::new(problem, state, point);
    let respond = (
        &mut Response::plain(&mut *domain.window.op),
        problem.plan.friction,
    );
    let rolled = Rolled::new(&roll, geometry, problem.plan.mirror, state, respond).map_err(
        |RollsOff { free_cells }| {
            rolls_off(problem, state, domain.shape(), roll.margin(), free_cells)
        },
    )?;
    let first_setup = Setup {
        problem,
        geometry,
        kernel: &domain.kernels.pair.zz,
        first_pressure: &domain.first_pressure,
        state,
        roll,
        rolled: rolled.as_ref(),
        mu: &[],
        mu_before: &[],
        point,
        drives: Drives::new(problem, &geometry.arms, state, point),
        goes_on: state.going_on(point),
    };
    if let Some(law) = &problem.scene.friction.law {
        friction::by_law(&first_setup, law, None, &mut ws.mu_before)?;
        ws.mu.clone_from(&ws.mu_before);
    } else {
        let mu = [&mut ws.mu[..], &mut ws.mu_before[..]];
        friction::update(&first_setup, friction::expected_growth(&first_setup), mu);
    }
    let most_work = domain.most_work();
    let response = Response {
        inverse: domain.window.inverse.as_deref_mut().map(|of| of as _),
        stop: Some(&problem.stop),
        max_work: most_work,
        ..Response::plain(&mut *domain.window.op)
    };
    let (now, info) = with_its_friction(&first_setup, response, ws, extrapolates)?;
    let setup = Setup {
        mu: &ws.mu,
        mu_before: &ws.mu_before,
        ..first_setup
    };
    let clear = check::admissible(&setup, domain, &now, &info)?;
    let (mut increment, stuck) = accounts::draw_up(&setup, &ws.no_slip, &now, &info);
    check::within_tolerance(&setup, &increment, count(&now))?;
    let closing = Closing {
        geometry,
        mirror: problem.plan.mirror,
        roll,
        rolled: rolled.as_ref(),
        mu: [&ws.mu, &ws.mu_before],
        history: problem
            .scene
            .friction
            .history
            .as_ref()
            .map(|history| history.of),
        no_slip: &ws.no_slip,
        keeps_residual: problem.plan.methods.residual_slip,
        shift: info.shift,
        stuck,
        clear,
        hardness: problem.hardness,
    };
    accounts::close(state, &increment, now, &closing);
    if state.work != 0.0 {
        increment.residuals.energy = increment.energy.imbalance() / state.work;
    }
    Ok(increment)
}

/// Solves an increment with friction that depends on the history of the cells: again and again, until the
/// coefficients in `ws` agree with the solution. Other friction is solved once.
fn with_its_friction<'a>(
    given: &Setup<'_>,
    response: Response<'a>,
    ws: &'a mut Workspace,
    extrapolates: bool,
) -> Result<Solution, Error> {
    let law = &given.problem.scene.friction;
    let of_cells = |of: &History| matches!(of, History::Slip | History::Dissipated);
    let history = law.history.as_ref().map(|history| history.of);
    let (history, own) = (history.filter(of_cells), law.law.as_ref());
    let follows = history.is_some() || own.is_some();
    let mut solver = Solver {
        response,
        no_slip: &mut ws.no_slip,
        workspace: &mut ws.alternation,
    };
    let (mut guess, mut corrections) = (None, 0);
    loop {
        solver.workspace.begin_increment();
        let setup = Setup {
            mu: &ws.mu,
            mu_before: &ws.mu_before,
            ..*given
        };
        let (now, info) = solve(&setup, &mut solver, guess.take(), extrapolates)?;
        if !follows || corrections == friction::CORRECTIONS {
            return Ok((now, info));
        }
        let growth = |of| accounts::growth(&setup, solver.no_slip, &now, info.shift, of);
        let (mut next, mut before) = (ws.mu.clone(), ws.mu_before.clone());
        if let Some(law) = own {
            let solved = friction::Solved {
                p: &now.p,
                slip: &growth(History::Slip),
                dissipated: &growth(History::Dissipated),
            };
            friction::by_law(&setup, law, Some(&solved), &mut next)?;
        } else if let Some(of) = history {
            let growth = growth(of);
            friction::update(&setup, |n| growth[n], [&mut next, &mut before]);
        }
        if info.exceeds_friction() || friction::has_settled(&ws.mu, &next) {
            return Ok((now, info));
        }
        (ws.mu, guess, corrections) = (next, Some(now), corrections + 1);
    }
}

/// The failure of a contact that rolls off: a wider window is needed, or the grid is too small.
fn rolls_off(
    problem: &Problem,
    state: &State,
    shape: (usize, usize),
    cells: usize,
    free_cells: usize,
) -> Failure {
    let whole = &problem.scene.grid;
    if shape.0 < whole.nx {
        let rows = problem.plan.mirror.rows(shape.1);
        let [x, y] = half_lengths(&state.interface.p, rows, shape);
        return Failure::Narrow([x + cells, y]);
    }
    let allowed = format!(
        "at most {free_cells} cells, as many as lie between the contact and the border of the grid: more increments, or a longer grid"
    );
    Error::invalid(
        format!("path.rolled of increment {}", state.increments + 1),
        format!("{cells} cells in an increment"),
        allowed,
    )
    .into()
}

/// Solves an increment from a guess, by default from the first guess. Without tractions if nothing presses the
/// bodies together.
fn solve(
    setup: &Setup<'_>,
    solver: &mut Solver<'_>,
    guess: Option<Interface>,
    extrapolates: bool,
) -> Result<Solution, Error> {
    // A path without any approach never presses, even if a moment could tilt one body against the
    // other.
    if setup.drives.press() && setup.problem.approach > 0.0 {
        let guess = guess.unwrap_or_else(|| guess::first_guess(setup, extrapolates));
        return entry::solve(setup, solver, guess);
    }
    let scene = &setup.problem.scene;
    let touching = (setup.geometry).touching(scene, setup.drives.normal.given);
    Ok(solver.apart(setup, touching))
}
