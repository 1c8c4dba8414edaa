//! Late gross slip: the worn scar has forgotten the elasticity, the volume says all.

use std::f64::consts::PI;

use contact_core::scene::{Grid, Scene, Shape};
use contact_core::wear::Cycling;

use crate::bench::{archard, cylinder, half_width, run, scene, to_and_fro, wear};

/// Both bodies together lose k s W a cycle, s = 4 strokes.
const K: f64 = 2e-13;

/// Both bodies together have lost what the segment or cap of half-width b of the radius R held, b^2/(2 R) deep.
fn assert_worn_flat(name: &str, scene: &Scene, cycles: f64, b: f64, R: f64) {
    let wear = wear(
        [archard(0.5 * K), archard(0.5 * K)],
        cycles,
        Cycling::Sliding,
    );
    let (run, jumps) = run(scene, &wear);
    let block = run.block();
    let worn = &block.worn1 + &block.worn2;
    let depth = worn.iter().fold(0.0, |m: f64, w| m.max(*w)) / (b * b / (2.0 * R));
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
    // A segment of the area 2 b^3/(3 R).
    let b = (1.5 * R * K * W * 4.0 * stroke * cycles).cbrt();
    let grid = Grid::strip(2.6 * b, 512, 1.0).unwrap();
    let scene = scene(cylinder(R), grid, to_and_fro(W, stroke, 1), 0.9);
    assert_worn_flat("cylinder", &scene, cycles, b, R);
}

#[test]
fn a_sphere_wears_to_its_closed_form() {
    let (R, W, stroke, cycles): (f64, f64, f64, f64) = (6e-3, 20.0, 1e-6, 2e6);
    // A cap of the volume pi b^4/(4 R).
    let b = (4.0 * R * K * W * 4.0 * stroke * cycles / PI).powf(0.25);
    let grid = Grid::centred(2.6 * b, 64).unwrap();
    let scene = scene(Shape::Sphere { R }, grid, to_and_fro(W, stroke, 1), 0.9);
    assert_worn_flat("sphere", &scene, cycles, b, R);
}
