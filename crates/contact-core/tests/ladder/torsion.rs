//! Torsion under constant normal force: Lubkin, exact for every nu.

use contact_core::march::Status;
use contact_core::scene::{LoadPath, Loads, Scene};
use contact_reference::Lubkin;

use crate::bench::{STEEL, W, cell, close, hertz_of, indentation, radius, run, sphere_on_flat};

const MU: f64 = 0.3;
const N: usize = 256;
/// Rows of stick radius over contact radius.
const ROWS: [f64; 3] = [0.9, 0.5, 0.1];
/// Error allowed of the rotation and of the moment, relative.
const GLOBAL: f64 = 5e-3;

fn scene(path: LoadPath) -> (Scene, Lubkin) {
    let scene = sphere_on_flat(STEEL, STEEL, MU, (2.2, N), path);
    let lubkin = Lubkin::new(hertz_of(&scene), STEEL, STEEL, MU);
    (scene, lubkin)
}

fn pressed() -> LoadPath {
    indentation(1)
}

fn turned_to(phi_z: f64) -> impl FnOnce(&mut Loads) {
    move |to| to.given.phi_z = Some(phi_z)
}

#[test]
fn the_rows_of_lubkin() {
    let (_, lubkin) = scene(pressed());
    let a = lubkin.hertz.a;
    // One increment per row: the traction of a monotonic torsion does not depend on the steps.
    let path = ROWS
        .into_iter()
        .fold(pressed(), |path, c| path.torsion(&[lubkin.M_z(c * a)], 1));
    let (scene, _) = scene(path);
    let increments = run(&scene, |march, increment| {
        if increment.index == 1 {
            return;
        }
        // q_theta in the row y = 0+ of cells.
        let c = ROWS[increment.index - 2] * a;
        let (fields, grid) = (march.fields(), &scene.grid);
        let (mut squares, mut scale) = (0.0, 0.0);
        for ((i, j), p) in fields.p.indexed_iter() {
            let (x, y) = (grid.x(i), grid.y(j));
            let r = x.hypot(y);
            if r < a && (i + j) % 7 == 0 {
                let q_theta = (x * fields.q_y[(i, j)] - y * fields.q_x[(i, j)]) / r;
                squares += (q_theta - lubkin.q(r, c)).powi(2);
                scale += (MU * p).powi(2);
            }
        }
        let error = (squares / scale).sqrt();
        assert!(
            error < 2.0 * crate::bench::FIELD * cell(&scene),
            "q off by {error}"
        );
    });
    for (increment, c) in increments[1..].iter().zip(ROWS) {
        let c = c * a;
        let phi_z = increment.motion.phi_z;
        close("phi_z", phi_z / lubkin.phi(c), 1.0, GLOBAL);
        close(
            "stick radius",
            radius(increment.stick_area) / a,
            c / a,
            crate::bench::RIM * cell(&scene),
        );
    }
}

#[test]
fn small_stick_zones_keep_their_radius() {
    // Five to eleven cells: before the middle of a line the level is no parabola.
    for n in [128, 160, 256] {
        let lubkin = scene(pressed()).1;
        let c = 0.1 * lubkin.hertz.a;
        let path = pressed().torsion(&[lubkin.M_z(c)], 1);
        let scene = sphere_on_flat(STEEL, STEEL, MU, (2.3, n), path);
        let increments = run(&scene, |_, _| ());
        let end = increments.last().expect("an increment");
        let off = (radius(end.stick_area) - c) / scene.grid.dx;
        assert!(off.abs() < 0.13, "{n}: off by {off} cells");
    }
}

#[test]
fn the_torque_of_full_slip() {
    let (_, lubkin) = scene(pressed());
    let a = lubkin.hertz.a;
    let phi = lubkin.phi(0.01 * a);
    let path = pressed()
        .change_to(turned_to(0.5 * phi), 1)
        .change_to(turned_to(20.0 * phi), 1);
    let (scene, _) = scene(path);
    let increments = run(&scene, |_, _| ());
    let end = increments.last().expect("an increment");
    assert_eq!(end.status, Status::GrossSlip);
    close("M_z", end.point.loads.M_z / lubkin.M_limit(), 1.0, 2e-3);
}

#[test]
fn torque_given_is_rotation_given() {
    let (_, lubkin) = scene(pressed());
    let M_z = 0.8 * lubkin.M_limit();
    let (mut by_moment, _) = scene(pressed().torsion(&[M_z, -M_z], 9));
    by_moment.grid = contact_core::scene::Grid::centred(2.2 * lubkin.hertz.a, 48).expect("a grid");
    by_moment.settings.solver.tolerance = Some(1e-8);
    let moments = run(&by_moment, |_, _| ());
    let mut by_rotation = by_moment.clone();
    by_rotation.path = pressed();
    for increment in &moments[1..] {
        by_rotation.path = by_rotation
            .path
            .change_to(turned_to(increment.motion.phi_z), 1);
    }
    let rotations = run(&by_rotation, |_, _| ());
    for (m, r) in moments.iter().zip(&rotations) {
        close(
            "M_z",
            r.point.loads.M_z / M_z,
            m.point.loads.M_z / M_z,
            1e-6,
        );
        close("W", r.point.loads.W / W, 1.0, 1e-12);
        assert!(m.residuals.energy.abs() < 1e-7 && r.residuals.energy.abs() < 1e-7);
        assert!(m.energy.dissipated >= 0.0 && m.residuals.balance < 1e-9);
    }
}
