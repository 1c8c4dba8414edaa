//! Stress: Hamilton against Boussinesq and Cerruti, McEwen against Flamant.

use std::f64::consts::PI;

use contact_reference::{
    HertzStress, PlaneStress, Stress, line_contact, mcewen_pressure, mcewen_shear,
};

use crate::quadrature::integrate;

/// Displacement at (x, y, z) under a unit force on the origin of a half-space of unit shear
/// modulus, along z (Boussinesq) or along x (Cerruti). K. L. Johnson, Contact Mechanics, eq.
/// (3.18), (3.75).
fn point_load(along_x: bool, nu: f64, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let rho = (x * x + y * y + z * z).sqrt();
    let (far, loose) = (rho + z, 1.0 - 2.0 * nu);
    let u = if along_x {
        [
            1.0 / rho + x * x / rho.powi(3) + loose * (1.0 / far - x * x / (rho * far * far)),
            x * y / rho.powi(3) - loose * x * y / (rho * far * far),
            x * z / rho.powi(3) + loose * x / (rho * far),
        ]
    } else {
        [
            x * z / rho.powi(3) - loose * x / (rho * far),
            y * z / rho.powi(3) - loose * y / (rho * far),
            z * z / rho.powi(3) + 2.0 * (1.0 - nu) / rho,
        ]
    };
    u.map(|u| u / (4.0 * PI))
}

/// Stress of the point load by differences of fourth order and Hooke's law.
fn point_load_stress(along_x: bool, nu: f64, at: [f64; 3]) -> Stress {
    let h = 2e-3 * (at[0].hypot(at[1])).hypot(at[2]);
    let slope = |axis: usize| -> [f64; 3] {
        let u = |steps: f64| {
            let mut p = at;
            p[axis] += steps * h;
            point_load(along_x, nu, p)
        };
        let (a, b, c, d) = (u(-2.0), u(-1.0), u(1.0), u(2.0));
        std::array::from_fn(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * h))
    };
    let d = [slope(0), slope(1), slope(2)];
    let volume = 2.0 * nu / (1.0 - 2.0 * nu) * (d[0][0] + d[1][1] + d[2][2]);
    [
        volume + 2.0 * d[0][0],
        volume + 2.0 * d[1][1],
        volume + 2.0 * d[2][2],
        d[0][1] + d[1][0],
        d[0][2] + d[2][0],
        d[1][2] + d[2][1],
    ]
}

#[test]
fn hamilton_is_the_sum_of_point_loads() {
    let (nu, a) = (0.3, 1.0);
    let field = HertzStress { a, nu };
    for at in [
        [0.0, 0.0, 0.5],
        [0.4, 0.0, 0.4],
        [-0.7, 0.5, 0.6],
        [1.2, -0.3, 0.8],
        [0.0, 0.9, 0.3],
    ] {
        for along_x in [false, true] {
            let closed = if along_x {
                field.shear(at[0], at[1], at[2])
            } else {
                field.pressure(at[0], at[1], at[2])
            };
            // Polar about the middle; the integrand is smooth since z > 0.
            let n = 96;
            let ring = |r: f64, component: usize| -> f64 {
                (0..n)
                    .map(|i| {
                        let (s, c) = (2.0 * PI * f64::from(i) / f64::from(n)).sin_cos();
                        let from_load = [at[0] - r * c, at[1] - r * s, at[2]];
                        point_load_stress(along_x, nu, from_load)[component]
                    })
                    .sum::<f64>()
                    * 2.0
                    * PI
                    / f64::from(n)
            };
            for (component, value) in closed.iter().enumerate() {
                let sum = integrate(0.0, a, |r| (1.0 - r * r).sqrt() * r * ring(r, component));
                assert!(
                    (sum - value).abs() < 1e-8,
                    "{at:?} along x {along_x} component {component}: {sum} {value}"
                );
            }
        }
    }
}

#[test]
fn hamilton_meets_the_surface_and_the_axis() {
    let (a, nu, mu) = (2.0, 0.28, 0.4);
    let field = HertzStress { a, nu };
    for (x, y) in [(0.0, 0.0), (1.0, 0.5), (-1.9, 0.1), (1.7, 1.9)] {
        let load = (1.0 - (x * x + y * y) / (a * a)).max(0.0f64).sqrt();
        let s = field.sliding(3.0, mu, (x, y, 0.0));
        assert!((s[2] + 3.0 * load).abs() < 1e-12, "{s:?}");
        assert!((s[4] + 3.0 * mu * load).abs() < 1e-12, "{s:?}");
        assert!(s[5].abs() < 1e-12);
    }
    // Johnson, eq. (3.45): the axis under pressure alone.
    for z in [0.1, 0.96, 3.0] {
        let s = field.pressure(0.0, 0.0, z);
        let half = a * a / (2.0 * (a * a + z * z));
        let lateral = -(1.0 + nu) * (1.0 - z / a * (a / z).atan()) + half;
        assert!((s[0] - lateral).abs() < 1e-13 && (s[1] - lateral).abs() < 1e-13);
        assert!((s[2] + 2.0 * half).abs() < 1e-13);
    }
    // Tension behind the sliding sphere, which drags the surface along +x: at x = -a,
    // s_xx/p0 = (1 - 2 nu)/3 + pi mu (4 + nu)/8.
    let tension = (1.0 - 2.0 * nu) / 3.0 + PI * mu * (4.0 + nu) / 8.0;
    for z in [0.0, 1e-9] {
        let s = field.sliding(1.0, mu, (-a, 0.0, z));
        assert!((s[0] - tension).abs() < 1e-4, "{s:?} {tension}");
    }
}

/// Stress under a unit line force on the origin, along z or along x (Flamant).
fn line_load_stress(along_x: bool, x: f64, z: f64) -> PlaneStress {
    let r4 = (x * x + z * z).powi(2);
    let (sxx, szz, sxz) = if along_x {
        (x.powi(3), x * z * z, x * x * z)
    } else {
        (x * x * z, z.powi(3), x * z * z)
    };
    [sxx, szz, sxz].map(|s| -2.0 / PI * s / r4)
}

#[test]
fn mcewen_is_the_sum_of_line_loads() {
    let a = 0.8;
    for at in [
        (0.0, 0.3),
        (0.5, 0.2),
        (-0.9, 0.4),
        (1.5, 0.1),
        (-0.01, 2.0),
    ] {
        let (pressure, shear) = (mcewen_pressure(3.0, a, at), mcewen_shear(3.0, a, at));
        for (along_x, closed) in [(false, pressure), (true, shear)] {
            for (component, value) in closed.iter().enumerate() {
                let load = |s: f64| {
                    3.0 * (1.0 - (s / a).powi(2)).sqrt()
                        * line_load_stress(along_x, at.0 - s, at.1)[component]
                };
                let split = at.0.clamp(-0.9 * a, 0.9 * a);
                let sum = integrate(-a, split, load) + integrate(split, a, load);
                assert!(
                    (sum - value).abs() < 1e-9,
                    "{at:?} {along_x} {component}: {sum} {value}"
                );
            }
        }
    }
}

#[test]
fn a_stick_zone_off_the_middle_meets_the_surface() {
    let line = line_contact(0.02, 115e9, 2e5);
    let (mu, T) = (0.4, 0.6 * 0.4 * 2e5);
    let c = line.stick_half_width(T, mu);
    for e in [-0.2 * line.a, 0.0, line.a - c] {
        for x in [e, e + 0.7 * c, e - 0.99 * c, -0.97 * line.a, 1.3 * line.a] {
            let s = line.partial_slip_stress_shifted((x, 0.0), e, T, mu);
            let q = line.q_shifted(x, e, T, mu);
            assert!((s[1] + line.p(x)).abs() < 1e-12 * line.p0, "{s:?}");
            assert!((s[2] + q).abs() < 1e-12 * line.p0, "{s:?} {q}");
        }
        // At a depth the three sums of line loads are those of the tractions.
        let (x, z) = (0.4 * line.a, 0.3 * line.a);
        let s = line.partial_slip_stress_shifted((x, z), e, T, mu);
        for component in 0..3 {
            let load = |at: f64| {
                line.p(at) * line_load_stress(false, x - at, z)[component]
                    + line.q_shifted(at, e, T, mu) * line_load_stress(true, x - at, z)[component]
            };
            let mut ends = vec![-line.a, e - c, e + c, line.a];
            ends.push(x);
            ends.sort_by(f64::total_cmp);
            let sum: f64 = ends.windows(2).map(|w| integrate(w[0], w[1], load)).sum();
            let error = (sum - s[component]).abs() / line.p0;
            assert!(error < 1e-6, "{component}: {sum} {}", s[component]);
        }
    }
}

#[test]
fn partial_slip_of_cylinders_meets_the_surface_and_the_force() {
    let line = line_contact(0.02, 115e9, 2e5);
    let (mu, T) = (0.4, -0.6 * 0.4 * 2e5);
    let c = line.stick_half_width(T, mu);
    let q = |x: f64| line.q(x, T, mu);
    let force = integrate(-line.a, -c, q) + integrate(-c, c, q) + integrate(c, line.a, q);
    assert!((force / T - 1.0).abs() < 1e-10);
    for x in [
        0.0,
        0.5 * c,
        -0.99 * line.a,
        0.5 * (c + line.a),
        1.3 * line.a,
    ] {
        let s = line.partial_slip_stress((x, 0.0), T, mu);
        assert!((s[1] + line.p(x)).abs() < 1e-12 * line.p0, "{s:?}");
        assert!((s[2] + q(x)).abs() < 1e-12 * line.p0, "{s:?}");
    }
    // In the stick zone the shears' surface stretch cancels: s_xx is that of the pressure, -p,
    // and of two straight lines, 2 mu p0 x/a each, that differ by nothing.
    let s = line.partial_slip_stress((0.3 * c, 0.0), T, mu);
    assert!((s[0] + line.p(0.3 * c)).abs() < 1e-12 * line.p0);
}
