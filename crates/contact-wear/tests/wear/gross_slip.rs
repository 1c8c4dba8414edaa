//! Late gross slip: the worn scar has forgotten the elasticity, the volume says all.

use std::f64::consts::PI;

use contact_core::scene::{Grid, Scene, Shape};
use contact_wear::{Cycling, Jumps};

use crate::bench::{archard, cylinder, half_width, run, scene, to_and_fro, wear};

/// Both bodies together lose k s W a cycle, s = 4 strokes.
const K: f64 = 2e-13;
/// A body that hardly wears.
const K0: f64 = 1e-15;

/// The gap has grown by what the segment or cap of half-width b of the radius R held, b^2/(2 R)
/// deep: the bodies have lost that and the debris that fills the rest.
fn assert_worn_flat(name: &str, scene: &Scene, cycles: f64, (b, kept): (f64, f64), R: f64) {
    let mut wear = wear(
        [archard(0.5 * K), archard(0.5 * K)],
        cycles,
        Cycling::Sliding,
    );
    wear.debris_kept = kept;
    let (run, jumps) = run(scene, &wear);
    let block = run.block();
    let worn = &block.worn1 + &block.worn2;
    let deepest = worn.iter().fold(0.0, |m: f64, w| m.max(*w));
    let depth = (1.0 - kept) * deepest / (b * b / (2.0 * R));
    let width = half_width(&worn, &scene.grid) / b;
    println!(
        "{name}: depth {depth:.4}, width {width:.4} of the closed form, {} jumps",
        jumps.len()
    );
    assert!((depth - 1.0).abs() < 0.01 && (width - 1.0).abs() < 0.01);
}

#[test]
fn a_cylinder_wears_to_its_closed_form() {
    let (R, W, stroke, cycles): (f64, f64, f64, f64) = (6e-3, 18.5e3, 1e-6, 200e3);
    for (kept, times) in [(0.0, 1.0), (0.85, 6.0)] {
        let cycles = times * cycles;
        // A segment of the area 2 b^3/(3 R).
        let b = (1.5 * R * (1.0 - kept) * K * W * 4.0 * stroke * cycles).cbrt();
        let grid = Grid::strip(2.6 * b, 512, 1.0).unwrap();
        let scene = scene(cylinder(R), grid, to_and_fro(W, stroke, 1), 0.9);
        assert_worn_flat("cylinder", &scene, cycles, (b, kept), R);
    }
}

#[test]
fn a_sphere_wears_to_its_closed_form() {
    let (R, W, stroke, cycles): (f64, f64, f64, f64) = (6e-3, 20.0, 1e-6, 2e6);
    // A cap of the volume pi b^4/(4 R).
    let b = (4.0 * R * K * W * 4.0 * stroke * cycles / PI).powf(0.25);
    let grid = Grid::centred(2.6 * b, 64).unwrap();
    let scene = scene(Shape::Sphere { R }, grid, to_and_fro(W, stroke, 1), 0.9);
    assert_worn_flat("sphere", &scene, cycles, (b, 0.0), R);
}

#[test]
fn the_friction_loop_holds_the_energy_of_a_cycle() {
    let (W, mu, u) = (18.5e3, 0.9, 20e-6);
    let grid = Grid::strip(0.5e-3, 64, 1.0).unwrap();
    let mut scene = scene(cylinder(6e-3), grid, to_and_fro(W, u, 3), mu);
    for stiffness in [f64::INFINITY, mu * W / 5e-6] {
        let mut wear = wear([archard(K0), archard(K0)], 10.0, Cycling::Sliding);
        scene.path.rig_stiffness = Some(stiffness).filter(|given| given.is_finite());
        wear.jumps = Jumps::Number(1);
        let (run, jumps) = run(&scene, &wear);
        let corners = run.block().friction_loop;
        let ways = corners.iter().zip(corners.iter().cycle().skip(1));
        let area = ways
            .map(|(a, b)| 0.5 * (a[1] + b[1]) * (b[0] - a[0]))
            .sum::<f64>();
        let energy = jumps[0].dissipated_per_cycle;
        assert!(
            (area / energy - 1.0).abs() < 1e-6,
            "{area:e} J, {energy:e} J"
        );
        assert!((energy / (mu * W * 4.0 * (u - mu * W / stiffness)) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_contact_that_keeps_all_its_debris_wears_under_the_first_pressure() {
    let (R, W, stroke, cycles): (f64, f64, f64, f64) = (6e-3, 18.5e3, 1e-6, 1e5);
    let grid = Grid::strip(0.4e-3, 128, 1.0).unwrap();
    let scene = scene(cylinder(R), grid, to_and_fro(W, stroke, 1), 0.9);
    // Body 1 keeps its place under the contact.
    let mut wear = wear([archard(K), archard(K0)], cycles, Cycling::Sliding);
    wear.debris_kept = 1.0;
    let (run, jumps) = run(&scene, &wear);
    assert!(jumps.len() == 1, "{} jumps", jumps.len());
    let block = run.block();
    let way = K * 4.0 * stroke * cycles;
    for (worn, p) in block.worn1.iter().zip(&block.p) {
        assert!((worn - way * p).abs() <= 1e-9 * way * jumps[0].p_max);
    }
}
