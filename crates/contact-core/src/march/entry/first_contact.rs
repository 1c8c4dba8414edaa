//! Bodies that touch for the first time in an increment.
//!
//! They move rigidly before they do: the gap h_init closes by delta_z, a cell enters at
//! theta = h_init/delta_z of the increment, and its motion is -theta d(delta), which the solution has yet
//! to show.

use super::asked::entered;
use crate::error::Error;
use crate::march::setup::{Setup, Solution, Solver};
use crate::solvers::Interface;
use crate::solvers::intermediate::AlternationInfo;

/// Rounds that look for the shift of bodies that touch for the first time.
const ROUNDS: usize = 6;
/// Change of that shift that ends the search, over the shift or the approach, whichever is more.
const SETTLED: f64 = 1e-8;

/// Solves for the first contact: the shift s before the entry of the cells is that of the
/// solution. It depends on the s assumed almost linearly, so that two solutions give the third.
pub(super) fn solve_first_contact(
    setup: &Setup<'_>,
    solver: &mut Solver<'_>,
    guess: Interface,
) -> Result<Solution, Error> {
    let (h_init, arms) = (&setup.geometry.h_init, &setup.geometry.arms);
    let lowest = h_init.iter().copied().fold(f64::INFINITY, f64::min);
    let mut assumed = [0.0; 3];
    let mut last: Option<([f64; 3], [f64; 3])> = None;
    let mut work = AlternationInfo::default();
    let mut closed = f64::INFINITY;
    let mut guess = guess;
    let mut round = 0;
    loop {
        round += 1;
        let motion = [0, 1].map(|c| {
            let before_entry = |n: usize| {
                let theta = ((h_init[n] - lowest) / closed).clamp(0.0, 1.0);
                -theta * arms.in_plane(assumed, n)[c]
            };
            (0..h_init.len()).map(before_entry).collect()
        });
        let (now, mut info) = solver.solve(setup, &entered(setup, &motion), guess)?;
        info.add_work(&work);
        work = info;
        let misfit: [f64; 3] = std::array::from_fn(|k| info.shift[k] - assumed[k]);
        // By symmetry the shift may be nothing but rounding.
        let least = setup.problem.approach;
        let settled = size(misfit) <= SETTLED * size(info.shift).max(least);
        if settled || round == ROUNDS || info.exceeds_friction() {
            return Ok((now, info));
        }
        // Secant: the misfit falls by the part that the last change of s made of it.
        let next = match last {
            Some((before, misfit_before)) => {
                let ds: [f64; 3] = std::array::from_fn(|k| assumed[k] - before[k]);
                let df: [f64; 3] = std::array::from_fn(|k| misfit[k] - misfit_before[k]);
                let slope = dot(ds, df) / dot(ds, ds).max(f64::MIN_POSITIVE);
                let factor = if slope < 0.0 { -1.0 / slope } else { 1.0 };
                std::array::from_fn(|k| assumed[k] + factor * misfit[k])
            }
            None => info.shift,
        };
        last = Some((assumed, misfit));
        assumed = next;
        closed = info.approach[0] - lowest;
        guess = now;
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn size(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
