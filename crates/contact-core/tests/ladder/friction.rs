//! Friction laws: what a sliding contact must carry.

use contact_core::march::{Fields, Increment, Status};
use contact_core::scene::{
    CellHistory, Friction, FrictionHistory, FrictionLaw, History, LawError, LoadPath, Loads,
    Missing, Scene, SurfaceMap,
};
use ndarray::{Array2, Zip};

use crate::bench::{
    CORK, SMOOTH, STEEL, W, cell, close, hertz_of, indentation, run, sphere_on_flat,
};

const MU: f64 = 0.3;

fn shifted_to(delta_x: f64, delta_y: f64) -> impl FnOnce(&mut Loads) {
    move |to| (to.given.delta_x, to.given.delta_y) = (Some(delta_x), Some(delta_y))
}

fn scene(friction: Friction, path: LoadPath) -> Scene {
    let mut scene = sphere_on_flat(CORK, CORK, MU, (2.3, 48), path);
    scene.friction = friction;
    scene
}

/// The shift at which a sphere pressed by W starts to slide under MU.
fn incipient() -> f64 {
    let scene = scene(Friction::coulomb(MU), indentation(1));
    let hertz = hertz_of(&scene);
    contact_reference::CattaneoMindlin::new(hertz, CORK, CORK, MU).shift_limit()
}

/// Runs the path and checks what every law must keep.
fn audited(scene: &Scene, mut watch: impl FnMut(&Fields, &Increment)) -> Vec<Increment> {
    run(scene, |march, increment| {
        let fields = march.fields();
        let r = increment.residuals;
        assert!(r.balance < 1e-9 && r.coulomb < 1e-9, "{r:?}");
        watch(&fields, increment);
    })
}

#[test]
fn a_map_is_weighed_with_the_pressure() {
    // mu (1 + b r^2/a^2): the mean of r^2 under Hertz's pressure is 2/5 a^2.
    let b = 0.7;
    let plain = scene(Friction::coulomb(MU), indentation(1));
    let a = hertz_of(&plain).a;
    let n = 301;
    let spacing = 2.4 * a / n as f64;
    let values = Array2::from_shape_fn((n, n), |(i, j)| {
        let [x, y] = [i, j].map(|k| (k as f64 - 150.0) * spacing / a);
        1.0 + b * (x * x + y * y)
    });
    let map = SurfaceMap::new(values, (spacing, spacing), Missing::Refuse).unwrap();
    let friction = Friction {
        map: Some(map),
        ..Friction::coulomb(MU)
    };
    let far = 4.0 * incipient();
    let path = indentation(1).change_to(shifted_to(far, 0.0), 4);
    let scene = scene(friction, path);
    let increments = audited(&scene, |_, _| ());
    let end = increments.last().expect("an increment");
    assert_eq!(end.status, Status::GrossSlip);
    let cell = cell(&scene);
    let limit = MU * W * (1.0 + 0.4 * b);
    close(
        "T_x",
        end.point.loads.T_x / limit,
        1.0,
        SMOOTH * cell * cell,
    );
}

#[test]
fn friction_that_grows_with_the_increments_does_so() {
    let table = vec![(1.0, 1.0), (11.0, 2.0)];
    let friction = Friction {
        history: Some(FrictionHistory {
            of: History::Increment,
            table,
        }),
        ..Friction::coulomb(MU)
    };
    let far = 8.0 * incipient();
    let path = indentation(1).change_to(shifted_to(far, 0.0), 12);
    let increments = audited(&scene(friction, path), |_, _| ());
    let mut sliding = 0;
    for i in increments.iter().filter(|i| i.status == Status::GrossSlip) {
        // The coefficient is that of the state that the increment starts from.
        let mu = MU * (1.0 + 0.1 * (i.index - 2) as f64).min(2.0);
        close("T_x", i.point.loads.T_x / (mu * W), 1.0, 1e-9);
        sliding += 1;
    }
    assert!(sliding >= 8, "{sliding}");
}

#[test]
fn friction_follows_the_slip_and_the_energy_of_each_cell() {
    let delta = incipient();
    let path = || indentation(1).change_to(shifted_to(8.0 * delta, 0.0), 10);
    let p_0 = hertz_of(&scene(Friction::coulomb(MU), path())).p0;
    // To 1.5 mu over what slips by 4 delta.
    for (of, full) in [
        (History::Slip, 4.0 * delta),
        (History::Dissipated, 4.0 * delta * MU * p_0),
    ] {
        let friction = Friction {
            history: Some(FrictionHistory {
                of,
                table: vec![(0.0, 1.0), (full, 1.5)],
            }),
            ..Friction::coulomb(MU)
        };
        let scene = scene(friction, path());
        let area = scene.grid.cell_area();
        let mut expected = 0.0;
        let mut sliding = 0;
        audited(&scene, |fields, i| {
            // Slip went one way: its sum is its length.
            let history = match of {
                History::Slip => &fields.slip_x,
                _ => &fields.dissipated,
            };
            let factor = |h: &f64| 1.0 + 0.5 * (h.abs() / full).min(1.0);
            expected = MU
                * area
                * Zip::from(history)
                    .and(&fields.p)
                    .fold(0.0, |sum, h, p| sum + factor(h) * p);
            if i.status == Status::GrossSlip {
                // All slips along x: the sum of mu p, each coefficient that of the history by then,
                // to 1e-3 of itself at most.
                close("T_x", i.point.loads.T_x / expected, 1.0, 1e-3);
                sliding += 1;
            }
        });
        assert!(sliding >= 5, "{sliding}");
        close("T_x/(mu W)", expected / (MU * W), 1.5, 0.1);
    }
}

/// A coefficient that a function of pressure and slip gives.
#[derive(Debug)]
struct Given(fn(f64, f64) -> f64);

impl FrictionLaw for Given {
    fn coefficients(&self, cells: &CellHistory<'_>, mu: &mut [f64]) -> Result<(), LawError> {
        for (n, mu) in mu.iter_mut().enumerate() {
            *mu = (self.0)(cells.p[n], cells.slip[n]);
        }
        Ok(())
    }
}

/// Pressure at which the coefficient of the law of pressure is MU \[Pa\].
const P_MU: f64 = 1e9;

#[test]
fn a_law_of_pressure_is_that_of_the_pressure_at_the_end() {
    // mu = MU p/P: the sum of mu p is MU/P times that of p^2, 3/4 p_H W under Hertz's pressure.
    let law = Given(|p, _| MU * p / P_MU);
    let path = indentation(1).change_to(shifted_to(6.0 * incipient(), 0.0), 6);
    let scene = scene(Friction::from_law(MU, law), path);
    let p_H = hertz_of(&scene).p0;
    let increments = audited(&scene, |_, _| ());
    let end = increments.last().expect("an increment");
    assert_eq!(end.status, Status::GrossSlip);
    let limit = 0.75 * MU * p_H / P_MU * W;
    let cell = cell(&scene);
    close(
        "T_x",
        end.point.loads.T_x / limit,
        1.0,
        SMOOTH * cell * cell,
    );
}

/// Slip over which the coefficient of the law of slip grows to 1.5 MU \[m\].
const FULL: f64 = 4e-5;

#[test]
fn a_law_of_slip_is_that_of_the_slip_at_the_end() {
    let grown = |slip: f64| MU * (1.0 + 0.5 * (slip / FULL).min(1.0));
    let law = Given(|_, slip| MU * (1.0 + 0.5 * (slip / FULL).min(1.0)));
    let path = indentation(1).change_to(shifted_to(8.0 * incipient(), 0.0), 10);
    let scene = scene(Friction::from_law(MU, law), path);
    let area = scene.grid.cell_area();
    let (mut sliding, mut most) = (0, 0.0_f64);
    audited(&scene, |fields, i| {
        // Slip went one way: its sum is its length. All slips along x: the sum of mu p, each
        // coefficient that of the slip by then, to 1e-3 of itself.
        let expected = Zip::from(&fields.slip_x)
            .and(&fields.p)
            .fold(0.0, |sum, slip, p| sum + area * grown(slip.abs()) * p);
        if i.status == Status::GrossSlip {
            close("T_x", i.point.loads.T_x / expected, 1.0, 1e-3);
            sliding += 1;
            most = most.max(i.point.loads.T_x / (MU * W));
        }
    });
    assert!(sliding >= 5, "{sliding}");
    assert!(most > 1.1, "{most}");
}

#[test]
fn a_law_that_gives_no_coefficient_is_refused() {
    for bad in [|_, _| f64::NAN, |_, _| -0.1, |_, _| f64::INFINITY] as [fn(f64, f64) -> f64; 3] {
        let scene = scene(Friction::from_law(MU, Given(bad)), indentation(1));
        let refused = contact_core::march::solve(&scene, &mut ()).expect_err("no coefficient");
        let text = refused.to_string();
        assert!(text.starts_with("friction.law = "), "{text}");
        assert!(
            text.contains("must be a finite coefficient >= 0 in every cell"),
            "{text}"
        );
    }
}

#[test]
fn a_contact_that_has_broken_loose_slides_more_easily() {
    let kinetic = 0.2;
    let friction = Friction {
        kinetic: Some(kinetic),
        ..Friction::coulomb(MU)
    };
    let far = 3.0 * incipient();
    let path = indentation(1).change_to(shifted_to(far, 0.0), 12);
    let increments = audited(&scene(friction, path), |_, _| ());
    let force: Vec<f64> = increments.iter().map(|i| i.point.loads.T_x / W).collect();
    let end = force[force.len() - 1];
    close("T_x/W", end, kinetic, 1e-9);
    let highest = force.iter().copied().fold(0.0, f64::max);
    assert!(highest > 1.1 * kinetic && highest < MU, "{highest}");
}

#[test]
fn an_ellipse_turns_the_force_from_the_slip() {
    let (mu_y, angle) = (0.6 * MU, 0.7_f64);
    let friction = Friction {
        mu_y: Some(mu_y),
        ..Friction::coulomb(MU)
    };
    let (far_x, far_y) = (
        12.0 * incipient() * angle.cos(),
        12.0 * incipient() * angle.sin(),
    );
    let path = indentation(1).change_to(shifted_to(far_x, far_y), 8);
    let increments = audited(&scene(friction.clone(), path), |fields, i| {
        Zip::from(&fields.p)
            .and(&fields.q_x)
            .and(&fields.q_y)
            .for_each(|p, q_x, q_y| {
                assert!(
                    (q_x / MU).hypot(q_y / mu_y) <= p * (1.0 + 1e-9),
                    "at {}",
                    i.index
                );
            });
    });
    // q = -mu^2 ds/|mu ds| p, normal to the ellipse.
    let (x, y) = (MU * angle.cos(), mu_y * angle.sin());
    let (T_x, T_y) = (MU * x / x.hypot(y) * W, mu_y * y / x.hypot(y) * W);
    let end = increments.last().expect("an increment").point.loads;
    assert_eq!(increments[8].status, Status::GrossSlip);
    // Slip takes its direction while the bodies spring back, by the same part of what is left in
    // every increment: what is left at the end is the last change times r/(1 - r).
    for (truth, force) in [
        (T_x, (|l: &Loads| l.T_x) as fn(&Loads) -> f64),
        (T_y, |l| l.T_y),
    ] {
        let at = |k: usize| force(&increments[k].point.loads) / W;
        let (before, last) = (at(7) - at(6), at(8) - at(7));
        let r = last / before;
        assert!((0.1..0.4).contains(&r), "{r}");
        let left = last.abs() * r / (1.0 - r);
        close("T", force(&end) / W, truth / W, 1.1 * left);
    }
    // By force: the ellipse is the limit of both, and beyond it there is no equilibrium.
    let by_force = |part: f64| {
        indentation(1).change_to(move |to| (to.T_x, to.T_y) = (part * T_x, part * T_y), 3)
    };
    let increments = audited(&scene(friction.clone(), by_force(0.95)), |_, _| ());
    assert_eq!(increments[3].status, Status::PartialSlip);
    let mut beyond =
        contact_core::march::March::new(&scene(friction, by_force(1.05))).expect("a scene");
    let refused = std::iter::from_fn(|| beyond.advance()).find_map(Result::err);
    assert!(
        matches!(refused, Some(contact_core::Error::BeyondFriction { .. })),
        "{refused:?}"
    );
}

#[test]
fn a_contact_that_never_slips_is_a_spring() {
    let path = indentation(1)
        .change_to(|to| to.T_x = 5.0 * W, 2)
        .torsion(&[W * 1e-3], 1);
    let mut scene = sphere_on_flat(STEEL, STEEL, f64::INFINITY, (2.2, 96), path);
    scene.friction = Friction::coulomb(f64::INFINITY);
    let a = hertz_of(&scene).a;
    let increments = audited(&scene, |fields, _| assert_eq!(fields.stick, fields.contact));
    // R. D. Mindlin (1949): T = 8 a G* delta with 1/G* = (2 - nu_1)/G_1 + (2 - nu_2)/G_2; torsion
    // M = 16/3 a^3 G phi with 1/G = 1/G_1 + 1/G_2. The rim's infinite traction is cut off within a
    // cell.
    let G = STEEL.G();
    let (shear, twist) = (
        8.0 * a * G / (2.0 * (2.0 - STEEL.nu)),
        16.0 / 3.0 * a.powi(3) * G / 2.0,
    );
    let rim = 0.5 * cell(&scene);
    let (pulled, turned) = (&increments[2], &increments[3]);
    close(
        "T_x/delta_x",
        5.0 * W / pulled.motion.delta_x / shear,
        1.0,
        rim,
    );
    close(
        "M_z/phi_z",
        W * 1e-3 / turned.motion.phi_z / twist,
        1.0,
        2.0 * rim,
    );
}
