//! The limit of friction, and the sliding motion at the limit.
//!
//! Under full sliding with the motion m, cell n carries the shear g along B m. Loads F are within
//! the limit if F . m <= sum g |B m| for every m (the limit surface of S. Goyal, A. Ruina,
//! J. Papadopoulos, Wear 143 (1991) 307-330), so the part of the limit that they use is the
//! largest F . m / sum g |B m|.

use super::TangentialProblem;
use crate::cells::{add_vectors, inverse, product};
use crate::cells::{length, sum};

/// The loads over the limit of friction, and the direction of the sliding motion that they drive.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sliding {
    /// Loads over the limit; infinite where nothing bears a load.
    pub(crate) used: f64,
    /// Direction of the sliding motion, of any size.
    pub(crate) motion: [f64; 3],
}

/// Loads of at least 1 - FULL of the limit slide: the difference is rounding.
const FULL: f64 = 1e-11;
/// Loads above 1 + BEYOND times the limit have no equilibrium.
const BEYOND: f64 = 1e-9;

impl Sliding {
    /// Whether every cell slips.
    pub(crate) fn is_full(&self) -> bool {
        is_full(self.used)
    }
}

/// Whether loads that use this part of the limit slide.
pub(crate) fn is_full(used: f64) -> bool {
    used >= 1.0 - FULL
}

/// Whether friction cannot carry loads that use this part of its limit.
pub(crate) fn exceeds(used: f64) -> bool {
    used > 1.0 + BEYOND
}

/// Largest number of rounds in the search for the motion under a force and a moment.
const MOST_ROUNDS: usize = 200;

/// Computes the fraction of the limit that the loads of the free motions use.
pub(crate) fn compute_sliding(problem: &TangentialProblem<'_>) -> Sliding {
    let drive = &problem.drive;
    let F = drive.sums;
    if F.iter().all(|&F| F == 0.0) || problem.bound.contains(&f64::INFINITY) {
        return Sliding::default();
    }
    let carried = sum(problem.bound);
    if !(carried > 0.0) {
        return Sliding {
            used: f64::INFINITY,
            motion: F,
        };
    }
    if !drive.free[2] {
        // Without rotation all cells slide alike.
        let force = F[0].hypot(F[1]);
        return Sliding {
            used: force / carried,
            motion: [F[0] / force, F[1] / force, 0.0],
        };
    }
    // Fixed points of the weights g/|B m| climb to the largest ratio.
    let mut best = Sliding::default();
    let mut m = damped_motion(problem, |_| 1.0);
    for _ in 0..MOST_ROUNDS {
        let used = dot(F, m) / friction_power(problem, m);
        let has_converged = used <= best.used * (1.0 + 1e-14);
        if used > best.used {
            best = Sliding { used, motion: m };
        }
        if has_converged {
            break;
        }
        let slowest = 1e-12 * length([m[0], m[1]]).max(m[2].abs());
        m = damped_motion(problem, |n| {
            1.0 / length(problem.arms.displacement_in_plane(m, n)).max(slowest)
        });
    }
    best
}

/// The motion driven by the loads where each cell resists like a damper of g times `weight`.
fn damped_motion(problem: &TangentialProblem<'_>, weight: impl Fn(usize) -> f64) -> [f64; 3] {
    let mut gram = [[0.0; 3]; 3];
    for n in (0..problem.bound.len()).filter(|&n| problem.bound[n] > 0.0) {
        let w = problem.bound[n] * weight(n);
        let (x, y) = (problem.arms.turn_arm_x(n), problem.arms.y[n]);
        let rows = [[1.0, 0.0, -y], [0.0, 1.0, x], [-y, x, x * x + y * y]];
        for k in 0..3 {
            gram[k] = add_vectors(gram[k], rows[k].map(|r| w * r));
        }
    }
    product(&inverse(gram, problem.drive.free), problem.drive.sums)
}

/// sum of g |B m|
fn friction_power(problem: &TangentialProblem<'_>, m: [f64; 3]) -> f64 {
    (0..problem.bound.len())
        .map(|n| problem.bound[n] * length(problem.arms.displacement_in_plane(m, n)))
        .sum()
}

/// a . b
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}
