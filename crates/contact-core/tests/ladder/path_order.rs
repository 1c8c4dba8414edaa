//! How fast the shear comes to its limit as the increments of a branch grow in number.

use contact_core::scene::{Elastic, Increments, LoadPath, Scene};
use ndarray::Array2;

use crate::bench::{STEEL, W, coated, hertz_of, indentation, norm, run, sphere_on_flat};

const MU: f64 = 0.3;

/// Shear at the end of a path, (q_x, q_y).
fn shear(scene: &Scene) -> [Array2<f64>; 2] {
    let mut q = None;
    run(scene, |march, _| {
        let fields = march.fields();
        q = Some([fields.q_x, fields.q_y]);
    });
    q.expect("an increment")
}

fn distance(a: &[Array2<f64>; 2], b: &[Array2<f64>; 2]) -> f64 {
    let off = norm(&(&a[0] - &b[0])).hypot(norm(&(&a[1] - &b[1])));
    off / norm(&b[0]).hypot(norm(&b[1]))
}

/// Errors with each number of increments, against the last.
fn errors(scene: impl Fn(usize) -> Scene, increments: &[usize], limit: usize) -> Vec<f64> {
    let limit = shear(&scene(limit));
    let error = |n: &usize| distance(&shear(&scene(*n)), &limit);
    increments.iter().map(error).collect()
}

fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

/// A coated sphere pushed and pulled back: slip turns as the stick zone shrinks.
fn fretted(increments: usize, turning: bool) -> Scene {
    let path = LoadPath::start()
        .normal(W, 1)
        .tangential(&[0.8 * MU * W, -0.8 * MU * W], 3 * increments);
    let scene = sphere_on_flat(STEEL, STEEL, MU, (2.4, 48), path);
    let a = hertz_of(&scene).a;
    let mut scene = coated(scene, Elastic { E: 420e9, nu: 0.3 }, a);
    scene.settings.solver.turning = turning;
    scene
}

#[test]
fn second_order_in_the_increments_of_a_tangential_branch() {
    let all = errors(|n| fretted(n, true), &[5, 10, 20], 160);
    let orders = orders(&all);
    assert!(
        orders.iter().all(|&order| order >= 1.5),
        "{all:?} {orders:?}"
    );
    let plain = errors(|n| fretted(n, false), &[10, 20], 160);
    assert!(all[2] < 0.5 * plain[1], "{all:?} {plain:?}");
}

/// A tangential force that goes round, as many increments as its chords: once around a circle, or through an
/// eight.
fn turned(increments: usize, eight: bool, turning: bool) -> Scene {
    let T = 0.6 * MU * W;
    let start = LoadPath::start().normal(W, 1);
    let path = if eight {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / increments as f64;
            vec![1.3 * T * angle.cos(), 0.9 * T * (2.0 * angle).sin()]
        };
        let start = start.tangential(&[1.3 * T], increments / 4);
        let rows: Vec<_> = (1..=increments).map(at).collect();
        let around = start.waypoints(&["T_x", "T_y"], &rows, Increments::Each(1));
        around.expect("a path")
    } else {
        start.ellipse((T, T), 1, increments)
    };
    let mut scene = sphere_on_flat(STEEL, STEEL, MU, (2.3, 32), path);
    scene.settings.solver.turning = turning;
    scene
}

#[test]
fn second_order_along_paths_that_turn() {
    for (eight, largest) in [(false, 5e-3), (true, 4e-2)] {
        let all = errors(|n| turned(n, eight, true), &[24, 48, 96], 768);
        let orders = orders(&all);
        let second = (all[0] / all[2]).log2() / 2.0;
        assert!(second >= 1.8 && all[0] < largest, "{all:?} {orders:?}");
        let plain = distance(
            &shear(&turned(96, eight, false)),
            &shear(&turned(768, eight, true)),
        );
        assert!(all[1] < 0.5 * plain, "{all:?} {plain}");
    }
}

/// Indentation of a coated half-space, which sticks: what a cell has moved before it entered remains.
fn indented(increments: usize, entering: bool) -> Scene {
    let scene = sphere_on_flat(STEEL, STEEL, MU, (2.4, 96), indentation(increments));
    let a = hertz_of(&scene).a;
    let mut scene = coated(scene, Elastic { E: 420e9, nu: 0.3 }, a);
    scene.settings.solver.entering = entering;
    scene
}

#[test]
fn few_increments_of_an_indentation_come_near_its_limit() {
    let all = errors(|n| indented(n, true), &[10, 20, 40], 320);
    let limit = shear(&indented(320, true));
    let plain = distance(&shear(&indented(80, false)), &limit);
    // A third of the increments for a better answer; then cells enter one by one, which is what the
    // grid resolves.
    assert!(all[1] < plain && all[2] < 0.5 * plain, "{all:?} {plain:?}");
}
