//! Cells that come into contact within an increment, because it grows or because it rolls on.
//!
//! Such a cell has moved freely before it stuck: its slip is reckoned from its entry, not from the
//! start of the increment. Solved with the contact kept to the old cells first, the increment shows
//! how far a new cell has moved by then ([`KeptContact`]); that is added to the displacement that
//! means no slip. A cell that leaves the contact needs nothing of the kind: its shear ends with its
//! pressure, and nothing remembers it.

mod first_contact;
mod kept_contact;
mod least_squares;
mod neighbours;
mod order;
mod screened;
mod view;

use self::first_contact::solve_first_contact;
use self::kept_contact::KeptContact;
use self::neighbours::Neighbours;
pub(super) use self::order::AROUND;
use self::screened::Screened;
use self::view::REACH;
use super::increment::{Asked, Setup, Solution, Solver};
use crate::error::Error;
use crate::solvers::Interface;
use crate::solvers::intermediate::AlternationInfo;
use crate::solvers::no_slip::slip;

/// Shares of the tolerance that increments in which cells enter are solved to, on the old cells alone
/// and with the new ones: where these stick their residual slip stays.
const KEPT_SHARE: f64 = 0.5;
const ENTERED_SHARE: f64 = 0.25;

/// Solves the increment from a first guess, its new cells with the motion before their entry.
pub(super) fn solve(
    setup: &Setup<'_>,
    solver: &mut Solver<'_>,
    guess: Interface,
) -> Result<Solution, Error> {
    if !cells_enter(setup) {
        let asked = Asked {
            h_init: &setup.geometry.h_init,
            share: 1.0,
            turns: true,
            entry: None,
        };
        return solver.solve(setup, &asked, guess);
    }
    if setup.state.interface.p.iter().all(|&p| p <= 0.0) {
        return solve_first_contact(setup, solver, guess);
    }
    let (kept, info) = solve_kept(setup, solver, on_old_cells(setup, &guess))?;
    let last = setup.last();
    let motion = kept_contact(setup, &kept, &info).motion_before_entry(|n| last.p[n] <= 0.0);
    // The new cells are all that is missing, unless the old ones alone had no solution.
    let solved = !info.exceeds_friction() && kept.p.iter().any(|&p| p > 0.0);
    let guess = if solved { kept } else { guess };
    let (now, mut found) = solver.solve(setup, &entered(setup, &motion), guess)?;
    found.add_work(&info);
    Ok((now, found))
}

/// All cells, of which those outside the last contact enter it after a motion \[m\].
fn entered<'a>(setup: &'a Setup<'_>, motion: &'a [Vec<f64>; 2]) -> Asked<'a> {
    Asked {
        h_init: &setup.geometry.h_init,
        share: ENTERED_SHARE,
        turns: true,
        entry: Some(motion),
    }
}

/// Solves with the contact kept to its old cells: the others are far apart.
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
    let asked = Asked {
        h_init: &apart,
        share: KEPT_SHARE,
        turns: false,
        entry: None,
    };
    solver.solve(setup, &asked, guess)
}

/// The first guess on the old cells alone: pressure as predicted, scaled to the load, shear as it was.
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
        let factor = normal.sums[0] / kept.p.iter().sum::<f64>();
        kept.p.iter_mut().for_each(|p| *p *= factor);
    }
    kept
}

/// What an increment with the contact kept to its old cells has done.
fn kept_contact(setup: &Setup<'_>, kept: &Interface, info: &AlternationInfo) -> KeptContact {
    let (geometry, mirror) = (setup.geometry, setup.problem.plan.mirror);
    let (last, arms) = (setup.last(), &geometry.arms);
    let approach = setup.state.approach(arms);
    let cells = 0..geometry.h_init.len();
    let gap = |u_z: &[f64], approach: [f64; 3], n: usize| {
        u_z[n] + geometry.h_init[n] - arms.across(approach, n)
    };
    let before = |n: usize| {
        let wider = setup.roll.gap_at(geometry, mirror, n);
        (gap(&last.u_z, approach, n) - wider).max(0.0)
    };
    let motion = |n: usize| {
        let at = |u: &[Vec<f64>; 2]| [u[0][n], u[1][n]];
        slip(at(&kept.u), at(&last.u), arms.in_plane(info.shift, n))
    };
    KeptContact {
        motion: [0, 1].map(|c| cells.clone().map(|n| motion(n)[c]).collect()),
        gap: cells.clone().map(before).collect(),
        closing: cells
            .map(|n| before(n) - gap(&kept.u_z, info.approach, n))
            .collect(),
        cells: Neighbours::new(&geometry.grid, mirror, REACH, setup.kernel),
        screened: Screened::new(&geometry.grid, setup.kernel),
        ordered: setup.problem.plan.methods.order_of_entry,
    }
}

/// Whether contact grows or rolls on in the increment and it matters how a cell moved before.
fn cells_enter(setup: &Setup<'_>) -> bool {
    let (plan, drives) = (&setup.problem.plan, &setup.drives);
    let Interface { p, q, .. } = &setup.state.interface;
    let grows = if drives.normal.free[0] {
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
