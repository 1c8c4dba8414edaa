//! Partial slip worn until nothing changes any more: the contact has shrunk to the stick zone
//! (V. L. Popov, Sci. Rep. 4 (2014) 3749; closed forms by the method of
//! dimensionality reduction). W and the amplitude of T are constant, the bodies alike with nu = 0.

use std::f64::consts::PI;

use contact_core::scene::{Elastic, Grid, Scene, Shape};
use contact_core::wear::{Cycling, Jumps};

use crate::bench::{archard, cylinder, pulled, run, scene, wear};

const MU: f64 = 0.6;
const R: f64 = 10e-3;
/// Cells along a side under the sphere.
const N: usize = 96;

fn alike(shape: Shape, W: f64, T: f64, grid: impl Fn(f64) -> Grid) -> Scene {
    let mut scene = scene(shape, grid(1e-3), pulled(W, T, 6), MU);
    let elastic = Elastic { E: 200e9, nu: 0.0 };
    (scene.body1.substrate, scene.body2.substrate) = (elastic, elastic);
    scene.grid = grid(scene.hertz().unwrap().a);
    scene
}

#[test]
fn a_sphere_wears_until_it_rests_on_its_stick_zone() {
    // T/(mu W), c/a, p(0)/p0, worn volume R/a^4, largest depth R/a^2.
    let rows = [(0.5, 0.793_701, 1.058_267, 0.132_158, 0.094_485)];
    for (q, c, p, volume, largest) in rows {
        let W = 50.0;
        let grid = |a: f64| Grid::centred(2.8 * a, N).unwrap();
        let scene = alike(Shape::Sphere { R }, W, q * MU * W, grid);
        let hertz = scene.hertz().unwrap();
        let mut wear = wear([archard(5e-14), archard(5e-14)], 1e6, Cycling::March);
        wear.jumps = Jumps::Tolerance(0.03);
        let (run, jumps) = run(&scene, &wear);
        let block = run.block();
        let worn = &block.worn1 + &block.worn2;
        let (a, area) = (hertz.a, scene.grid.cell_area());
        let in_stick = block.stick.iter().filter(|s| **s).count() as f64;
        let found_c = (in_stick * area / PI).sqrt() / a;
        let found_p = block.p[(N / 2, N / 2)] / hertz.p0;
        let found_volume = worn.sum() * area * R / a.powi(4);
        let found_largest = worn.iter().fold(0.0, |m: f64, w| m.max(*w)) * R / (a * a);
        println!(
            "sphere, T = {q} mu W: c/a {found_c:.4} ({c}), p(0) {found_p:.4} ({p}), volume {found_volume:.4} \
             ({volume}), largest {found_largest:.4} ({largest}), {} jumps, work {:?}",
            jumps.len(),
            run.work()
        );
        assert!((found_c - c).abs() * a < scene.grid.dx);
        assert!((found_p / p - 1.0).abs() < 0.01);
        // The rim of the stick zone lies within an eighth of a cell of where it should: by the closed form
        // volume and depth change by 6.4 and 10.6 times what that is of a.
        let rim = 0.125 * scene.grid.dx / a;
        assert!((found_volume / volume - 1.0).abs() < 6.4 * rim);
        assert!((found_largest / largest - 1.0).abs() < 10.6 * rim);
        let stick = block.stick.iter().zip(&worn).filter(|(stick, _)| **stick);
        assert!(stick.fold(0.0, |m: f64, (_, w)| m.max(*w)) < 1e-9 * worn.sum());
    }
}

#[test]
fn a_cylinder_wears_until_it_rests_on_its_stick_zone() {
    let (W, q): (f64, f64) = (2e5, 0.5);
    let c = (1.0 - q).sqrt();
    let p = 0.5 * (1.0 / c + c);
    let scene = alike(cylinder(R), W, q * MU * W, |a| {
        Grid::strip(3.0 * a, 256, 1.0).unwrap()
    });
    let hertz = scene.hertz().unwrap();
    let wear = wear([archard(5e-14), archard(5e-14)], 1e6, Cycling::March);
    let (run, jumps) = run(&scene, &wear);
    let block = run.block();
    let in_stick = block.stick.iter().filter(|s| **s).count() as f64;
    let found_c = 0.5 * in_stick * scene.grid.dx / hertz.a;
    let found_p = block.p[(128, 0)] / hertz.p0;
    println!(
        "cylinder: c/a {found_c:.4} ({c:.4}), p(0) {found_p:.4} ({p:.4}), {} jumps",
        jumps.len()
    );
    assert!((found_c - c).abs() * hertz.a < scene.grid.dx);
    assert!((found_p / p - 1.0).abs() < 0.01);
}
