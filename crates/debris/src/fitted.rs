//! The five-point scheme fitted to waves that decay with the length lambda.
//!
//! With u = h/lambda, h being the size of a cell along an axis, and a border at theta h from the centre:
//!
//! ```text
//! g(theta) = u^2/(4 sinh^2(u/2)) sinh(u)/sinh(theta u)    conductance of a side, over 1/h^2
//! V = [tanh(theta_1 u/2) + tanh(theta_2 u/2)]/(2 tanh(u/2))   part of the cell that reacts
//! ```
//!
//! A closed side has theta = 1. Then exp(+-x/lambda) solves `g_1 (P_1 - P) + g_2 (P_2 - P) = u^2 V P`
//! exactly (J. J. H. Miller, E. O'Riordan, G. I. Shishkin, Fitted Numerical Methods for Singular Perturbation
//! Problems (1996)). The limits for small u are 1/theta and (theta_1 + theta_2)/2.

use super::region::{Region, Side};

/// u below which the limits hold to rounding.
const SMALL: f64 = 1e-7;

/// Conductance of a side at the distance theta, over 1/h^2.
pub(crate) fn conductance(u: f64, theta: f64) -> f64 {
    if u < SMALL {
        return 1.0 / theta;
    }
    let complement = |x: f64| -(-x).exp_m1();
    u * u * (-theta * u).exp() * complement(2.0 * u)
        / (complement(u).powi(2) * complement(2.0 * theta * u))
}

/// The part of a closed cell that reacts; `u` of both axes. Along an axis without a border it is the
/// whole cell. With borders along both axes they are weighted by the normal of the border, n ~ 1/theta.
pub(crate) fn reacting_part(sides: &[Side], u: [f64; 2]) -> f64 {
    let (mut sum, mut weight) = (0.0, 0.0);
    for axis in 0..2 {
        let thetas = [0, 1].map(|k| match sides[2 * axis + k] {
            Side::Border(theta) => theta,
            Side::Closed(_) | Side::Sealed => 1.0,
        });
        let nearest = thetas[0].min(thetas[1]);
        let is_cut = |side: &Side| matches!(side, Side::Border(_));
        if !sides[2 * axis..2 * axis + 2].iter().any(is_cut) {
            continue;
        }
        let half = |theta: f64| {
            if u[axis] < SMALL {
                theta
            } else {
                (0.5 * theta * u[axis]).tanh() / (0.5 * u[axis]).tanh()
            }
        };
        let n = 1.0 / (nearest * nearest);
        sum += n * 0.5 * (half(thetas[0]) + half(thetas[1]));
        weight += n;
    }
    if weight > 0.0 { sum / weight } else { 1.0 }
}

/// Size of a cell along both axes over lambda.
pub(crate) fn sizes(region: &Region, lambda_squared: f64) -> [f64; 2] {
    [0, 2].map(|side| (1.0 / (lambda_squared * region.inverse_square(side))).sqrt())
}
