//! Gauss-Legendre quadrature and a bracketed root, for the closed forms that end in one.

use crate::gauss::rule;

/// Nodes and weights of the `n`-point Gauss-Legendre rule on (a, b).
pub(crate) fn gauss_legendre(n: usize, a: f64, b: f64) -> Vec<(f64, f64)> {
    let (middle, half) = (f64::midpoint(a, b), (b - a) / 2.0);
    let place = |(x, w)| (middle + half * x, half * w);
    rule(n).into_iter().map(place).collect()
}

/// Integral of `f` over (a, b) by the `n`-point Gauss-Legendre rule.
pub(crate) fn integrate(n: usize, a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    gauss_legendre(n, a, b).iter().map(|&(x, w)| w * f(x)).sum()
}

/// The root of an `f` that rises through zero on (a, b), to round-off: bisection, which cannot
/// fail. The bound of its side where `f` has only one sign.
pub(crate) fn bisect(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = f64::midpoint(a, b);
        if middle <= a || middle >= b {
            return middle;
        }
        if f(middle) > 0.0 {
            b = middle;
        } else {
            a = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn bisection_finds_the_root_or_the_bound() {
        assert!((bisect(0.0, 2.0, |x| x * x - 2.0) - 2f64.sqrt()).abs() < 1e-15);
        assert!((bisect(0.0, 2.0, |x| x - 2.0) - 2.0).abs() < 1e-15);
    }
}
