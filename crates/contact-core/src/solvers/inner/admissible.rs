//! Admissible shear: |q| <= g in each cell, with the sums that balance the loads.

use super::TangentialProblem;
use crate::cells::{add_vectors, inverse, product};
use crate::cells::{length, set_cells};
use crate::cells::{set_fields, sums, sweep};
use crate::solvers::Shear;

/// Most rounds of clipping and balancing; after them the stick cells are taken to be too few for
/// the missing force.
const MOST_ROUNDS: usize = 8;

/// Makes the shear admissible without a convolution: slip cells and cells beyond the bound are set
/// on the circle |q| = g, cells outside the contact to zero, and stick cells share the missing
/// force. Where they cannot carry it, one more cell is made to stick, chosen by its slip under the
/// rigid motion `shift` \[m\]. If this fails, the nearest admissible shear is taken.
pub(crate) fn make_admissible(
    problem: &TangentialProblem<'_>,
    shear: &mut Shear<'_>,
    shift: [f64; 3],
) {
    if share_force(problem, &mut shear.q, shear.slips) {
        return;
    }
    if hold_one_cell(problem, shear, shift) && share_force(problem, &mut shear.q, shear.slips) {
        return;
    }
    project_to_admissible(problem, &mut shear.q, &mut [0.0; 3]);
    mark_circle(problem, &shear.q, shear.slips);
}

/// Where every cell slips, no cell can take up the difference between the sum of the bounds and the
/// given force. The stick zone is then narrower than a cell: of the cells whose shear that
/// difference reduces, the one with the least slip is made to stick. Returns whether there is one.
fn hold_one_cell(problem: &TangentialProblem<'_>, shear: &mut Shear<'_>, shift: [f64; 3]) -> bool {
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
    let excess_force = missing_loads(problem, [x, y, 0.0]).map(|m| -m);
    // No difference to take up: which of two mirror images were made to stick would be decided by
    // rounding, and with it the shift.
    if excess_force[0].hypot(excess_force[1]) <= rounding_of_sums(problem) {
        return false;
    }
    let slowest = (0..slips.len())
        .filter(|&n| q[0][n] * excess_force[0] + q[1][n] * excess_force[1] > 0.0)
        .map(|n| (n, length(problem.slip(u, shift, n))))
        .min_by(|(_, a), (_, b)| a.total_cmp(b));
    if let Some((n, _)) = slowest {
        slips[n] = false;
    }
    slowest.is_some()
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
    let tolerance = rounding_of_sums(problem);
    let mut motion = [0.0; 3];
    // The new shear of a cell, and one where it sticks.
    let cut_to_bound = |g: f64, slips: bool, shared: [f64; 2], q: [f64; 2]| {
        let added = if slips { [0.0; 2] } else { shared };
        let q = [q[0] + added[0], q[1] + added[1]];
        let square = q[0] * q[0] + q[1] * q[1];
        let on_circle = slips || square > g * g;
        let factor = if on_circle { g / square.sqrt() } else { 1.0 };
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
                let (q, sticks) = cut_to_bound(g, slips, arms.displacement_in_plane(motion, n), q);
                let x = arms.axis_ratio * x;
                let moment = x * q[1] - y * q[0];
                let (x, y, r2) = (sticks * x, sticks * y, sticks * (x * x + y * y));
                (q, [q[0], q[1], moment, sticks, x, y, r2])
            })
        } else {
            let [a, b, count] = sweep(from, [q_x, q_y], |_, ([g], slips), q| {
                let (q, sticks) = cut_to_bound(g, slips, [motion[0], motion[1]], q);
                (q, [q[0], q[1], sticks])
            });
            [a, b, 0.0, count, 0.0, 0.0, 0.0]
        };
        let [a, b, moment, count, x, y, r2] = sums;
        let missing_loads = missing_loads(problem, [a, b, moment]);
        if missing_loads.iter().all(|m| m.abs() <= tolerance) {
            return true;
        }
        if count == 0.0 {
            return false;
        }
        let gram = [[count, 0.0, -y], [0.0, count, x], [-y, x, r2]];
        motion = product(&inverse(gram, problem.drive.free), missing_loads);
    }
    false
}

/// Prescribed loads minus the sums of the shear; zero for prescribed motions.
fn missing_loads(problem: &TangentialProblem<'_>, sums: [f64; 3]) -> [f64; 3] {
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
fn mode_products(x: f64, y: f64, [xx, xy, yy]: [f64; 3]) -> [f64; 6] {
    let r = [xy * x - xx * y, yy * x - xy * y];
    [xx, xy, yy, r[0], r[1], x * r[1] - y * r[0]]
}

/// Rounding error of the sums: a fixed part of the sum of the bounds, or of the loads where a bound
/// is infinite.
pub(crate) fn rounding_of_sums(problem: &TangentialProblem<'_>) -> f64 {
    let finite = |g: f64| if g.is_finite() { g } else { 0.0 };
    let [carried] = sums([problem.bound], |_, [g]| [finite(g)]);
    let prescribed = problem.drive.sums.iter().map(|s| s.abs()).sum::<f64>();
    1e-13 * carried.max(prescribed)
}

/// Fraction of the bound from which on a cell counts as slipping.
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
            length([q[0][n], q[1][n]]) >= ON_CIRCLE * g
        } else {
            slips
        }
    });
}

/// Projects the shear to the nearest one with |q| <= g in each cell and the prescribed sums: q - B shift, cut to the circle.
///
/// The shift is the root of a monotone function: Newton steps, halved until the excess falls; where
/// none does, a step with the weights min(1, g/|q - B shift|) of Weiszfeld, which cannot overshoot.
pub(crate) fn project_to_admissible(
    problem: &TangentialProblem<'_>,
    q: &mut [&mut [f64]; 2],
    shift: &mut [f64; 3],
) {
    let tolerance = rounding_of_sums(problem);
    let mut trial = *shift;
    let mut current = excess(problem, q, trial);
    for _ in 0..100 {
        if norm(current.sums) <= tolerance {
            break;
        }
        (trial, current) = newton_step_of_shift(problem, q, trial, &current).unwrap_or_else(|| {
            let weights = inverse(current.weights, problem.drive.free);
            let next = add_vectors(trial, product(&weights, current.sums));
            (next, excess(problem, q, next))
        });
    }
    *shift = trial;
    let [q_x, q_y] = q;
    set_fields([problem.bound], [q_x, q_y], |n, [g], q| {
        let v = shifted_shear(problem, q, trial, n);
        let factor = cut_factor(length(v), g);
        [factor * v[0], factor * v[1]]
    });
}

/// q - B shift in cell n.
fn shifted_shear(
    problem: &TangentialProblem<'_>,
    q: [f64; 2],
    shift: [f64; 3],
    n: usize,
) -> [f64; 2] {
    let shift = problem.arms.displacement_in_plane(shift, n);
    [q[0] - shift[0], q[1] - shift[1]]
}

/// Factor that brings a traction of this size to the bound.
fn cut_factor(size: f64, bound: f64) -> f64 {
    if size > bound { bound / size } else { 1.0 }
}

/// Length of a vector.
fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// A Newton step of the shift that lowers the excess, if there is one.
fn newton_step_of_shift(
    problem: &TangentialProblem<'_>,
    q: &[&mut [f64]; 2],
    shift: [f64; 3],
    current: &Excess,
) -> Option<([f64; 3], Excess)> {
    let step = product(&inverse(current.slope, problem.drive.free), current.sums);
    (0..12)
        .map(|halvings| 0.5_f64.powi(halvings))
        .find_map(|fraction| {
            let trial = add_vectors(shift, step.map(|s| fraction * s));
            let trial_excess = excess(problem, q, trial);
            (norm(trial_excess.sums) < (1.0 - 0.1 * fraction) * norm(current.sums))
                .then_some((trial, trial_excess))
        })
}

/// Sums of the cut shear minus the prescribed sums, as a function of the shift.
struct Excess {
    sums: [f64; 3],
    /// Minus the derivative by the shift.
    slope: [[f64; 3]; 3],
    /// The modes weighted with the factors by which cells are cut.
    weights: [[f64; 3]; 3],
}

/// How far the shear cut to its bound, after a rigid motion `shift`, misses the loads, and the derivative of
/// that by the shift.
fn excess(problem: &TangentialProblem<'_>, q: &[&mut [f64]; 2], shift: [f64; 3]) -> Excess {
    let [q_x, q_y] = q;
    let sums = sums([problem.bound, q_x, q_y], |n, [g, q_x, q_y]| {
        if g <= 0.0 {
            return [0.0; 15];
        }
        let v = shifted_shear(problem, [q_x, q_y], shift, n);
        let length = length(v);
        let cut_factor = cut_factor(length, g);
        // The derivative of a cell on the circle acts only across its direction.
        let e = if length > g {
            [v[0] / length, v[1] / length]
        } else {
            [0.0, 0.0]
        };
        let across_direction = [1.0 - e[0] * e[0], -e[0] * e[1], 1.0 - e[1] * e[1]];
        let (x, y) = (problem.arms.turn_arm_x(n), problem.arms.y[n]);
        let [a, b, c] = problem.arms.loads_in_plane(v.map(|v| cut_factor * v), n);
        let [d, e, f, g, h, i] = mode_products(x, y, across_direction.map(|a| cut_factor * a));
        let [j, k, l, m, n, o] = mode_products(x, y, [cut_factor, 0.0, cut_factor]);
        [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o]
    });
    let [a, b, c, matrices @ ..] = sums;
    let symmetric_matrix = |from: usize| {
        let [xx, xy, yy, xr, yr, rr] = std::array::from_fn(|i| matrices[from + i]);
        [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]]
    };
    Excess {
        sums: missing_loads(problem, [a, b, c]).map(|m| -m),
        slope: symmetric_matrix(0),
        weights: symmetric_matrix(6),
    }
}
