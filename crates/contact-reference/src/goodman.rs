//! Goodman: slip while two dissimilar spheres are pressed together, pressure left as Hertz's.

use std::f64::consts::PI;

use contact_core::bisection::bisect;
use contact_core::hertz::elliptic_integrals;

/// Stick radius over contact radius, c/a, of an indentation with friction `mu` of bodies with
/// Dundurs' parameter `beta`, the effect of the shear on the pressure neglected:
/// (1/(2 c)) ln\[(1 + c)/(1 - c)\] = (mu/|beta|) K(sqrt(1 - c^2)).
///
/// L. E. Goodman, J. Appl. Mech. 29 (1962) 515, gave the full-stick traction; D. A. Spence, Proc.
/// R. Soc. A 305 (1968) 55, the self-similar stick radius. The contact grows without changing its
/// shape, so c/a depends on mu/beta alone. With the shear's effect on the pressure:
/// [`coupled_indentation`](super::coupled_indentation).
pub fn goodman_stick_ratio(beta: f64, mu: f64) -> f64 {
    if beta == 0.0 {
        return 1.0;
    }
    let friction = mu / beta.abs();
    bisect(0.0, 1.0, |c| {
        c.atanh() / c - friction * elliptic_integrals(c).K
    })
}

/// Rate function of the shear (derived), for c/a = `c` and lengths over a, tractions over the rate
/// of the pressure's flat-punch form P/sqrt(1 - r^2): dq/da = -d/dr int_r^1 g(s)/sqrt(s^2 - r^2)
/// ds, with g = (|beta|/pi) ln\[(1 + s)/(1 - s)\] in the stick circle, so that the surface strain
/// does not change there, and g = (2 mu s/pi) K(sqrt(1 - s^2)) in the slip annulus, so that dq/da =
/// mu dp/da. g is continuous at s = c: that is the equation of [`goodman_stick_ratio`].
pub fn goodman_rate(s: f64, c: f64, beta: f64, mu: f64) -> f64 {
    if s < c {
        2.0 * beta.abs() / PI * s.atanh()
    } else {
        2.0 * mu * s / PI * elliptic_integrals(s).K
    }
}
