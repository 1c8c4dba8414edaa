//! The shear that friction admits: |q| <= g in each cell, and the sum that the force asks for.

use super::shear::TangentialProblem;
use super::vector::{size, sum};

/// Rounds of clipping and balancing before the stick cells are taken to be too few.
const ROUNDS: usize = 8;

/// Makes the shear admissible without asking for its response: slip cells and cells beyond the
/// bound go to the circle |q| = g, cells outside the contact to zero, and stick cells share the
/// force that is missing. Where they cannot carry it, the nearest admissible shear is taken.
///
/// The change of q goes to `change`; returns the root of its sum of squares \[Pa\].
pub(crate) fn admissible(
    problem: &TangentialProblem<'_>,
    q: &mut [&mut [f64]; 2],
    slip: &mut [bool],
    change: &mut [Vec<f64>; 2],
) -> f64 {
    for c in 0..2 {
        change[c].copy_from_slice(q[c]);
    }
    if !share_force(problem, q, slip) {
        project(problem, q, &mut [0.0; 2]);
        mark_circle(problem, q, slip);
    }
    let mut squares = 0.0;
    for c in 0..2 {
        for (change, q) in change[c].iter_mut().zip(q[c].iter()) {
            *change = q - *change;
            squares += *change * *change;
        }
    }
    squares.sqrt()
}

/// Cuts the shear to the bound and lets the stick cells share the missing force; whether that
/// ended with both conditions met.
fn share_force(
    problem: &TangentialProblem<'_>,
    q: &mut [&mut [f64]; 2],
    slip: &mut [bool],
) -> bool {
    let cells = problem.bound.len();
    let enough = 1e-13 * sum(problem.bound);
    for _ in 0..ROUNDS {
        let mut missing = problem.sum_q;
        let mut sticking = 0;
        for n in 0..cells {
            let g = problem.bound[n];
            let size = size([q[0][n], q[1][n]]);
            let factor = if g <= 0.0 {
                0.0
            } else if size > g || (slip[n] && size > 0.0) {
                g / size
            } else {
                1.0
            };
            slip[n] &= g > 0.0 && size > 0.0;
            sticking += usize::from(g > 0.0 && !slip[n]);
            for c in 0..2 {
                q[c][n] *= factor;
                missing[c] -= q[c][n];
            }
        }
        if (0..2).all(|c| !problem.free[c] || missing[c].abs() <= enough) {
            return true;
        }
        for n in (0..cells).filter(|&n| problem.bound[n] > 0.0 && !slip[n]) {
            for c in (0..2).filter(|&c| problem.free[c]) {
                q[c][n] += missing[c] / sticking as f64;
            }
        }
    }
    false
}

/// The part of the bound from which a cell counts as slipping.
const ON_CIRCLE: f64 = 1.0 - 1e-9;

/// Slip cells are those on the circle.
pub(crate) fn mark_circle(problem: &TangentialProblem<'_>, q: &[&mut [f64]; 2], slip: &mut [bool]) {
    for n in 0..problem.bound.len() {
        let g = problem.bound[n];
        slip[n] = g > 0.0 && size([q[0][n], q[1][n]]) >= ON_CIRCLE * g;
    }
}

/// Nearest shear with |q| <= g in each cell and the sum asked for: q - shift, cut to the circle.
///
/// The shift is the root of a monotone function: Newton steps, halved until the excess falls; where
/// none does, a step with the weights min(1, g/|q - shift|) of Weiszfeld, which cannot overshoot.
pub(crate) fn project(
    problem: &TangentialProblem<'_>,
    q: &mut [&mut [f64]; 2],
    shift: &mut [f64; 2],
) {
    let enough = 1e-13 * sum(problem.bound);
    let mut trial = *shift;
    let mut here = excess(problem, q, trial);
    for _ in 0..100 {
        if size(here.sum) <= enough {
            break;
        }
        (trial, here) = newton(problem, q, trial, &here).unwrap_or_else(|| {
            let weighted: [f64; 2] = std::array::from_fn(|c| trial[c] + here.sum[c] / here.weight);
            (weighted, excess(problem, q, weighted))
        });
    }
    *shift = trial;
    for n in 0..problem.bound.len() {
        let v = [q[0][n] - trial[0], q[1][n] - trial[1]];
        let factor = problem.bound[n] / size(v).max(problem.bound[n]).max(f64::MIN_POSITIVE);
        q[0][n] = factor * v[0];
        q[1][n] = factor * v[1];
    }
}

/// A Newton step of the shift that lowers the excess, if there is one.
fn newton(
    problem: &TangentialProblem<'_>,
    q: &[&mut [f64]; 2],
    at: [f64; 2],
    here: &Excess,
) -> Option<([f64; 2], Excess)> {
    let [xx, xy, yy] = here.slope;
    let det = xx * yy - xy * xy;
    if det <= 0.0 {
        return None;
    }
    let step = [
        (yy * here.sum[0] - xy * here.sum[1]) / det,
        (xx * here.sum[1] - xy * here.sum[0]) / det,
    ];
    (0..12)
        .map(|halvings| 0.5_f64.powi(halvings))
        .find_map(|part| {
            let to = [at[0] + part * step[0], at[1] + part * step[1]];
            let there = excess(problem, q, to);
            (size(there.sum) < (1.0 - 0.1 * part) * size(here.sum)).then_some((to, there))
        })
}

/// The sum of the cut shear over the sum asked for, as a function of the shift.
struct Excess {
    sum: [f64; 2],
    /// Minus the derivative by the shift: xx, xy, yy.
    slope: [f64; 3],
    /// Sum of the factors by which cells are cut.
    weight: f64,
}

fn excess(problem: &TangentialProblem<'_>, q: &[&mut [f64]; 2], shift: [f64; 2]) -> Excess {
    let mut sum = [-problem.sum_q[0], -problem.sum_q[1]];
    let mut slope = [0.0; 3];
    let mut weight = 0.0;
    for n in 0..problem.bound.len() {
        let g = problem.bound[n];
        if g <= 0.0 {
            continue;
        }
        let v = [q[0][n] - shift[0], q[1][n] - shift[1]];
        let length = size(v);
        let cut = if length > g { g / length } else { 1.0 };
        sum[0] += cut * v[0];
        sum[1] += cut * v[1];
        weight += cut;
        // Cells beyond the circle give way only across their direction.
        let e = if length > g {
            [v[0] / length, v[1] / length]
        } else {
            [0.0, 0.0]
        };
        slope[0] += cut * (1.0 - e[0] * e[0]);
        slope[1] -= cut * e[0] * e[1];
        slope[2] += cut * (1.0 - e[1] * e[1]);
    }
    for c in 0..2 {
        if !problem.free[c] {
            sum[c] = 0.0;
            slope[1] = 0.0;
            slope[2 * c] = 1.0;
        }
    }
    Excess { sum, slope, weight }
}
