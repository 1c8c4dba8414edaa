//! How fast the shear comes to its limit as the increments of a branch grow in number.

use contact_core::scene::{Elastic, LoadPath, Scene};
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
    scene.settings.solver.slip_rotation_correction = turning;
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

/// A tangential force that goes once around a circle, as many increments as its chords.
fn turned(increments: usize, turning: bool) -> Scene {
    let T = 0.6 * MU * W;
    let path = LoadPath::start()
        .normal(W, 1)
        .ellipse((T, T), 1, increments);
    let mut scene = sphere_on_flat(STEEL, STEEL, MU, (2.3, 32), path);
    scene.settings.solver.slip_rotation_correction = turning;
    scene
}

/// The shear at each quarter of the turn.
fn quarters(scene: &Scene, increments: usize) -> Vec<[Array2<f64>; 2]> {
    let mut quarters = Vec::new();
    run(scene, |march, increment| {
        let chord = increment.point.branch.saturating_sub(1);
        if chord > 0 && chord.is_multiple_of(increments / 4) {
            quarters.push(march.shear());
        }
    });
    quarters
}

#[test]
fn second_order_along_a_path_that_turns() {
    let limit = quarters(&turned(768, true), 768);
    let error = |n: usize, turning: bool| {
        let quarters = quarters(&turned(n, turning), n);
        let pairs = quarters.iter().zip(&limit);
        pairs.fold(0.0, |worst: f64, (q, limit)| worst.max(distance(q, limit)))
    };
    let all = [24, 48, 96].map(|n| error(n, true));
    let order = (all[0] / all[2]).log2() / 2.0;
    assert!(order >= 1.8 && all[0] < 0.01, "{all:?} {order}");
    // At the end alone an increment is a turn of the shear by 15 degrees.
    assert!(error(24, false) > 0.1);
}

/// Indentation of a coated half-space, which sticks: what a cell has moved before it entered
/// remains.
fn indented(increments: usize, entering: bool) -> Scene {
    let scene = sphere_on_flat(STEEL, STEEL, MU, (2.4, 96), indentation(increments));
    let a = hertz_of(&scene).a;
    let mut scene = coated(scene, Elastic { E: 420e9, nu: 0.3 }, a);
    scene.settings.solver.cell_entry_correction = entering;
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
