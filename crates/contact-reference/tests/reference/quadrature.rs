//! Quadrature that shares no code with the crate: double exponential, and polar about a point.

use std::f64::consts::PI;

/// Integral of `f` over (a, b); end singularities are allowed (double-exponential rule).
pub(crate) fn integrate(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (middle, half, h) = (f64::midpoint(a, b), (b - a) / 2.0, 0.04);
    (-80..=80)
        .map(|j| {
            let u = f64::from(j) * h;
            let v = PI / 2.0 * u.sinh();
            let x = v.tanh();
            let weight = PI / 2.0 * u.cosh() / v.cosh().powi(2);
            let t = middle + half * x;
            if t > a && t < b { weight * f(t) } else { 0.0 }
        })
        .sum::<f64>()
        * h
        * half
}

/// Integral of f(xi, eta)/rho dA over the disc of radius `a` about the origin, rho the distance of
/// (xi, eta) from (`x`, 0), 0 < x < a; rays are split where they cross the circles `kinks`.
///
/// `f` gets xi, eta and the direction (cos, sin) from the point of integration to (x, 0).
pub(crate) fn over_disc(
    a: f64,
    kinks: &[f64],
    x: f64,
    f: impl Fn(f64, f64, f64, f64) -> f64,
) -> f64 {
    let n = 64;
    (0..n)
        .map(|i| {
            let (sin, cos) = ((f64::from(i) + 0.5) / f64::from(n) * 2.0 * PI).sin_cos();
            // Distances along the ray at which it crosses a circle of radius s.
            let crossings = |s: f64| {
                let root = s * s - x * x * sin * sin;
                if root > 0.0 {
                    vec![-x * cos - root.sqrt(), -x * cos + root.sqrt()]
                } else {
                    vec![]
                }
            };
            let end = crossings(a)[1];
            let mut bounds: Vec<f64> = kinks.iter().flat_map(|s| crossings(*s)).collect();
            bounds.retain(|d| *d > 0.0 && *d < end);
            bounds.extend([0.0, end]);
            bounds.sort_by(f64::total_cmp);
            bounds
                .windows(2)
                .map(|w| integrate(w[0], w[1], |rho| f(x + rho * cos, rho * sin, -cos, -sin)))
                .sum::<f64>()
        })
        .sum::<f64>()
        * 2.0
        * PI
        / f64::from(n)
}
