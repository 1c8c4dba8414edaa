//! The components of stresses on eight planes, as weighted sums.

#![allow(
    clippy::inline_always,
    reason = "sweeps are to be compiled for the processor that runs them"
)]

use crate::lanes::{Eight, LANES, Real};

/// Weighted sum of the components of a stress, on eight planes.
#[inline(always)]
pub(crate) fn weighted_sum<F: Real>(weights: &[Eight<F>; 6], s: &[F; 6]) -> Eight<F> {
    let mut sum = [F::near(0.0); LANES];
    for c in 0..6 {
        for l in 0..LANES {
            sum[l] = weights[c][l].mul_add(s[c], sum[l]);
        }
    }
    sum
}

/// Weights of n.S.n as a sum of the components.
#[inline(always)]
pub(crate) fn normal_weights<F: Real>([x, y, z]: &[Eight<F>; 3]) -> [Eight<F>; 6] {
    let two = F::near(2.0);
    let mut weights = [[F::near(0.0); LANES]; 6];
    for l in 0..LANES {
        weights[0][l] = x[l] * x[l];
        weights[1][l] = y[l] * y[l];
        weights[2][l] = z[l] * z[l];
        weights[3][l] = two * x[l] * y[l];
        weights[4][l] = two * x[l] * z[l];
        weights[5][l] = two * y[l] * z[l];
    }
    weights
}

/// Weights of u.S.n and v.S.n as sums of the components; u and v are unit vectors across n and each
/// other.
#[inline(always)]
pub(crate) fn shear_weights<F: Real>(n: &[Eight<F>; 3]) -> [[Eight<F>; 6]; 2] {
    let mut weights = [[[F::near(0.0); LANES]; 6]; 2];
    for l in 0..LANES {
        let n = [n[0][l], n[1][l], n[2][l]];
        for (weights, u) in weights.iter_mut().zip(perpendicular_axes(n)) {
            for c in 0..3 {
                weights[c][l] = u[c] * n[c];
            }
            for (c, i, j) in [(3, 0, 1), (4, 0, 2), (5, 1, 2)] {
                weights[c][l] = u[i] * n[j] + u[j] * n[i];
            }
        }
    }
    weights
}

/// Unit vectors across n and each other, without roots: T. Duff et al., J. Comput. Graph. Tech. 6
/// (2017) 1-8.
#[inline(always)]
fn perpendicular_axes<F: Real>([x, y, z]: [F; 3]) -> [[F; 3]; 2] {
    let [one, none] = [F::near(1.0), F::near(0.0)];
    let sign = if z < none { none - one } else { one };
    let a = none - F::near(1.0 / (sign + z).wide());
    let b = x * y * a;
    [
        [one + sign * x * x * a, sign * b, none - sign * x],
        [b, sign + y * y * a, none - y],
    ]
}
