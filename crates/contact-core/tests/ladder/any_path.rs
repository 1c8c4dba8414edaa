//! W and T together along arbitrary paths: the one-dimensional springs.

use contact_core::scene::{Branch, LoadPath, Loads, Scene, Spacing};
use contact_reference::{Springs, hertz};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngSeed, TestRunner};

use crate::bench::{CORK, R, W, run, sphere_on_flat};

const MU: f64 = 0.3;
/// Waypoints of a path and increments between two of them.
const WAYPOINTS: usize = 20;
/// Error allowed of the shift over its range.
const ALLOWED: f64 = 5e-3;

/// Waypoints (W, T).
fn waypoints() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let point = (0.2..1.0f64, -0.95..0.95f64).prop_map(|(w, t)| (w * W, t * w * MU * W));
    prop::collection::vec(point, WAYPOINTS)
}

fn scene(points: &[(f64, f64)], increments: usize, n: usize) -> Scene {
    let mut path = LoadPath::start();
    for (i, &(load, T_x)) in points.iter().enumerate() {
        path = path.push_branch(Branch {
            to: Loads {
                W: load,
                T_x,
                ..Loads::default()
            },
            increments: Some(increments),
            // From nothing the contact grows like the cube root of W.
            spacing: if i == 0 {
                Spacing::EqualRadius
            } else {
                Spacing::Uniform
            },
            t_end: i as f64 + 1.0,
            path_error: None,
        });
    }
    sphere_on_flat(CORK, CORK, MU, (2.3, n), path)
}

/// Largest difference of the shift from the springs' over the range of the shift.
fn error(points: &[(f64, f64)], increments: usize, n: usize) -> f64 {
    let scene = scene(points, increments, n);
    let largest = hertz(R, CORK, CORK, W);
    let mut springs = Springs::new(largest, R, CORK, CORK, MU, 1500);
    let (mut worst, mut range, mut from) = (0.0_f64, [0.0_f64; 2], (0.0, 0.0));
    run(&scene, |_, increment| {
        let to = (increment.point.loads.W, increment.point.loads.T_x);
        let shift = springs.load(from, to, 120 / increments);
        from = to;
        worst = worst.max((increment.motion.delta_x - shift).abs());
        range = [range[0].min(shift), range[1].max(shift)];
    });
    worst / (range[1] - range[0])
}

#[test]
fn the_shift_follows_the_springs() {
    let config = Config {
        rng_seed: RngSeed::Fixed(7),
        ..Config::default()
    };
    let mut runner = TestRunner::new(config);
    for n in 0..5 {
        let points = waypoints().new_tree(&mut runner).expect("a path").current();
        let fine = error(&points, 60, 40);
        assert!(fine < ALLOWED, "path {n}: {fine}");
        // What enters the contact counts from its entry: a third of the increments do as well.
        let coarse = error(&points, 20, 40);
        assert!(coarse < ALLOWED, "path {n}: {coarse}");
    }
}
