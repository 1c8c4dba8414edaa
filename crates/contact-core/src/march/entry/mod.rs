//! Cells that come into contact within an increment, because it grows or because it rolls on.
//!
//! Such a cell moves freely until it touches: its slip counts from its entry, not from the start of
//! the increment. A first solution on the old contact gives the motion of each new cell before its
//! entry ([`KeptContact`]), which is added to the no-slip displacement u_0. A cell that leaves the
//! contact needs no such term: its shear vanishes with its pressure.

mod equations;
mod first_contact;
mod kept_contact;
mod least_squares;
mod motion;
mod neighbours;
mod order;
mod screened;
mod view;

use self::first_contact::solve_first_contact;
use self::kept_contact::KeptContact;
pub(super) use self::least_squares::LeastSquares;
use super::setup::{Setup, Solution, Solver};
use crate::error::Error;
use crate::solvers::Interface;
use crate::solvers::inner::scale_pressure;

/// Solves the increment from a first guess, with the motion of new cells before their entry.
pub(super) fn solve(
    setup: &Setup<'_>,
    solver: &mut Solver<'_>,
    guess: Interface,
) -> Result<Solution, Error> {
    if !cells_enter(setup) {
        return solver.solve(setup, &equations::whole(setup), guess);
    }
    if setup.state.interface.p.iter().all(|&p| p <= 0.0) {
        return solve_first_contact(setup, solver, guess);
    }
    let (kept, info) = solve_kept(setup, solver, on_old_cells(setup, &guess))?;
    let last = setup.last();
    let motion = KeptContact::new(setup, &kept, &info).motion_before_entry(|n| last.p[n] <= 0.0);
    // The solution on the old contact is the better guess, if there is one.
    let solved = !info.exceeds_friction() && kept.p.iter().any(|&p| p > 0.0);
    let guess = if solved { kept } else { guess };
    let (now, mut found) = solver.solve(setup, &equations::entered(setup, &motion), guess)?;
    found.add_work(&info);
    Ok((now, found))
}

/// Solves the increment with the contact kept to the old cells: all others get a gap too large to close.
fn solve_kept(
    setup: &Setup<'_>,
    solver: &mut Solver<'_>,
    guess: Interface,
) -> Result<Solution, Error> {
    let h_init = &setup.geometry.h_init;
    let highest = h_init.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
    let far = 1e3 * (setup.problem.approach + highest);
    let cells = h_init.iter().zip(&setup.last().p);
    let apart: Vec<f64> = cells
        .map(|(h, &p)| if p > 0.0 { *h } else { h + far })
        .collect();
    solver.solve(setup, &equations::kept(&apart), guess)
}

/// First guess on the old contact: the predicted pressure scaled to the load, the last shear.
fn on_old_cells(setup: &Setup<'_>, guess: &Interface) -> Interface {
    let mut kept = setup.last().clone();
    let old = kept.p.iter().map(|&p| p > 0.0);
    let predicted: Vec<_> = old
        .zip(&guess.p)
        .map(|(old, &p)| if old { p } else { 0.0 })
        .collect();
    if predicted.iter().any(|&p| p > 0.0) {
        kept.p = predicted;
    }
    let normal = &setup.drives.normal;
    if normal.free[0] {
        scale_pressure(&mut kept.p, normal.sums[0], setup.problem.hardness);
    }
    kept
}

/// Whether cells enter in the increment, by growth or rolling, under shear or coupling.
fn cells_enter(setup: &Setup<'_>) -> bool {
    let (plan, drives) = (&setup.problem.plan, &setup.drives);
    let Interface { p, q, .. } = &setup.state.interface;
    let grows = if setup.stays() {
        false
    } else if drives.normal.free[0] {
        let rounding = f64::EPSILON * p.len() as f64;
        drives.normal.sums[0] > p.iter().sum::<f64>() * (1.0 + rounding)
    } else {
        drives.normal.given[0] > setup.state.approach(&setup.geometry.arms)[0]
    };
    let drive = &drives.tangential;
    let sheared = plan.coupling
        || drive.sums.iter().chain(&drive.given).any(|&t| t != 0.0)
        || q.iter().flatten().any(|&q| q != 0.0);
    let enters = grows || setup.roll.cells != 0;
    plan.methods.entry && plan.friction && enters && sheared
}
