//! Frictionless indentation of a coated body by a sphere, to any accuracy asked for.

use std::f64::consts::PI;

use contact_core::Error;
use contact_core::hertz::hertz;
use contact_core::linear_system::solve;
use contact_core::scene::{Coating, Elastic};
use ndarray::Array2;
use quadrature::gauss_legendre;

use super::layered_response::layered_normal_remainder;

/// Widest contact over the thickness of the coating: the linear system has 700 unknowns there.
const WIDEST: f64 = 200.0;
/// Wave numbers beyond this over the thickness change nothing: exp(-40) is below round-off.
const LAST_WAVE: f64 = 20.0;

/// Secants converge in half a dozen steps; rounding may keep the last one from being below 1e-13.
const MOST_SECANTS: usize = 20;

/// Axisymmetric frictionless contact of a sphere with a body that has one coating.
///
/// Dual integral equations (I. N. Sneddon's method, as M. J. Jaffar, W. T. Chen and others use it;
/// derived here). With the pair's response u_z/p = (2/(E_c k)) \[1 + A(k)\], where
/// 1/E_c = (1 - nu1)/(2 G1) + (1 - nu_i^2)/E_i (coating 1, indenter i), the transform of the
/// pressure is (E_c/pi) int_0^a phi(t) cos(k t) dt and the gap vanishes inside if
///
/// phi(t) + (2/pi) int_0^a phi(s) int_0^inf A(k) cos(k t) cos(k s) dk ds = delta_z - t^2/R,
///
/// phi(a) = 0; W = 2 E_c int phi dt. Solved at Gauss nodes; the reference tests hold it to 1e-8.
#[derive(Clone, Debug, PartialEq)]
pub struct CoatedIndentation {
    /// Contact radius a \[m\].
    pub a: f64,
    /// Normal force W \[N\].
    pub W: f64,
    /// Approach, both bodies together \[m\].
    pub delta_z: f64,
    /// Relative radius R \[m\].
    R: f64,
    /// Modulus E_c \[Pa\].
    E_c: f64,
    /// Wave numbers k \[1/m\] and their share of phi'(t) = -2 t/R + sum share sin(k t).
    waves: Vec<(f64, f64)>,
}

/// The contact of an elastic or rigid sphere of radius `R` \[m\] with a coated body under `W`
/// \[N\].
///
/// The work grows like (a/h)^3: a second or so at h = a/100. Fails if the contact is more than 200
/// times as wide as the coating is thick, where the closed forms of thin layers hold.
pub fn coated_indentation(
    R: f64,
    indenter: Elastic,
    coating: Coating,
    substrate: Elastic,
    W: f64,
) -> Result<CoatedIndentation, Error> {
    let is_thick_enough = |a: f64| {
        if a <= WIDEST * coating.thickness {
            return Ok(());
        }
        let allowed = format!("at least 1/{WIDEST} of the contact radius, here {a:e} m");
        let (key, h) = ("coating.thickness", coating.thickness);
        Err(Error::invalid(key, format!("{h:e}"), allowed))
    };
    // Secants of ln W over ln a; W grows like a power of a, the cube on a half-space.
    let mut a = hertz(R, indenter, coating.material, W).a;
    is_thick_enough(a.min(hertz(R, indenter, substrate, W).a))?;
    // With a coating softer than its substrate the first radius may be too large.
    a = a.min(WIDEST * coating.thickness);
    let mut power = 3.0;
    let mut contact = CoatedIndentation::of_radius(R, indenter, coating, substrate, a);
    for _ in 0..MOST_SECANTS {
        let next = a * (W / contact.W).powf(1.0 / power);
        if (next - a).abs() <= 1e-13 * a {
            break;
        }
        is_thick_enough(next)?;
        let W_before = contact.W;
        contact = CoatedIndentation::of_radius(R, indenter, coating, substrate, next);
        let local = (contact.W / W_before).ln() / (next / a).ln();
        if local.is_finite() {
            // Between a half-space (3) and an incompressible film (6), with room.
            power = local.clamp(1.0, 8.0);
        }
        a = next;
    }
    Ok(contact)
}

impl CoatedIndentation {
    /// The contact whose radius is `a` \[m\].
    pub fn of_radius(
        R: f64,
        indenter: Elastic,
        coating: Coating,
        substrate: Elastic,
        a: f64,
    ) -> Self {
        let (layer, h) = (coating.material, coating.thickness);
        let layer_compliance = (1.0 - layer.nu) / (2.0 * layer.G());
        let E_c = 1.0 / (layer_compliance + (1.0 - indenter.nu.powi(2)) / indenter.E);
        // Panels in k h, finer where the response of thin or stiff coatings bends; nodes enough
        // for the waves cos(k t) cos(k s).
        let mut waves = Vec::new();
        for panel in [0.0, 0.02, 0.1, 0.5, 2.0, 8.0, LAST_WAVE].windows(2) {
            let n = 20 + (1.2 * (panel[1] - panel[0]) * a / h).ceil() as usize;
            for (kh, w) in gauss_legendre(n, panel[0], panel[1]) {
                let A = layer_compliance * E_c * layered_normal_remainder(kh, layer, substrate);
                waves.push((kh / h, w / h * A));
            }
        }
        let n = 24 + (3.5 * a / h).ceil() as usize;
        // The edge itself, without weight, is the last node: phi(a) comes with the solution.
        let mut nodes = gauss_legendre(n, 0.0, a);
        nodes.push((a, 0.0));
        let cosines = Array2::from_shape_fn((n + 1, waves.len()), |(i, k)| {
            (waves[k].0 * nodes[i].0).cos()
        });
        let weighted = Array2::from_shape_fn((waves.len(), n + 1), |(k, j)| {
            waves[k].1 * cosines[[j, k]] * nodes[j].1
        });
        let matrix = Array2::eye(n + 1) + cosines.dot(&weighted) * (2.0 / PI);
        let right = Array2::from_shape_fn((n + 1, 2), |(i, column)| match column {
            0 => 1.0,
            _ => nodes[i].0.powi(2) / R,
        });
        let parts = solve(&matrix, &right);
        let delta_z = parts[[n, 1]] / parts[[n, 0]];
        let phi = &parts.column(0) * delta_z - parts.column(1);
        let W = 2.0
            * E_c
            * nodes
                .iter()
                .zip(&phi)
                .map(|(&(_, w), f)| w * f)
                .sum::<f64>();
        let transform = weighted.dot(&phi);
        let waves = waves
            .iter()
            .zip(&transform)
            .map(|(&(k, _), t)| (k, 2.0 / PI * k * t))
            .collect();
        Self {
            a,
            W,
            delta_z,
            R,
            E_c,
            waves,
        }
    }

    /// Pressure at distance r from the middle \[Pa\], -(E_c/pi) int_r^a phi'(t)/sqrt(t^2 - r^2) dt.
    pub fn p(&self, r: f64) -> f64 {
        let r = r.abs();
        if r >= self.a {
            return 0.0;
        }
        // With t^2 = r^2 + v^2.
        let span = ((self.a - r) * (self.a + r)).sqrt();
        let last = self.waves.last().map_or(0.0, |wave| wave.0);
        let n = 32 + (last * span).ceil() as usize;
        let slope_over_t = |t: f64| {
            let waves: f64 = self.waves.iter().map(|&(k, f)| f * (k * t).sin()).sum();
            waves / t - 2.0 / self.R
        };
        let integral: f64 = gauss_legendre(n, 0.0, span)
            .iter()
            .map(|&(v, w)| w * slope_over_t(r.hypot(v)))
            .sum();
        -self.E_c / PI * integral
    }
}
