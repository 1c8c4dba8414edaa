//! Lubkin: torsion of two spheres pressed together, with partial slip.

use std::f64::consts::PI;

use contact_core::bisection::bisect;
use contact_core::hertz::Hertz;
use contact_core::hertz::elliptic_integrals;
use contact_core::scene::Elastic;
use quadrature::integrate;

/// Points of the Gauss rule; the integrands are smooth, with a logarithm at full slip.
const NODES: usize = 64;

/// Partial slip under constant normal force and a torsional moment M_z, exact for every nu.
///
/// J. L. Lubkin, J. Appl. Mech. 18 (1951) 183. Written here as a superposition of rigid-disc
/// rotations, q = 4 G phi r/(pi sqrt(s^2 - r^2)) on r < s with the moment 16 G phi s^3/3 (derived):
/// Abel inversion of q = mu p in the slip annulus c < r < a gives the rotation
/// d(phi) = -(mu p0/(2 G)) E(k_s) ds/s that each disc takes, k_s^2 = 1 - s^2/a^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lubkin {
    /// The normal contact.
    pub hertz: Hertz,
    /// Friction coefficient.
    pub mu: f64,
    /// Shear modulus of the bodies in series \[Pa\], 1/G = 1/G1 + 1/G2.
    pub G: f64,
}

impl Lubkin {
    /// Torsion of the given Hertz contact.
    pub fn new(hertz: Hertz, body1: Elastic, body2: Elastic, mu: f64) -> Self {
        Self {
            hertz,
            mu,
            G: 1.0 / (1.0 / body1.G() + 1.0 / body2.G()),
        }
    }

    /// Moment of full slip \[N m\], (3 pi/16) mu W a.
    pub fn M_limit(&self) -> f64 {
        3.0 * PI / 16.0 * self.mu * self.hertz.W * self.hertz.a
    }

    /// Torsional stiffness without slip \[N m/rad\], 16 G a^3/3.
    pub fn stiffness(&self) -> f64 {
        16.0 / 3.0 * self.G * self.hertz.a.powi(3)
    }

    /// Rotation phi_z \[rad\] at the stick radius `c` \[m\], 0 < c <= a:
    /// (3 mu W/(4 pi G a^2)) \[K(k) - E(k)\], k^2 = 1 - c^2/a^2.
    pub fn phi(&self, c: f64) -> f64 {
        let (a, ratio) = (self.hertz.a, c / self.hertz.a);
        let difference = (1.0 - ratio) * (1.0 + ratio) * elliptic_integrals(ratio).D;
        3.0 * self.mu * self.hertz.W / (4.0 * PI * self.G * a * a) * difference
    }

    /// Moment M_z \[N m\] at the stick radius `c` \[m\], 0 <= c <= a:
    /// (8 mu p0/3) int_c^a s^2 E(k_s) ds (derived).
    pub fn M_z(&self, c: f64) -> f64 {
        let a = self.hertz.a;
        let integral = integrate(NODES, c / a, 1.0, |s| s * s * elliptic_integrals(s).E);
        8.0 / 3.0 * self.mu * self.hertz.p0 * a.powi(3) * integral
    }

    /// Stick radius c \[m\] under the moment 0 <= `M_z` < `M_limit` \[N m\].
    pub fn stick_radius(&self, M_z: f64) -> f64 {
        let a = self.hertz.a;
        a * bisect(0.0, 1.0, |ratio| M_z - self.M_z(ratio * a))
    }

    /// Circumferential traction q_theta(r) \[Pa\] at the stick radius `c` \[m\]: mu p for r >= c,
    /// and (2 mu p0/pi) int E(sqrt(1 - r^2/(a sin t)^2)) dt over asin(r/a) < t < asin(r/c) for r <
    /// c (derived).
    pub fn q(&self, r: f64, c: f64) -> f64 {
        let (r, a) = (r.abs(), self.hertz.a);
        if r >= c {
            return self.mu * self.hertz.p(r);
        }
        if r == 0.0 {
            return 0.0;
        }
        let integral = integrate(NODES, (r / a).asin(), (r / c).asin(), |t| {
            elliptic_integrals(r / (a * t.sin())).E
        });
        2.0 / PI * self.mu * self.hertz.p0 * integral
    }
}
