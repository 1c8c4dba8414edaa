//! Partial slip: cycles through the march.

use contact_core::scene::*;
use contact_core::wear::*;

use crate::gross::{archard, run, scene};

#[test]
fn fully_worn_partial_slip() {
    let n = std::env::var("N").map_or(64, |v| v.parse().unwrap());
    let q = std::env::var("Q").map_or(0.5, |v| v.parse().unwrap());
    let per = std::env::var("PER").map_or(8, |v| v.parse().unwrap());
    let tol = std::env::var("TOL").map_or(0.02, |v| v.parse().unwrap());
    let cycles = std::env::var("CYCLES").map_or(1e6, |v| v.parse().unwrap());
    let (R, W, mu) = (10e-3, 50.0, 0.6);
    let elastic = Elastic { E: 200e9, nu: 0.0 };
    let T = q * mu * W;
    let path = LoadPath::start()
        .normal(W, 1)
        .tangential(&[T], per)
        .tangential(&[-T], per)
        .tangential(&[T], per);
    let mut scene = scene(
        Shape::Sphere { R },
        Grid::centred(1e-3, 16).unwrap(),
        path,
        mu,
    );
    (scene.body1.substrate, scene.body2.substrate) = (elastic, elastic);
    let a = scene.hertz().unwrap().a;
    let p0 = scene.hertz().unwrap().p0;
    scene.grid = Grid::centred(2.0 * 1.35 * a, n).unwrap();
    let mut wear = Wear {
        first_branch: 2,
        ..Wear::new([archard(0.5e-13), archard(0.5e-13)], cycles)
    };
    wear.jumps = Jumps::Tolerance(tol);
    let (run, jumps) = run(&scene, &wear);
    let block = run.block();
    let worn = &block.worn1 + &block.worn2;
    let volume = worn.sum() * scene.grid.cell_area();
    let largest = worn.iter().fold(0.0, |m: f64, w| m.max(*w));
    let stick = block.stick.iter().filter(|s| **s).count() as f64 * scene.grid.cell_area();
    let c = (stick / std::f64::consts::PI).sqrt();
    println!(
        "{} jumps: p(0)/p0 {:.5}, c/a {:.5} (cell {:.4}), volume R/a4 {:.5}, largest R/a2 {:.5}, worn in stick {:.2e}, work {:?}",
        jumps.len(),
        block.p[(n / 2, n / 2)] / p0,
        c / a,
        scene.grid.dx / a,
        volume * R / a.powi(4),
        largest * R / a / a,
        worn.indexed_iter()
            .filter(|(i, _)| block.stick[*i])
            .fold(0.0, |m: f64, (_, w)| m.max(*w))
            / largest,
        run.work()
    );
}
