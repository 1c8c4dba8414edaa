//! Rolling in three dimensions: Kalker's creepage and spin coefficients, a contact off the middle.

use contact_core::Scene;
use contact_core::march::Increment;
use contact_core::scene::{Elastic, Friction, LoadPath, Loads};
use rayon::prelude::*;

use crate::bench::{CORK, W, close, hertz_of, run, sphere_on_flat};

/// Cells over 2.4 contact radii.
const N: usize = 36;

/// A sphere of `material` on a flat of the same that rolls over twelve contact radii, without slip:
/// after four of them the forces are a twentieth short of the steady ones.
fn rolled(material: Elastic, change: impl Fn(&mut Loads, f64)) -> (Scene, Increment) {
    let mut scene = sphere_on_flat(material, material, 0.3, (2.4, N), LoadPath::start());
    scene.friction = Friction::coulomb(f64::INFINITY);
    let way = (12 * N) * 10 / 24;
    let rolled = way as f64 * scene.grid.dx;
    scene.path = LoadPath::start().normal(W, 1).change_to(
        |to| {
            to.rolled = rolled;
            change(to, rolled);
        },
        way,
    );
    let last = run(&scene, |_, _| ()).pop().expect("an increment");
    (scene, last)
}

/// Without slip the steady forces are linear in the creepages xi, eta and the spin phi (turn per
/// way): T_x = C11 G a^2 xi, T_y = C22 G a^2 eta + C23 G a^3 phi, M_z = -C23 G a^3 eta + ...; the
/// coefficients are those of J. J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact
/// (1990), table E.3, for a circle, to half a unit of their last digit.
#[test]
fn creepage_and_spin_are_kalkers() {
    let quarter = Elastic { E: 210e9, nu: 0.25 };
    let creepage = 1e-5;
    let truths = [(CORK, [3.40, 3.40, 1.33]), (quarter, [4.12, 3.67, 1.47])];
    truths
        .into_par_iter()
        .for_each(|(material, [C11, C22, C23])| {
            let (scene, across) = rolled(material, |to, way| {
                to.given.delta_y = Some(creepage * way);
            });
            let a = hertz_of(&scene).a;
            let unit = material.G() * a * a * creepage;
            // Of like bodies xi gives T_x alone, and phi gives none.
            let (_, along_with_spin) = rolled(material, |to, way| {
                to.given.delta_x = Some(creepage * way);
                to.given.delta_y = Some(0.0);
                to.given.phi_z = Some(creepage / a * way);
            });
            // The traction grows from the leading edge, where the cells enter: the grid leaves 3 per
            // mille.
            let near = |what: &str, found: f64, truth: f64| {
                close(what, found / truth, 1.0, 0.003 + 0.005 / truth);
            };
            near("C11", along_with_spin.point.loads.T_x / unit, C11);
            near("C22", across.point.loads.T_y / unit, C22);
            near("C23", along_with_spin.point.loads.T_y / unit, C23);
            near("C32", -across.point.loads.M_z / unit / a, C23);
            assert!(along_with_spin.point.loads.M_z > 0.0);
        });
}

/// A moment about the rolling direction moves the contact sideways; it goes on rolling, and the
/// energies balance (`run` says so).
#[test]
fn a_tilted_sphere_rolls_beside_the_middle() {
    let mut scene = sphere_on_flat(CORK, CORK, 0.3, (3.2, N), LoadPath::start());
    scene.path = LoadPath::start().normal(W, 2);
    let way = 12;
    let a = hertz_of(&scene).a;
    let (aside, rolled) = (0.2 * a, way as f64 * scene.grid.dx);
    scene.settings.solver.tolerance = Some(1e-8);
    scene.path = LoadPath::start()
        .normal(W, 2)
        .change_to(|to| to.T_x = 0.15 * W, 2)
        .change_to(
            |to| {
                to.given.phi_x = None;
                to.M_x = W * aside;
                to.rolled = rolled;
            },
            way,
        );
    let mut middle = 0.0;
    let last = run(&scene, |march, _| {
        let p = march.fields().p;
        let moment = p.indexed_iter().map(|((_, j), p)| p * scene.grid.y(j));
        middle = moment.sum::<f64>() / p.sum();
    });
    let last = last.last().expect("an increment");
    close("middle", middle / aside, 1.0, 1e-7);
    // A paraboloid that tilts by phi touches where its slope is phi.
    let cell = scene.grid.dx / a;
    close(
        "tilt",
        last.motion.phi_x * crate::bench::R / aside,
        1.0,
        0.5 * cell * cell,
    );
    assert!(last.energy.dissipated > 0.0);
    scene.path.branches[2].to.given.phi_y = None;
    let refused = scene.check().expect_err("a turn about y").to_string();
    assert!(
        refused.contains("M_y") && refused.contains("rolls"),
        "{refused}"
    );
}
