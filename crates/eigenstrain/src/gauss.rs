//! Gauss-Legendre quadrature.

use std::f64::consts::PI;

/// Nodes and weights on \[0, 1\]: Newton's iteration on the Legendre polynomial from Tricomi's
/// starting values.
pub(crate) fn rule(n: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut p, mut last) = (1.0, 0.0);
            for l in 0..n {
                let l = l as f64;
                (p, last) = (((2.0 * l + 1.0) * x * p - l * last) / (l + 1.0), p);
            }
            slope = n as f64 * (x * p - last) / (x * x - 1.0);
            x -= p / slope;
        }
        let weight = 2.0 / ((1.0 - x * x) * slope * slope);
        (0.5 * (1.0 - x), 0.5 * weight)
    };
    (0..n).map(node).collect()
}
