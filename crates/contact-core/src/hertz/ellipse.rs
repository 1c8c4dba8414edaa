//! Hertz: frictionless contact of two bodies of unequal principal curvatures.

use std::f64::consts::PI;

use super::elliptic::{EllipticIntegrals, elliptic_integrals};
use crate::bisection::bisect;

/// The elliptical Hertz contact of relative principal radii R_x, R_y along the axes.
///
/// K. L. Johnson, Contact Mechanics (1985), sec. 4.2: under
/// p = p0 sqrt(1 - x^2/a^2 - y^2/b^2) with a >= b the normal displacement of the pair is
/// L - M x^2 - N y^2 with L = p0 b K/E*, M = p0 (b/a^2) D/E*, N = p0 B/(b E*), where K, B, D are
/// [`EllipticIntegrals`] of k' = b/a. Matching the gap x^2/(2 R_x) + y^2/(2 R_y) gives
/// R_x/R_y = B/(k'^2 D), which is \[E/(1 - e^2) - K\]/(K - E), and a^3 = 3 W R_x D/(pi E*).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzEllipse {
    /// Normal force W \[N\].
    pub W: f64,
    /// Contact modulus E* \[Pa\].
    pub E_star: f64,
    /// Semi-axis of the contact along x \[m\].
    pub a_x: f64,
    /// Semi-axis of the contact along y \[m\].
    pub a_y: f64,
    /// Peak pressure \[Pa\], 3 W/(2 pi a_x a_y).
    pub p0: f64,
    /// Approach \[m\].
    pub delta_z: f64,
}

/// Radius ratio R_major/R_minor of the shapes whose contact has the axis ratio k' = b/a.
fn radius_ratio(k_prime: f64) -> f64 {
    let EllipticIntegrals { B, D, .. } = elliptic_integrals(k_prime);
    B / (k_prime * k_prime * D)
}

/// Elliptical contact of relative principal radii `R_x`, `R_y` \[m\] (1/R_x the sum of both bodies'
/// curvatures along x) and contact modulus `E_star` \[Pa\] under the force `W` \[N\].
///
/// The axis ratio b/a is found for R_major/R_minor up to about 1e12.
pub fn hertz_ellipse(R_x: f64, R_y: f64, E_star: f64, W: f64) -> HertzEllipse {
    let (R_major, R_minor) = (R_x.max(R_y), R_x.min(R_y));
    let ratio = R_major / R_minor;
    let k_prime = bisect(1e-8, 1.0, |k_prime| ratio.ln() - radius_ratio(k_prime).ln());
    let EllipticIntegrals { K, D, .. } = elliptic_integrals(k_prime);
    let a = (3.0 * W * R_major * D / (PI * E_star)).cbrt();
    let b = k_prime * a;
    let p0 = 3.0 * W / (2.0 * PI * a * b);
    let (a_x, a_y) = if R_x >= R_y { (a, b) } else { (b, a) };
    HertzEllipse {
        W,
        E_star,
        a_x,
        a_y,
        p0,
        delta_z: p0 * b * K / E_star,
    }
}

impl HertzEllipse {
    /// Pressure at (x, y) \[Pa\], p0 sqrt(1 - x^2/a_x^2 - y^2/a_y^2).
    pub fn p(&self, x: f64, y: f64) -> f64 {
        let height = 1.0 - (x / self.a_x).powi(2) - (y / self.a_y).powi(2);
        self.p0 * height.max(0.0).sqrt()
    }
}
