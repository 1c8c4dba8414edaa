//! Two quadratures of what friction takes: the mean bound, which is reported, and the mean shear,
//! with which the energy balances. They differ by what cells slip in the increment in which they
//! stop sticking or leave; the difference goes with the increments, and so does what cells take
//! that open or close.
//!
//! A cell at the distance s inside the rim of slip, which an increment moved by w, has slipped by
//! s^(3/2) and lacked s^(1/2) of its bound before (Cattaneo): the difference is of the order of
//! w^3, and the sum over the path of w^2. On a grid, cells stop sticking one by one, and the sum
//! over them scatters while an increment moves the rim by less than a cell.

use contact_core::Scene;
use contact_core::scene::{Elastic, LoadPath};
use contact_reference::CattaneoMindlin;

use crate::bench::{
    CORK, FIELD, STEEL, W, cell, close, coated, hertz_of, indentation, run,
    run_without_growth_steps, sphere_on_flat,
};

const MU: f64 = 0.3;
/// Tolerance of the solver where sums of many increments are compared.
const TIGHT: f64 = 1e-9;

/// Sums over the path of |quadrature| and |opening|, and the sum of the dissipation \[J\].
fn sums(scene: &Scene) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for i in run_without_growth_steps(scene) {
        sums[0] += i.energy.quadrature.abs();
        sums[1] += i.energy.opening.abs();
        sums[2] += i.energy.dissipated;
    }
    sums
}

/// W to and fro with T: cells enter, leave, stick, slip and turn.
fn mixed(scene: fn(LoadPath) -> Scene, increments: usize) -> Scene {
    let path = indentation(increments)
        .change_to(|to| (to.W, to.T_x) = (W, 0.6 * MU * W), increments)
        .change_to(|to| (to.W, to.T_x) = (0.5 * W, -0.3 * MU * W), increments)
        .change_to(|to| (to.W, to.T_x) = (W, 0.4 * MU * W), increments);
    scene(path)
}

fn similar(path: LoadPath) -> Scene {
    sphere_on_flat(CORK, CORK, MU, (2.3, 64), path)
}

fn dissimilar(path: LoadPath) -> Scene {
    let upper = Elastic { E: 70e9, nu: 0.2 };
    let scene = sphere_on_flat(upper, STEEL, MU, (2.6, 64), path);
    let a = hertz_of(&scene).a;
    coated(scene, Elastic { E: 420e9, nu: 0.25 }, 0.5 * a)
}

#[test]
fn quadratures_of_dissipation_meet() {
    for scene in [similar, dissimilar] {
        let all = [8, 16, 32].map(|n| sums(&mixed(scene, n)));
        for pair in all.windows(2) {
            // A quarter, and a tenth of it for the terms of higher order and the cells.
            for k in 0..2 {
                let fall = pair[1][k] / pair[0][k];
                assert!(fall < 0.25 * 1.1, "{pair:?}: {fall}");
            }
            // What it is a rule for moves by as much, at most.
            let moved = (pair[1][2] - pair[0][2]).abs();
            assert!(moved < pair[0][0] + pair[0][1], "{pair:?}");
        }
        let [quadrature, opening, dissipated] = all[2];
        assert!(quadrature + opening < 0.08 * dissipated, "{:?}", all[2]);
    }
}

/// Under constant pressure the mean bound is exact in a single increment, the mean shear in none.
#[test]
fn the_mean_bound_is_exact_under_constant_pressure() {
    let part = 0.8;
    let loop_of = |increments| {
        let path = LoadPath::start()
            .normal(W, 1)
            .tangential(&[part * MU * W, -part * MU * W, part * MU * W], increments);
        let mut scene = similar(path);
        scene.settings.solver.tolerance = Some(TIGHT);
        let mut sums = [0.0; 2];
        for i in run(&scene, |_, _| ()).iter().filter(|i| i.point.branch > 1) {
            sums[0] += i.energy.dissipated;
            sums[1] += i.energy.dissipated - i.energy.quadrature;
        }
        sums
    };
    let scene = similar(LoadPath::start().normal(W, 1));
    let truth = CattaneoMindlin::new(hertz_of(&scene), CORK, CORK, MU).loop_energy(part * MU * W);
    let [one, sixteen] = [1, 16].map(loop_of);
    // In each increment the slip may be off by the tolerance, under the whole shear.
    let off = 34.0 * TIGHT * MU * W * hertz_of(&scene).delta_z;
    close(
        "increments",
        one[0] / truth,
        sixteen[0] / truth,
        off / truth,
    );
    close("loop energy", one[0] / truth, 1.0, FIELD * cell(&scene));
    // In one increment the mean shear of a reversal is none; in sixteen it is low by some w^2.
    assert!(one[1].abs() < 1e-9 * truth, "{one:?}");
    let low = 1.0 - sixteen[1] / truth;
    assert!((0.01..0.05).contains(&low), "{low}");
}
