//! Tilting moments: flat and conformal contacts.

use contact_core::march::Status;
use contact_core::scene::{Grid, LoadPath, Shape};

use crate::bench::{CORK, R, STEEL, W, close, hertz_of, indentation, run, sphere_on_flat};

#[test]
fn a_moment_moves_the_contact_of_a_sphere() {
    // A tilted paraboloid is a shifted one: the contact follows the force's line of action.
    let (e_x, e_y) = (0.31, -0.22);
    let scene = sphere_on_flat(STEEL, STEEL, 0.0, (3.2, 64), indentation(3));
    let a = hertz_of(&scene).a;
    let mut tilted = scene.clone();
    tilted.path = indentation(1).change_to(
        |to| {
            to.given.phi_x = None;
            to.given.phi_y = None;
            to.M_x = W * e_y * a;
            to.M_y = -W * e_x * a;
        },
        3,
    );
    let increments = run(&tilted, |_, _| ());
    let end = increments.last().expect("an increment");
    let straight = run(&scene, |_, _| ());
    let reference = straight.last().expect("an increment");
    // Rolled to (e_x, e_y): phi_y = -e_x/R, phi_x = e_y/R, and the approach is lower by e^2/(2R).
    close("phi_y", end.motion.phi_y * R / a, -e_x, 2e-3);
    close("phi_x", end.motion.phi_x * R / a, e_y, 2e-3);
    let lowered = (e_x * e_x + e_y * e_y) * a * a / (2.0 * R);
    close(
        "delta_z",
        (end.motion.delta_z + lowered) / reference.motion.delta_z,
        1.0,
        2e-3,
    );
    for i in &increments {
        assert!(i.residuals.balance < 1e-9, "{:e}", i.residuals.balance);
        assert!(
            i.residuals.energy.abs() < scene.tolerance(),
            "{:e}",
            i.residuals.energy
        );
    }
}

#[test]
fn a_flat_punch_balances_its_moments() {
    let a = 1e-3;
    let mut scene = sphere_on_flat(STEEL, CORK, 0.3, (2.6, 48), LoadPath::start());
    scene.grid = Grid::centred(2.6 * a, 48).expect("a grid");
    scene.body1.shape = Shape::FlatPunch {
        radius: 0.8 * a,
        edge: 0.02,
    };
    scene.path = LoadPath::start().normal(W, 2).change_to(
        |to| {
            (to.given.phi_x, to.given.phi_y) = (None, None);
            (to.M_x, to.M_y) = (0.1 * W * a, 0.15 * W * a);
            to.T_x = 0.5 * 0.3 * W;
        },
        3,
    );
    let mut eccentric = [0.0; 2];
    let increments = run(&scene, |march, increment| {
        let (fields, grid) = (march.fields(), &march.scene().grid);
        eccentric = [0.0; 2];
        for ((i, j), p) in fields.p.indexed_iter() {
            eccentric[0] += p * grid.y(j) * grid.cell_area();
            eccentric[1] -= p * grid.x(i) * grid.cell_area();
        }
        assert!(
            increment.residuals.balance < 1e-9,
            "{:?}",
            increment.residuals
        );
    });
    let end = increments.last().expect("an increment");
    assert_ne!(end.status, Status::NoContact);
    close("M_x", eccentric[0] / (W * a), 0.1, 1e-9);
    close("M_y", eccentric[1] / (W * a), 0.15, 1e-9);
    // The side that carries more is pressed in deeper.
    assert!(end.motion.phi_x > 0.0 && end.motion.phi_y > 0.0);
}

/// A ball in a seat a tenth wider: moments move the wide contact as they do that of a ball on a
/// flat, by M/W.
#[test]
fn a_conformal_contact_balances_its_moments() {
    let mut scene = sphere_on_flat(STEEL, STEEL, 0.3, (3.2, 64), indentation(2));
    scene.body2.shape = Shape::Sphere { R: -1.1 * R };
    let a = hertz_of(&scene).a;
    scene.grid = Grid::centred(3.2 * a, 64).expect("a grid");
    let (e_x, e_y) = (0.25, -0.1);
    scene.path = scene.path.change_to(
        |to| {
            (to.given.phi_x, to.given.phi_y) = (None, None);
            (to.M_x, to.M_y) = (e_y * W * a, -e_x * W * a);
            to.T_x = 0.4 * 0.3 * W;
        },
        3,
    );
    let mut place = [0.0; 2];
    let increments = run(&scene, |march, increment| {
        let (fields, grid) = (march.fields(), &march.scene().grid);
        let first = |arm: &dyn Fn(usize, usize) -> f64| -> f64 {
            let moments = fields.p.indexed_iter().map(|((i, j), p)| p * arm(i, j));
            moments.sum::<f64>() * grid.cell_area()
        };
        place = [first(&|i, _| grid.x(i)), first(&|_, j| grid.y(j))].map(|m| m / (W * a));
        assert!(
            increment.residuals.balance < 1e-9,
            "{:?}",
            increment.residuals
        );
    });
    close("M_y", place[0], e_x, 1e-9);
    close("M_x", place[1], e_y, 1e-9);
    // A tilted paraboloid is a shifted one: phi = e a/R of the pair.
    let curvature = 1.0 / R - 1.0 / (1.1 * R);
    let end = increments.last().expect("an increment");
    close("phi_y", end.motion.phi_y / (a * curvature), -e_x, 2e-3);
    close("phi_x", end.motion.phi_x / (a * curvature), e_y, 2e-3);
}
