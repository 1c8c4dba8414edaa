//! Bodies that touch for the first time in an increment.
//!
//! They move rigidly before they touch: the gap h of a cell, h_init under the tilt of the increment's
//! end, closes by delta_z. The cell enters at the part theta = h/delta_z of the increment, and its
//! motion before entry is -theta d(delta). The shift d(delta) is part of the solution, so that the
//! equations are solved repeatedly.

use super::equations::entered;
use crate::error::Error;
use crate::march::setup::{Setup, Solution, Solver};
use crate::solvers::Interface;
use crate::solvers::intermediate::AlternationInfo;

/// Most iterations for the shift.
const MOST_ITERATIONS: usize = 6;
/// Change of the shift that ends the iteration, over the larger of shift and approach.
const LEAST_CHANGE: f64 = 1e-8;

/// Solves for the first contact: finds the shift s with s = S(s), S being the shift of the solution
/// with the entry motion of an assumed s. S is almost linear, so that a secant step from two
/// solutions nearly always suffices.
pub(super) fn solve_first_contact(
    setup: &Setup<'_>,
    solver: &mut Solver<'_>,
    guess: Interface,
) -> Result<Solution, Error> {
    let (h_init, arms) = (&setup.geometry.h_init, &setup.geometry.arms);
    let mut assumed = [0.0; 3];
    let [_, phi_x, phi_y] = setup.drives.normal.given;
    let mut tilt = [0.0, phi_x, phi_y];
    let mut last: Option<([f64; 3], [f64; 3])> = None;
    let mut work = AlternationInfo::default();
    let mut closed = f64::INFINITY;
    let mut guess = guess;
    let mut round = 0;
    loop {
        round += 1;
        let gap = |n: usize| h_init[n] - arms.displacement_across(tilt, n);
        let lowest = (0..h_init.len()).map(gap).fold(f64::INFINITY, f64::min);
        let motion = [0, 1].map(|c| {
            let before_entry = |n: usize| {
                let theta = ((gap(n) - lowest) / closed).clamp(0.0, 1.0);
                -theta * arms.displacement_in_plane(assumed, n)[c]
            };
            (0..h_init.len()).map(before_entry).collect()
        });
        let (now, mut info) = solver.solve(setup, &entered(setup, &motion), guess)?;
        info.add_work(&work);
        work = info;
        let misfit: [f64; 3] = std::array::from_fn(|k| info.shift[k] - assumed[k]);
        // By symmetry the shift may vanish: then the approach is the scale.
        let least = setup.problem.approach;
        let settled = size(misfit) <= LEAST_CHANGE * size(info.shift).max(least);
        if settled || round == MOST_ITERATIONS || info.exceeds_friction() {
            return Ok((now, info));
        }
        // Secant step along the last change of s.
        let new_value = match last {
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
        assumed = new_value;
        tilt = [0.0, info.approach[1], info.approach[2]];
        let gap = |n: usize| h_init[n] - arms.displacement_across(tilt, n);
        closed = info.approach[0] - (0..h_init.len()).map(gap).fold(f64::INFINITY, f64::min);
        guess = now;
    }
}

/// a . b
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

/// Length of a vector.
fn size(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
