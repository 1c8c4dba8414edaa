//! Sliding both ways, and contact lost and found again.

use contact_core::Error;
use contact_core::march::March;
use contact_core::march::{Increment, Status};
use contact_core::scene::{LoadPath, Loads, Scene};
use contact_reference::CattaneoMindlin;

use crate::bench::{CORK, STEEL, W, close, hertz_of, indentation, run, sphere_on_flat};

const MU: f64 = 0.3;

fn shifted_to(delta_x: f64) -> impl FnOnce(&mut Loads) {
    move |to| to.given.delta_x = Some(delta_x)
}

fn scene(path: LoadPath) -> Scene {
    sphere_on_flat(CORK, CORK, MU, (2.3, 48), path)
}

/// The shift at which a sphere pressed by W slides.
fn sliding_shift() -> f64 {
    let scene = scene(indentation(1));
    CattaneoMindlin::new(hertz_of(&scene), CORK, CORK, MU).shift_limit()
}

#[test]
fn a_given_shift_draws_the_trapezoid_of_gross_slip() {
    let delta = 5.05 * sliding_shift();
    let path = indentation(1)
        .change_to(shifted_to(delta), 20)
        .change_to(shifted_to(-delta), 40)
        .change_to(shifted_to(delta), 40);
    let scene = scene(path);
    let tolerance = scene.tolerance();
    let increments = run(&scene, |_, _| ());
    let limit = MU * W;
    let gross = |i: &&Increment| i.status == Status::GrossSlip;
    for i in increments.iter().filter(gross) {
        close(
            "T_x in gross slip",
            i.point.loads.T_x.abs() / limit,
            1.0,
            1e-9,
        );
    }
    // A sphere slides from the limit on, after a reversal from twice the limit on: at increments of
    // delta/20 from the 4th and from the 8th.
    assert_eq!(increments.iter().filter(gross).count(), 17 + 33 + 33);
    // The loop is a trapezoid: the area is 4 mu W delta less what the elastic flanks take.
    let cycle = &increments[21..];
    let dissipated: f64 = cycle.iter().map(|i| i.energy.dissipated).sum();
    let work: f64 = cycle.iter().map(|i| i.energy.work).sum();
    let quadrature: f64 = cycle.iter().map(|i| i.energy.quadrature).sum();
    close(
        "work of the loop",
        (work + quadrature) / dissipated,
        1.0,
        tolerance,
    );
    // Flanks: E_d = 4 mu W (delta - delta_flank) with the energy of gross slip incipient, 0.2.
    let elastic = 4.0 * limit * sliding_shift() * (1.0 - 0.2);
    let expected = 4.0 * limit * delta - elastic;
    close("energy of the loop", dissipated / expected, 1.0, 5e-3);
    for i in &increments {
        // In stick cells the slip that the tolerance leaves may go either way.
        assert!(
            i.energy.dissipated >= -tolerance * limit * sliding_shift(),
            "friction gives energy"
        );
        assert!(i.residuals.energy.abs() < tolerance && i.residuals.balance < 1e-9);
    }
}

#[test]
fn the_force_at_its_limit_slides() {
    let path = indentation(1).tangential(&[MU * W, -MU * W], 6);
    for i in run(&scene(path), |_, _| ()) {
        let at_limit = i.point.loads.T_x.abs() == MU * W;
        assert_eq!(i.status == Status::GrossSlip, at_limit, "{}", i.index);
    }
}

#[test]
fn loads_beyond_friction_are_named() {
    // The limit of a given approach is known only when it is solved.
    let a = hertz_of(&scene(indentation(1)));
    let path = LoadPath::start()
        .change_to(|to| to.given.delta_z = Some(a.delta_z), 1)
        .change_to(|to| to.T_x = 1.1 * MU * W, 2);
    let mut march = March::new(&scene(path)).expect("a scene");
    let outcome: Vec<_> = std::iter::from_fn(|| march.advance()).take(3).collect();
    assert!(outcome[1].is_ok());
    match &outcome[2] {
        Err(Error::BeyondFriction { increment: 3, used }) => close("used", *used, 1.1, 0.01),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_given_approach_is_a_given_force() {
    let by_force = scene(indentation(5).tangential(&[0.5 * MU * W], 3));
    let forces = run(&by_force, |_, _| ());
    let mut path = LoadPath::start();
    for i in &forces {
        let (delta_z, delta_x) = (i.motion.delta_z, i.motion.delta_x);
        path = path.change_to(
            |to| {
                to.given.delta_z = Some(delta_z);
                to.given.delta_x = Some(delta_x);
            },
            1,
        );
    }
    let by_motion = scene(path);
    let motions = run(&by_motion, |_, _| ());
    // An approach or a shift that is off by the tolerance of both runs is off in force by some
    // times that.
    let known = 10.0 * by_motion.tolerance();
    for (f, m) in forces.iter().zip(&motions) {
        close("W", m.point.loads.W / f.point.loads.W, 1.0, known);
        close(
            "T_x",
            (m.point.loads.T_x - f.point.loads.T_x) / W,
            0.0,
            known,
        );
        // The rim follows from the pressure a few cells inside, a tenth of the largest; in a
        // contact of a few cells the stencil that it is extrapolated with depends on the last
        // digits.
        if f.contact_radius > 8.0 * by_force.grid.dx {
            close("area", m.contact_area / f.contact_area, 1.0, 10.0 * known);
        }
    }
}

#[test]
fn contact_is_lost_and_found_again() {
    for given in [false, true] {
        let press = |part: f64| {
            move |to: &mut Loads| {
                to.T_x = 0.0;
                if given {
                    to.given.delta_z = Some(part * 4e-6);
                } else {
                    to.W = part * W;
                }
            }
        };
        let path = LoadPath::start()
            .change_to(press(1.0), 3)
            .change_to(press(if given { -0.5 } else { 0.0 }), 3)
            .change_to(press(1.0), 3);
        let mut scene = sphere_on_flat(STEEL, CORK, MU, (3.4, 40), path);
        scene.settings.solver.tolerance = Some(1e-7);
        let increments = run(&scene, |_, _| ());
        let (first, parted, again) = (&increments[2], &increments[5], &increments[8]);
        assert_eq!(parted.status, Status::NoContact);
        assert!(parted.contact_area + parted.point.loads.W <= 0.0);
        for i in [first, again] {
            assert!(i.contact_area > 0.0);
        }
        close("W", again.point.loads.W / first.point.loads.W, 1.0, 1e-3);
        close("p_max", again.p_max / first.p_max, 1.0, 1e-3);
        for i in &increments {
            assert!(i.residuals.energy.abs() < 1e-6, "{:?}", i.residuals);
        }
    }
}
