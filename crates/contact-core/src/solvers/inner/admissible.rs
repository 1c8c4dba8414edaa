//! The shear that friction admits: |q| <= g in each cell, and the sums that the loads ask for.

use super::TangentialProblem;
use crate::cells::{add, inverse, product};
use crate::cells::{set, sums, sweep};
use crate::cells::{set_cells, size};
use crate::solvers::Shear;

/// Most rounds of clipping and balancing; after them the stick cells are taken to be too few for
/// the missing force.
const MOST_ROUNDS: usize = 8;

/// Makes the shear admissible without a convolution: slip cells and cells beyond the bound are set
/// on the circle |q| = g, cells outside the contact to zero, and stick cells share the missing
/// force. Where they cannot carry it, one more cell is made to stick, chosen by its slip under the
/// rigid motion `shift` \[m\]; failing that, the nearest admissible shear is taken.
pub(crate) fn admissible(problem: &TangentialProblem<'_>, shear: &mut Shear<'_>, shift: [f64; 3]) {
    if share_force(problem, &mut shear.q, shear.slips) {
        return;
    }
    if hold_one(problem, shear, shift) && share_force(problem, &mut shear.q, shear.slips) {
        return;
    }
    project(problem, &mut shear.q, &mut [0.0; 3]);
    mark_circle(problem, &shear.q, shear.slips);
}

/// Where every cell slips, no cell can take up the difference between the sum of the bounds and the
/// given force. The stick zone is then narrower than a cell: of the cells whose shear that
/// difference reduces, the one with the least slip is made to stick. Returns whether there is one.
fn hold_one(problem: &TangentialProblem<'_>, shear: &mut Shear<'_>, shift: [f64; 3]) -> bool {
    let [free_x, free_y, _] = problem.drive.free;
    if !(free_x || free_y) {
        return false;
    }
    mark_circle(problem, &shear.q, shear.slips);
    let Shear { q, u, slips, .. } = shear;
    if (0..slips.len()).any(|n| problem.bound[n] > 0.0 && !slips[n]) {
        return false;
    }
    let [x, y] = sums([&*q[0], &*q[1]], |_, q| q);
    let rest = missing(problem, [x, y, 0.0]).map(|m| -m);
    // No difference to take up: which of two mirror images were made to stick would be decided by
    // rounding, and with it the shift.
    if rest[0].hypot(rest[1]) <= rounding(problem) {
        return false;
    }
    let least = (0..slips.len())
        .filter(|&n| q[0][n] * rest[0] + q[1][n] * rest[1] > 0.0)
        .map(|n| (n, size(problem.slip(u, shift, n))))
        .min_by(|(_, a), (_, b)| a.total_cmp(b));
    if let Some((n, _)) = least {
        slips[n] = false;
    }
    least.is_some()
}

/// Cuts the shear to the bound and distributes the missing loads over the stick cells by the
/// smallest change; returns whether both conditions are met. Cells with a bound of zero carry
/// nothing and keep their slip flag; cells without shear do not slip.
fn share_force(
    problem: &TangentialProblem<'_>,
    q: &mut [&mut [f64]; 2],
    slips: &mut [bool],
) -> bool {
    let (bound, arms) = (problem.bound, problem.arms);
    set_cells(slips, |n, slips| {
        slips && (bound[n] <= 0.0 || q[0][n] * q[0][n] + q[1][n] * q[1][n] > 0.0)
    });
    let enough = rounding(problem);
    let mut share = [0.0; 3];
    // The new shear of a cell, and one where it sticks.
    let cut = |g: f64, slips: bool, shared: [f64; 2], q: [f64; 2]| {
        let given = if slips { [0.0; 2] } else { shared };
        let q = [q[0] + given[0], q[1] + given[1]];
        let square = q[0] * q[0] + q[1] * q[1];
        let beyond = slips || square > g * g;
        let factor = if beyond { g / square.sqrt() } else { 1.0 };
        let inside = g > 0.0;
        let q = q.map(|q| if inside { factor * q } else { 0.0 });
        (q, f64::from(u8::from(inside && !slips)))
    };
    for _ in 0..MOST_ROUNDS {
        let [q_x, q_y] = q;
        let from = ([bound], &*slips);
        let sums = if problem.drive.free[2] {
            let from = (from, [&arms.x[..], &arms.y]);
            sweep(from, [q_x, q_y], |n, (([g], slips), [x, y]), q| {
                let (q, sticks) = cut(g, slips, arms.in_plane(share, n), q);
                let x = arms.stretch * x;
                let moment = x * q[1] - y * q[0];
                let (x, y, r2) = (sticks * x, sticks * y, sticks * (x * x + y * y));
                (q, [q[0], q[1], moment, sticks, x, y, r2])
            })
        } else {
            let [a, b, count] = sweep(from, [q_x, q_y], |_, ([g], slips), q| {
                let (q, sticks) = cut(g, slips, [share[0], share[1]], q);
                (q, [q[0], q[1], sticks])
            });
            [a, b, 0.0, count, 0.0, 0.0, 0.0]
        };
        let [a, b, moment, count, x, y, r2] = sums;
        let missing = missing(problem, [a, b, moment]);
        if missing.iter().all(|m| m.abs() <= enough) {
            return true;
        }
        if count == 0.0 {
            return false;
        }
        let gram = [[count, 0.0, -y], [0.0, count, x], [-y, x, r2]];
        share = product(&inverse(gram, problem.drive.free), missing);
    }
    false
}

/// Given loads less the sums of the shear; zero for motions that are given.
fn missing(problem: &TangentialProblem<'_>, sums: [f64; 3]) -> [f64; 3] {
    let drive = &problem.drive;
    std::array::from_fn(|k| {
        if drive.free[k] {
            drive.sums[k] - sums[k]
        } else {
            0.0
        }
    })
}

/// b^T S b for the modes b of a cell at (x, y), S the symmetric matrix (xx, xy, yy): its entries
/// xx, xy, yy, xr, yr, rr.
fn modes(x: f64, y: f64, [xx, xy, yy]: [f64; 3]) -> [f64; 6] {
    let r = [xy * x - xx * y, yy * x - xy * y];
    [xx, xy, yy, r[0], r[1], x * r[1] - y * r[0]]
}

/// Rounding error of the sums: a fixed part of the sum of the bounds, or of the loads where a bound
/// is infinite.
pub(crate) fn rounding(problem: &TangentialProblem<'_>) -> f64 {
    let finite = |g: f64| if g.is_finite() { g } else { 0.0 };
    let [carried] = sums([problem.bound], |_, [g]| [finite(g)]);
    let prescribed = problem.drive.sums.iter().map(|s| s.abs()).sum::<f64>();
    1e-13 * carried.max(prescribed)
}

/// The part of the bound from which a cell counts as slipping.
const ON_CIRCLE: f64 = 1.0 - 1e-9;

/// Marks the cells on the circle |q| = g as slipping; cells with g = 0 keep their flag.
pub(crate) fn mark_circle(
    problem: &TangentialProblem<'_>,
    q: &[&mut [f64]; 2],
    slips: &mut [bool],
) {
    set_cells(slips, |n, slips| {
        let g = problem.bound[n];
        if g > 0.0 {
            size([q[0][n], q[1][n]]) >= ON_CIRCLE * g
        } else {
            slips
        }
    });
}

/// Nearest shear with |q| <= g in each cell and the sums asked for: q - B shift, cut to the circle.
///
/// The shift is the root of a monotone function: Newton steps, halved until the excess falls; where
/// none does, a step with the weights min(1, g/|q - B shift|) of Weiszfeld, which cannot overshoot.
pub(crate) fn project(
    problem: &TangentialProblem<'_>,
    q: &mut [&mut [f64]; 2],
    shift: &mut [f64; 3],
) {
    let enough = rounding(problem);
    let mut trial = *shift;
    let mut here = excess(problem, q, trial);
    for _ in 0..100 {
        if norm(here.sums) <= enough {
            break;
        }
        (trial, here) = newton(problem, q, trial, &here).unwrap_or_else(|| {
            let weights = inverse(here.weights, problem.drive.free);
            let weighted = add(trial, product(&weights, here.sums));
            (weighted, excess(problem, q, weighted))
        });
    }
    *shift = trial;
    let [q_x, q_y] = q;
    set([problem.bound], [q_x, q_y], |n, [g], q| {
        let v = cut_from(problem, q, trial, n);
        let factor = cut(size(v), g);
        [factor * v[0], factor * v[1]]
    });
}

/// q - B shift in cell n.
fn cut_from(problem: &TangentialProblem<'_>, q: [f64; 2], shift: [f64; 3], n: usize) -> [f64; 2] {
    let shift = problem.arms.in_plane(shift, n);
    [q[0] - shift[0], q[1] - shift[1]]
}

/// The factor that brings a traction of this size within the bound.
fn cut(size: f64, bound: f64) -> f64 {
    if size > bound { bound / size } else { 1.0 }
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// A Newton step of the shift that lowers the excess, if there is one.
fn newton(
    problem: &TangentialProblem<'_>,
    q: &[&mut [f64]; 2],
    at: [f64; 3],
    here: &Excess,
) -> Option<([f64; 3], Excess)> {
    let step = product(&inverse(here.slope, problem.drive.free), here.sums);
    (0..12)
        .map(|halvings| 0.5_f64.powi(halvings))
        .find_map(|part| {
            let to = add(at, step.map(|s| part * s));
            let there = excess(problem, q, to);
            (norm(there.sums) < (1.0 - 0.1 * part) * norm(here.sums)).then_some((to, there))
        })
}

/// The sums of the cut shear over those asked for, as a function of the shift.
struct Excess {
    sums: [f64; 3],
    /// Minus the derivative by the shift.
    slope: [[f64; 3]; 3],
    /// The modes weighted with the factors by which cells are cut.
    weights: [[f64; 3]; 3],
}

fn excess(problem: &TangentialProblem<'_>, q: &[&mut [f64]; 2], shift: [f64; 3]) -> Excess {
    let [q_x, q_y] = q;
    let sums = sums([problem.bound, q_x, q_y], |n, [g, q_x, q_y]| {
        if g <= 0.0 {
            return [0.0; 15];
        }
        let v = cut_from(problem, [q_x, q_y], shift, n);
        let length = size(v);
        let cut = cut(length, g);
        // The derivative of a cell on the circle acts only across its direction.
        let e = if length > g {
            [v[0] / length, v[1] / length]
        } else {
            [0.0, 0.0]
        };
        let across = [1.0 - e[0] * e[0], -e[0] * e[1], 1.0 - e[1] * e[1]];
        let (x, y) = (problem.arms.turn_x(n), problem.arms.y[n]);
        let [a, b, c] = problem.arms.sums_in_plane(v.map(|v| cut * v), n);
        let [d, e, f, g, h, i] = modes(x, y, across.map(|a| cut * a));
        let [j, k, l, m, n, o] = modes(x, y, [cut, 0.0, cut]);
        [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o]
    });
    let [a, b, c, matrices @ ..] = sums;
    let symmetric = |from: usize| {
        let [xx, xy, yy, xr, yr, rr] = std::array::from_fn(|i| matrices[from + i]);
        [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]]
    };
    Excess {
        sums: missing(problem, [a, b, c]).map(|m| -m),
        slope: symmetric(0),
        weights: symmetric(6),
    }
}
