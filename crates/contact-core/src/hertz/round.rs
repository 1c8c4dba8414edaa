//! Hertz: frictionless contact of two paraboloids of revolution.

use std::f64::consts::PI;

use crate::material::Elastic;

/// The Hertz contact of a sphere of relative radius R.
///
/// K. L. Johnson, Contact Mechanics (1985), eq. (4.22)-(4.24).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hertz {
    /// Normal force W \[N\].
    pub W: f64,
    /// Contact modulus E* \[Pa\], 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    pub E_star: f64,
    /// Contact radius a \[m\], a^3 = 3 W R / (4 E*).
    pub a: f64,
    /// Peak pressure \[Pa\], 3 W / (2 pi a^2).
    pub p0: f64,
    /// Approach \[m\], a^2 / R.
    pub delta_z: f64,
}

/// Contact modulus E* of a pair \[Pa\]; infinite if both are rigid.
pub fn contact_modulus(body1: Elastic, body2: Elastic) -> f64 {
    let compliance = |m: Elastic| (1.0 - m.nu * m.nu) / m.E;
    1.0 / (compliance(body1) + compliance(body2))
}

/// Hertz contact of a sphere of relative radius `R` \[m\] under the force `W` \[N\].
pub fn hertz(R: f64, body1: Elastic, body2: Elastic, W: f64) -> Hertz {
    let E_star = contact_modulus(body1, body2);
    let a = (3.0 * W * R / (4.0 * E_star)).cbrt();
    Hertz {
        W,
        E_star,
        a,
        p0: 3.0 * W / (2.0 * PI * a * a),
        delta_z: a * a / R,
    }
}

impl Hertz {
    /// Pressure at distance r from the middle \[Pa\], p0 sqrt(1 - r^2/a^2).
    pub fn p(&self, r: f64) -> f64 {
        self.p0 * (1.0 - (r / self.a).powi(2)).max(0.0).sqrt()
    }
}
