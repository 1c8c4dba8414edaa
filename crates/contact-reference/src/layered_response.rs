//! The normal surface frequency response of one coating on a substrate, in closed form.

use contact_core::scene::Elastic;

/// Normal displacement over pressure, u_z/p \[m/Pa\], at wave number `k` > 0 \[1/m\] of a coating
/// (1) of thickness `h` \[m\] bonded to a substrate (2):
///
/// u_z/p = ((1 - nu1)/(G1 k)) \[1 + 4 k h kappa t - lambda kappa t^2\]
///         / \[1 - (lambda + kappa + 4 kappa k^2 h^2) t + lambda kappa t^2\],
///
/// t = exp(-2 k h), zeta = G1/G2, lambda = 1 - 4 (1 - nu1)/(1 + zeta (3 - 4 nu2)),
/// kappa = (zeta - 1)/(zeta + 3 - 4 nu1).
///
/// T. C. O'Sullivan, R. B. King, J. Tribol. 110 (1988) 235, as used by T. Nogi, T. Kato, J. Tribol.
/// 119 (1997) 493. A rigid substrate is allowed.
pub fn layered_normal_response(k: f64, coating: Elastic, h: f64, substrate: Elastic) -> f64 {
    (1.0 - coating.nu) / (coating.G() * k)
        * (1.0 + layered_normal_remainder(k * h, coating, substrate))
}

/// [`layered_normal_response`] over the response of a half-space of the coating's material, less one, at
/// `kh` = k h; it decays like k h exp(-2 k h).
pub(crate) fn layered_normal_remainder(kh: f64, coating: Elastic, substrate: Elastic) -> f64 {
    let zeta = coating.G() / substrate.G();
    let t = (-2.0 * kh).exp();
    let lambda = 1.0 - 4.0 * (1.0 - coating.nu) / (1.0 + zeta * (3.0 - 4.0 * substrate.nu));
    let kappa = (zeta - 1.0) / (zeta + 3.0 - 4.0 * coating.nu);
    // Numerator less denominator, so that the subtraction of one loses no digit.
    let difference = lambda + kappa * (1.0 + 4.0 * kh * (1.0 + kh) - 2.0 * lambda * t);
    let denominator = 1.0 - (lambda + kappa + 4.0 * kappa * kh * kh) * t + lambda * kappa * t * t;
    difference * t / denominator
}
