//! Frequency response of a stack of layers to a heat flux on its surface.
//!
//! The flux q exp(i (k.x + w t)) into the body raises its surface by Y q. In a layer the
//! temperature is the sum of two parts exp(-+ s z), s = sqrt(k^2 + i w C/K), Re s > 0, that conduct
//! the fluxes +- m times themselves, m = K s. For a half-space Y = 1/m. If the material below a
//! layer conducts the flux M per unit temperature, the two parts have the ratio rho = (m - M)/(m +
//! M) at the bottom of the layer, and at its top
//!
//! ```text
//! Y = (1 + rho E)/(m (1 - rho E)),  E = exp(-2 s h)
//! ```
//!
//! (Carslaw and Jaeger 1959, chapter III, composite slabs). Only decaying exponentials occur, and
//! both 1 - rho E = (1 - E) + E 2 M/(m + M) and 1 + rho E = (1 - E) + E 2 m/(m + M) are without
//! cancellation.

use contact_core::kernels::Complex64;

use super::conductor::{Conductor, Layers};

/// i w C/K \[1/m^2\]: the square of the decay of a plane wave of temperature.
pub(super) fn plane_decay_squared(conductor: Conductor, w: f64) -> Complex64 {
    Complex64::new(0.0, w * conductor.heat_capacity / conductor.conductivity)
}

/// s \[1/m\].
fn decay(conductor: Conductor, k: f64, w: f64) -> Complex64 {
    (plane_decay_squared(conductor, w) + k * k).sqrt()
}

/// 1 - exp(-z), without cancellation as z -> 0.
pub(super) fn one_minus_exp(z: Complex64) -> Complex64 {
    let (e, half) = ((-z.re).exp(), (z.im / 2.0).sin());
    // exp(-z) - 1 = expm1(-x) cos y - 2 sin^2(y/2) - i exp(-x) sin y.
    Complex64::new(
        2.0 * half * half - (-z.re).exp_m1() * z.im.cos(),
        e * z.im.sin(),
    )
}

/// The surface response Y of the layers at wave number k and angular frequency w, and Y less the response of
/// the half-space of the outermost material \[m^2 K/W\].
fn both(body: &Layers, k: f64, w: f64) -> (Complex64, Complex64) {
    let below = body.substrate.conductivity * decay(body.substrate, k, w);
    let (mut conducts, mut rest) = (below, Complex64::ZERO);
    for &(layer, h) in body.coatings.iter().rev() {
        let s = decay(layer, k, w);
        let m = layer.conductivity * s;
        let closed = one_minus_exp(2.0 * h * s);
        let e = (-2.0 * h * s).exp();
        let sum = m + conducts;
        let rho = (m - conducts) / sum;
        let minus = closed + e * 2.0 * conducts / sum;
        let plus = closed + e * 2.0 * m / sum;
        rest = 2.0 * rho * e / (minus * m);
        conducts = m * minus / plus;
    }
    (conducts.inv(), rest)
}

/// Surface temperature over the flux exp(i (k.x + w t)) into a body \[m^2 K/W\], at the wave number
/// k > 0 \[1/m\] and the angular frequency w >= 0 \[1/s\].
pub fn surface_response(body: &Layers, k: f64, w: f64) -> Complex64 {
    both(body, k, w).0
}

/// Response less the response of the half-space of the outermost material; it decays like exp(-2 k h).
pub(super) fn remainder(body: &Layers, k: f64, w: f64) -> Complex64 {
    both(body, k, w).1
}

/// A wave number below which k times the response is well within its power series \[1/m\]: the series of
/// the steady state ends at 1/(H contrast) or beyond, H the height of the stack; where the
/// temperature swings, at its plane waves.
pub(super) fn lowest_scale(body: &Layers, w: f64) -> f64 {
    let materials = || body.coatings.iter().map(|l| l.0).chain([body.substrate]);
    let least = materials()
        .map(|m| m.conductivity)
        .fold(f64::INFINITY, f64::min);
    let most = materials().map(|m| m.conductivity).fold(0.0, f64::max);
    let height: f64 = body.coatings.iter().map(|l| l.1).sum();
    let steady = least / (most * height);
    if w == 0.0 {
        return steady;
    }
    let waves = materials().map(|m| plane_decay_squared(m, w).im.sqrt());
    waves.fold(steady, f64::min)
}
