//! Gauss-Legendre quadrature.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Largest number of nodes of a rule that is cached.
const MOST_NODES: usize = 32;

static RULES: LazyLock<Vec<Vec<(f64, f64)>>> =
    LazyLock::new(|| (0..=MOST_NODES).map(rule).collect());

/// Nodes and weights on \[-1, 1\] of the n-point rule, 1 <= n <= 32.
///
/// # Panics
/// If n is larger.
pub fn gauss(n: usize) -> &'static [(f64, f64)] {
    &RULES[n]
}

/// The rule of any number of nodes: Newton's iteration on the Legendre polynomial from Tricomi's
/// starting values.
pub fn rule(n: usize) -> Vec<(f64, f64)> {
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
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

/// Nodes and weights of the `n`-point Gauss-Legendre rule on (a, b).
pub fn gauss_legendre(n: usize, a: f64, b: f64) -> Vec<(f64, f64)> {
    let (middle, half) = (f64::midpoint(a, b), (b - a) / 2.0);
    let place = |(x, w)| (middle + half * x, half * w);
    rule(n).into_iter().map(place).collect()
}

/// Integral of `f` over (a, b) by the `n`-point Gauss-Legendre rule.
pub fn integrate(n: usize, a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    gauss_legendre(n, a, b).iter().map(|&(x, w)| w * f(x)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_polynomials_up_to_their_order() {
        for n in 1..=MOST_NODES {
            for power in (0..2 * n).step_by(2) {
                let sum: f64 = gauss(n).iter().map(|(x, w)| w * x.powi(power as i32)).sum();
                let exact = 2.0 / (power as f64 + 1.0);
                assert!((sum - exact).abs() < 1e-14, "{n} {power} {sum} {exact}");
            }
        }
    }

    #[test]
    fn gauss_legendre_is_exact_for_polynomials_of_twice_its_order() {
        for n in [1, 2, 5, 16, 61] {
            let degree = 2 * n as i32 - 1;
            let integral = integrate(n, -1.0, 3.0, |x| x.powi(degree));
            let exact = (3f64.powi(degree + 1) - 1.0) / f64::from(degree + 1);
            assert!(
                (integral / exact - 1.0).abs() < 1e-12,
                "{n}: {integral} {exact}"
            );
        }
    }
}
