//! Indentation with friction of dissimilar bodies.

use std::f64::consts::PI;

use contact_core::scene::Elastic;
use contact_reference::{coupled_indentation, dundurs_beta, goodman_rate, goodman_stick_ratio};

use crate::quadrature::{integrate, over_disc};

/// beta, mu, c/a coupled, c/a uncoupled, delta_z R/a^2, W/(4 E* a^3/(3 R)): another program's
/// solution of the same problem by dual Abel transforms, good to about 1e-4.
const ROWS: [[f64; 6]; 7] = [
    [0.1, 0.05, 0.48083, 0.48513, 1.00135, 1.00314],
    [0.1, 0.10, 0.90101, 0.90375, 1.00229, 1.00517],
    [0.2, 0.10, 0.46774, 0.48513, 1.00541, 1.01259],
    [0.2, 0.2986, 0.97589, 0.98097, 1.01077, 1.02393],
    [2.0 / 7.0, 0.20, 0.69828, 0.73338, 1.01487, 1.03443],
    [2.0 / 7.0, 0.50, 0.98414, 0.99165, 1.02322, 1.05151],
    [0.5, 0.50, 0.81265, 0.90375, 1.05997, 1.13924],
];

#[test]
fn another_program_finds_the_same_contact() {
    for [beta, mu, c, goodman, delta_z, W] in ROWS {
        let contact = coupled_indentation(beta, mu);
        assert!((goodman_stick_ratio(beta, mu) - goodman).abs() < 6e-6);
        assert!((contact.stick_ratio - c).abs() < 1e-4, "{contact:?}");
        assert!((contact.delta_z - delta_z).abs() < 1e-4, "{contact:?}");
        assert!((contact.W - W).abs() < 1e-4, "{contact:?}");
    }
}

#[test]
fn dundurs_parameter_of_known_pairs() {
    let of = |nu: f64| Elastic { E: 70e9, nu };
    assert!(dundurs_beta(of(0.3), of(0.3)).abs() < 1e-16);
    assert!((dundurs_beta(of(0.3), Elastic::RIGID) - 2.0 / 7.0).abs() < 1e-15);
    assert!((dundurs_beta(Elastic::RIGID, of(0.0)) + 0.5).abs() < 1e-15);
}

#[test]
fn goodmans_rates_slip_at_the_limit_and_stick_without_strain() {
    // nu = 0.3 on rigid: A = (1 - nu)/G, beta = 2/7; pressure rate 1/sqrt(1 - r^2).
    let (nu, mu) = (0.3, 0.2);
    let beta = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu));
    let c = goodman_stick_ratio(beta, mu);
    // chi(r) = int_r^1 g/sqrt(s^2 - r^2) ds with s^2 = r^2 + v^2; dq/da = -d(chi)/dr.
    let chi = |r: f64| {
        let part = |v: f64| goodman_rate(r.hypot(v), c, beta, mu) / r.hypot(v);
        let end = ((1.0 - r) * (1.0 + r)).sqrt();
        let kink = (c * c - r * r).max(0.0).sqrt();
        (if kink > 0.0 {
            integrate(0.0, kink, part)
        } else {
            0.0
        }) + integrate(kink, end, part)
    };
    let rate = |r: f64| {
        let h = 1e-4 * (c - r).abs().min(1.0 - r).min(r);
        (chi(r - h) - chi(r + h)) / (2.0 * h)
    };
    let flat = |r: f64| {
        if r < 1.0 {
            1.0 / ((1.0 - r) * (1.0 + r)).sqrt()
        } else {
            0.0
        }
    };
    for r in [1.01 * c, 0.85, 0.97] {
        assert!((rate(r) / (mu * flat(r)) - 1.0).abs() < 1e-6, "{r}");
    }
    // Radial displacement in the stick circle, times 2 pi G: shear by Cerruti, pressure by
    // Boussinesq, -(1 - 2 nu)/2 cos/rho.
    let n = 400;
    let table: Vec<f64> = (0..n)
        .map(|i| rate(c * (1.0 - (1.0 - (f64::from(i) + 0.5) / f64::from(n)).powi(2))))
        .collect();
    let shear = |r: f64| {
        if r >= c {
            return mu * flat(r);
        }
        let place = ((1.0 - (1.0 - r / c).sqrt()) * f64::from(n) - 0.5).max(0.0);
        let i = (place as usize).min(table.len() - 2);
        table[i] + (place - i as f64) * (table[i + 1] - table[i])
    };
    for x in [0.3 * c, 0.7 * c] {
        let by_shear = over_disc(1.0, &[c], x, |xi, eta, cos, sin| {
            let r = xi.hypot(eta);
            let (q_x, q_y) = (shear(r) * xi / r, shear(r) * eta / r);
            q_x * (1.0 - nu + nu * cos * cos) + q_y * nu * cos * sin
        });
        let by_pressure = over_disc(1.0, &[], x, |xi, eta, cos, _| {
            -(1.0 - 2.0 * nu) / 2.0 * cos * flat(xi.hypot(eta))
        });
        let exact = -PI * (1.0 - 2.0 * nu) * (1.0 - 1.0 / flat(x)) / x;
        assert!(
            (by_pressure / exact - 1.0).abs() < 1e-6,
            "{by_pressure} {exact}"
        );
        // Straight lines between 400 samples, near a cusp at c.
        assert!(
            (by_shear + exact).abs() < 1e-3 * exact.abs(),
            "{by_shear} {exact}"
        );
    }
}
