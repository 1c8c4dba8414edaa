//! Hertz: circle, ellipse, line.

use std::f64::consts::PI;

use contact_core::scene::Elastic;
use contact_reference::{hertz, hertz_ellipse, line_contact};

use crate::quadrature::integrate;

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };

#[test]
fn the_ellipse_closes_the_gap_of_its_paraboloid() {
    let E_star = 115e9;
    for (R_x, R_y) in [(0.01, 0.01), (0.02, 0.015), (0.3, 0.01), (0.004, 0.9)] {
        let contact = hertz_ellipse(R_x, R_y, E_star, 500.0);
        let (a_x, a_y) = (contact.a_x, contact.a_y);
        // u_z = (1/(pi E*)) int int p/rho dA; along a chord p is a half circle over its length L:
        // int p drho = p0 sqrt(C) pi L^2/8. Lines through the point fill the plane over half a
        // turn.
        let u_z = |x: f64, y: f64| {
            let chord = |t: f64| {
                let (s, c) = t.sin_cos();
                let (s, c) = (s / a_y, c / a_x);
                let C = s * s + c * c;
                let B = x / a_x * c + y / a_y * s;
                let A = 1.0 - (x / a_x).powi(2) - (y / a_y).powi(2);
                contact.p0 * C.sqrt() * PI / 8.0 * 4.0 * (B * B + A * C) / (C * C)
            };
            // The integrand peaks along the long axis: split there.
            (integrate(0.0, PI / 2.0, chord) + integrate(PI / 2.0, PI, chord)) / (PI * E_star)
        };
        for (x, y) in [(0.0, 0.0), (0.7, 0.0), (0.0, 0.6), (0.5, -0.5)] {
            let (x, y) = (x * a_x, y * a_y);
            let gap = x * x / (2.0 * R_x) + y * y / (2.0 * R_y) + u_z(x, y) - contact.delta_z;
            assert!(gap.abs() < 1e-9 * contact.delta_z, "{R_x} {R_y}: {gap:e}");
        }
        let W = 2.0 / 3.0 * PI * a_x * a_y * contact.p0;
        assert!((W / 500.0 - 1.0).abs() < 1e-14);
        assert!(contact.p(a_x * 1.01, 0.0) <= 0.0);
        let half = contact.p(0.3f64.sqrt() * a_x, 0.45f64.sqrt() * a_y);
        assert!((half / contact.p0 - 0.5).abs() < 1e-12);
    }
}

#[test]
fn the_ellipse_of_equal_radii_is_the_circle() {
    let circle = hertz(0.018, STEEL, STEEL, 1e3);
    let ellipse = hertz_ellipse(0.018, 0.018, circle.E_star, 1e3);
    for (x, y) in [
        (ellipse.a_x, circle.a),
        (ellipse.a_y, circle.a),
        (ellipse.p0, circle.p0),
        (ellipse.delta_z, circle.delta_z),
    ] {
        assert!((x / y - 1.0).abs() < 1e-12, "{x} {y}");
    }
}

#[test]
fn the_line_contact_has_the_curvature_of_its_cylinder() {
    let (R, E_star, W) = (0.02, 115e9, 2e5);
    let line = line_contact(R, E_star, W);
    let force = integrate(-line.a, line.a, |x| line.p(x));
    assert!((force / W - 1.0).abs() < 1e-10);
    // Slope of the surface: -(2/(pi E*)) PV int p(s)/(x - s) ds = -x/R.
    for x in [0.0, 0.3 * line.a, -0.8 * line.a] {
        let rest = |s: f64| (line.p(s) - line.p(x)) / (x - s);
        let principal = integrate(-line.a, x, rest)
            + integrate(x, line.a, rest)
            + line.p(x) * ((line.a + x) / (line.a - x)).ln();
        let slope = -2.0 / (PI * E_star) * principal;
        assert!((slope + x / R).abs() < 1e-8 * line.a / R, "{slope} {x}");
    }
}
