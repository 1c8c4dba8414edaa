//! Partial slip: Cattaneo-Mindlin, springs, torsion.

use std::f64::consts::PI;

use contact_core::scene::Elastic;
use contact_reference::{CattaneoMindlin, Lubkin, Springs, hertz, mindlin_shear_displacement};

use crate::quadrature::{integrate, over_disc};

const R: f64 = 0.018;
const MU: f64 = 0.3;
const W: f64 = 1e3;
const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };
/// Without lateral contraction the shear kernel is isotropic and the closed forms are exact.
const CORK: Elastic = Elastic { E: 210e9, nu: 0.0 };

fn partial_slip(material: Elastic) -> CattaneoMindlin {
    CattaneoMindlin::new(hertz(R, material, material, W), material, material, MU)
}

/// q_x at (r, T).
type Traction = Box<dyn Fn(f64, f64) -> f64>;

/// Cerruti's surface kernel times 2 pi G rho: (u_x under q_x, u_y under q_x).
fn cerruti(nu: f64, cos: f64, sin: f64) -> (f64, f64) {
    (1.0 - nu + nu * cos * cos, nu * cos * sin)
}

#[test]
fn the_hertz_shaped_shear_displaces_as_cerruti_integrated() {
    let (a, q0) = (0.7, 3.0);
    for material in [STEEL, CORK, Elastic { E: 1.0, nu: -0.4 }] {
        for x in [0.1, 0.35, 0.6] {
            let shear =
                |xi: f64, eta: f64| q0 * (1.0 - (xi * xi + eta * eta) / (a * a)).max(0.0).sqrt();
            let scale = 2.0 * PI * material.G();
            let along = over_disc(a, &[], x, |xi, eta, cos, sin| {
                shear(xi, eta) * cerruti(material.nu, cos, sin).0
            }) / scale;
            // The same point turned by 45 degrees: load along the diagonal, seen in its own axes.
            let diagonal = over_disc(a, &[], x, |xi, eta, cos, sin| {
                let (c, s) = ((cos - sin) / 2f64.sqrt(), (cos + sin) / 2f64.sqrt());
                shear(xi, eta) * cerruti(material.nu, c, s).1
            }) / scale;
            let (u_x, _) = mindlin_shear_displacement(material, q0, a, (x, 0.0));
            let d = x / 2f64.sqrt();
            let (_, u_y) = mindlin_shear_displacement(material, q0, a, (d, d));
            assert!((along / u_x - 1.0).abs() < 1e-9, "{along} {u_x}");
            assert!((diagonal - u_y).abs() < 1e-9 * u_x, "{diagonal} {u_y}");
        }
    }
}

#[test]
fn tractions_carry_the_force_and_obey_coulomb() {
    let c = partial_slip(STEEL);
    let (a, T_m) = (c.hertz.a, 0.9 * c.T_limit());
    let laws: [Traction; 3] = [
        Box::new(move |r, T| c.q_loading(r, T)),
        Box::new(move |r, T| c.q_unloading(r, T, T_m)),
        Box::new(move |r, T| c.q_reloading(r, T, T_m)),
    ];
    for q in &laws {
        for share in [-0.9, -0.3, 0.2, 0.8] {
            let T = share * c.T_limit();
            let edges = [c.stick_radius(T), c.stick_radius(T_m)];
            let reversed = [
                c.stick_radius_reversed(T, T_m),
                c.stick_radius_reversed(T, -T_m),
            ];
            let mut bounds = vec![0.0, a];
            bounds.extend(edges.iter().chain(&reversed));
            bounds.sort_by(f64::total_cmp);
            let force: f64 = bounds
                .windows(2)
                .map(|w| integrate(w[0], w[1], |r| 2.0 * PI * r * q(r, T)))
                .sum();
            assert!((force - T).abs() < 1e-9 * c.T_limit(), "{force} {T}");
            for i in 0..100 {
                let r = f64::from(i) / 100.0 * a;
                assert!(q(r, T).abs() <= MU * c.hertz.p(r) * (1.0 + 1e-12));
            }
        }
    }
}

#[test]
fn the_stick_circle_moves_as_one_and_the_rest_lags_behind() {
    let c = partial_slip(CORK);
    let (a, T_m) = (c.hertz.a, 0.9 * c.T_limit());
    // Both bodies alike: the relative displacement is twice that of one.
    let u_x = |x: f64, q: &dyn Fn(f64) -> f64, kinks: &[f64]| {
        2.0 * over_disc(a, kinks, x, |xi, eta, _, _| q(xi.hypot(eta))) / (2.0 * PI * CORK.G())
    };
    let T = 0.7 * c.T_limit();
    let stick = c.stick_radius(T);
    let loading = |r: f64| c.q_loading(r, T);
    for x in [0.1 * stick, 0.6 * stick, 0.95 * stick] {
        let shift = u_x(x, &loading, &[stick]);
        assert!((shift / c.shift_loading(T) - 1.0).abs() < 1e-9, "{shift:e}");
    }
    let slip = u_x(0.9 * a, &loading, &[stick]) - c.shift_loading(T);
    assert!(
        slip < -0.01 * c.shift_loading(T),
        "slip against the traction"
    );

    let T = -0.4 * c.T_limit();
    let kinks = [c.stick_radius(T_m), c.stick_radius_reversed(T, T_m)];
    let unloading = |r: f64| c.q_unloading(r, T, T_m);
    for x in [0.1 * kinks[0], 0.9 * kinks[0]] {
        let shift = u_x(x, &unloading, &kinks);
        let expected = c.shift_unloading(T, T_m);
        assert!(
            (shift - expected).abs() < 1e-9 * c.shift_limit(),
            "{shift:e}"
        );
    }
}

#[test]
fn the_loop_closes_and_its_area_is_its_energy() {
    let c = partial_slip(STEEL);
    for share in [0.3, 0.9, 1.0] {
        let T_m = share * c.T_limit();
        let ends = (c.shift_unloading(T_m, T_m), c.shift_unloading(-T_m, T_m));
        assert!((ends.0 - c.shift_loading(T_m)).abs() < 1e-14 * c.shift_limit());
        assert!((ends.1 + c.shift_loading(T_m)).abs() < 1e-14 * c.shift_limit());
        let area = integrate(-T_m, T_m, |T| {
            c.shift_unloading(T, T_m) - c.shift_reloading(T, T_m)
        });
        let energy = c.loop_energy(T_m);
        assert!((area / energy - 1.0).abs() < 1e-8, "{area:e} {energy:e}");
    }
    assert!((c.energy_ratio(c.T_limit()) - 0.2).abs() < 1e-12);
}

#[test]
fn springs_follow_cattaneo_and_mindlin_round_the_loop() {
    let c = partial_slip(CORK);
    let T_m = 0.9 * c.T_limit();
    let mut springs = Springs::new(c.hertz, R, CORK, CORK, MU, 2000);
    springs.load((0.0, 0.0), (W, 0.0), 1);
    let mut at = 0.0;
    let mut go = |T: f64| {
        let shift = springs.load((W, at), (W, T), 1);
        at = T;
        shift
    };
    // 2000 springs a side know the stick radius to 1/2000.
    let close = |x: f64, y: f64| (x - y).abs() < 5e-4 * c.shift_limit();
    for T in [0.5 * T_m, T_m] {
        assert!(close(go(T), c.shift_loading(T)));
    }
    for T in [0.2 * T_m, -0.7 * T_m, -T_m] {
        assert!(close(go(T), c.shift_unloading(T, T_m)));
    }
    for T in [-0.2 * T_m, 0.7 * T_m, T_m] {
        assert!(close(go(T), c.shift_reloading(T, T_m)));
    }
}

#[test]
fn springs_follow_mindlin_and_deresiewicz_when_both_forces_change() {
    let c = partial_slip(CORK);
    let depth = |load: f64| hertz(R, CORK, CORK, load).delta_z;
    let stiffness_ratio = c.hertz.E_star / (4.0 * c.G_star);
    // Loading from nothing with dT/dW = k < mu: no slip, f_x = k f_z, so delta_x = k (E*/G_t)
    // delta_z.
    let k = 0.2;
    let mut springs = Springs::new(c.hertz, R, CORK, CORK, MU, 1000);
    let shift = springs.load((0.0, 0.0), (W, k * W), 200);
    let exact = k * stiffness_ratio * depth(W);
    assert!((shift / exact - 1.0).abs() < 2e-3, "{shift:e} {exact:e}");
    // T kept while W falls and rises within friction's reach of the springs that bear: the outer
    // springs part and slip; traction mu [p(W) - p(W_c)] with T = mu (W - W_c) once all of the
    // annulus slips in one direction.
    let mut springs = Springs::new(c.hertz, R, CORK, CORK, MU, 1000);
    springs.load((0.0, 0.0), (W, 0.0), 1);
    let (W_end, T_end) = (0.7 * W, 0.15 * W);
    let shift = springs.load((W, 0.0), (W_end, T_end), 400);
    let W_c = W_end - T_end / MU;
    let exact = MU * stiffness_ratio * (depth(W_end) - depth(W_c));
    assert!((shift / exact - 1.0).abs() < 2e-3, "{shift:e} {exact:e}");
    // More load on the same T moves nothing.
    let still = springs.load((W_end, T_end), (W, T_end), 50);
    assert!((still - shift).abs() < 1e-12 * shift);
}

#[test]
fn torsion_gives_lubkins_table_and_limits() {
    let torsion = Lubkin::new(hertz(R, STEEL, CORK, W), STEEL, CORK, MU);
    let (a, G) = (torsion.hertz.a, torsion.G);
    // Published values of G a^2 phi/(mu W) and M/(mu W a).
    for (c, phi, M) in [
        (0.9, 0.038_513_9, 0.176_345_4),
        (0.5, 0.225_711_9, 0.528_576_0),
        (0.1, 0.639_717_8, 0.588_619_9),
    ] {
        assert!((torsion.phi(c * a) * G * a * a / (MU * W) - phi).abs() < 6e-8);
        assert!((torsion.M_z(c * a) / (MU * W * a) - M).abs() < 6e-8);
        assert!((torsion.stick_radius(torsion.M_z(c * a)) / a - c).abs() < 1e-9);
    }
    assert!((torsion.M_z(0.0) / torsion.M_limit() - 1.0).abs() < 1e-6);
    let nearly = 0.9999 * a;
    let stiffness = torsion.M_z(nearly) / torsion.phi(nearly);
    assert!((stiffness / torsion.stiffness() - 1.0).abs() < 3e-4);
}

#[test]
fn torsion_turns_the_stick_circle_rigidly_whatever_nu_is() {
    for material in [STEEL, CORK] {
        let torsion = Lubkin::new(hertz(R, material, material, W), material, material, MU);
        let a = torsion.hertz.a;
        let c = 0.6 * a;
        let moment = integrate(0.0, c, |r| 2.0 * PI * r * r * torsion.q(r, c))
            + integrate(c, a, |r| 2.0 * PI * r * r * torsion.q(r, c));
        assert!((moment / torsion.M_z(c) - 1.0).abs() < 1e-9, "{moment:e}");
        let below = torsion.q(c * (1.0 - 1e-9), c);
        assert!((below / torsion.q(c, c) - 1.0).abs() < 1e-3);
        for x in [0.3 * c, 0.9 * c] {
            // u_y at (x, 0) under q_theta: q_x = -q sin, q_y = q cos of the polar angle.
            let u_y =
                2.0 * over_disc(a, &[c], x, |xi, eta, cos, sin| {
                    let r = xi.hypot(eta);
                    let q = torsion.q(r, c);
                    let (q_x, q_y) = (-q * eta / r, q * xi / r);
                    let nu = material.nu;
                    q_y * (1.0 - nu + nu * sin * sin) + q_x * nu * cos * sin
                }) / (2.0 * PI * material.G());
            let expected = torsion.phi(c) * x;
            assert!((u_y / expected - 1.0).abs() < 1e-6, "{u_y:e} {expected:e}");
        }
    }
}
