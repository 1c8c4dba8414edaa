//! Increments chosen for an error of the path: is the error what it is said to be?
//!
//! Random coated scenes, each as it is run by default against a path of eight times the increments
//! that were chosen, solved to a tolerance of 1e-6. A few in the test, among them two indentations
//! of dissimilar bodies whose error falls with the first power of the increments;
//! `FRET_PATH_ERRORS=50` for as many (`make path-errors`).

#![allow(clippy::print_stdout, reason = "a report for people")]

mod splitmix;

use std::fmt::Write as _;
use std::sync::Arc;

use contact_core::estimate::choose_increments;
use contact_core::march::March;
use contact_core::scene::{LoadPath, Scene, Spacing};
use ndarray::Array2;
use splitmix::Draw;

/// True error over estimate: within this in nine of ten scenes.
const HONEST: (f64, f64) = (0.2, 1.5);
/// Increments of the reference over those chosen, and its tolerance.
const FINER: usize = 8;
const TOLERANCE: f64 = 1e-6;

/// A sphere on a coated half-space, fretted.
fn scene(seed: u64) -> Scene {
    let mut draw = Draw(seed);
    let mut text = String::from("schema = 1\n");
    let (nu_1, nu_2) = (draw.next() * 0.45, draw.next() * 0.45);
    let _ = write!(
        text,
        "[body1]\nshape.sphere.R = 0.01\nE = 210e9\nnu = {nu_1:.4}\n[body2]\nshape = \"flat\"\nE = {:e}\nnu = {:.4}\n",
        draw.between(50e9, 800e9),
        draw.next() * 0.45,
    );
    if draw.next() < 0.7 {
        let _ = write!(
            text,
            "[[body2.coatings]]\nE = {:e}\nnu = {nu_2:.4}\nthickness = {{ a_H = {} }}\n",
            draw.between(50e9, 800e9),
            draw.between(0.1, 2.0),
        );
    }
    let n = if draw.next() < 0.3 { 128 } else { 64 };
    let mu = draw.between(0.1, 0.8);
    let _ = write!(
        text,
        "[friction]\nmu = {mu}\n[grid]\nn = {n}\nextent = {{ a_H = 3.0 }}\n"
    );
    let tolerance = draw.between(3e-3, 2e-2);
    let _ = write!(text, "[solver]\npath_tolerance = {tolerance}\n");
    let (W, T) = (100.0, draw.between(0.3, 0.95));
    let _ = write!(text, "[[path]]\nW = {W}\n");
    for sign in [1.0, -1.0, 1.0] {
        let part = sign * T;
        let _ = write!(text, "[[path]]\nT_x = {{ mu_W = {part} }}\n");
    }
    if draw.next() < 0.3 {
        let _ = write!(text, "[[path]]\nW = {}\nT_x = {{ mu_W = 0.2 }}\n", 0.8 * W);
    }
    Scene::from_toml_str(&text, "drawn", &[]).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// The shear at the ends of the branches of a path, solved to a tolerance.
fn ends(scene: &Scene, path: &LoadPath, tolerance: f64) -> Vec<[Array2<f64>; 2]> {
    let mut scene = scene.clone();
    scene.path = path.clone();
    scene.settings.solver.tolerance = Some(tolerance);
    let mut march = March::new(&scene).expect("a scene");
    let mut ends = Vec::new();
    while let Some(increment) = march.advance() {
        if increment.expect("an increment").point.ends_branch {
            ends.push(march.shear());
        }
    }
    ends
}

fn norm(q: impl Iterator<Item = f64>) -> f64 {
    q.map(|q| q * q).sum::<f64>().sqrt()
}

/// The largest error and the largest estimate over the branches of a scene, and the tolerance.
fn compared(seed: u64) -> (f64, f64, f64) {
    let drawn = scene(seed);
    let chosen =
        choose_increments(&drawn, &Arc::default()).unwrap_or_else(|e| panic!("{seed}: {e}"));
    let estimate = chosen.path.branches.iter().filter_map(|b| b.path_error);
    let estimate = estimate.fold(0.0, f64::max);
    let mut finer = chosen.path.clone();
    for branch in &mut finer.branches {
        branch.increments = branch.increments.map(|n| FINER * n);
    }
    let few = ends(&chosen, &chosen.path, chosen.tolerance());
    let many = ends(&chosen, &finer, TOLERANCE);
    let largest = many.iter().map(|q| norm(q.iter().flatten().copied()));
    let largest = largest.fold(0.0, f64::max);
    let errors = few.iter().zip(&many).map(|(few, many)| {
        let pairs = few.iter().flatten().zip(many.iter().flatten());
        norm(pairs.map(|(a, b)| a - b)) / largest
    });
    let tolerance = drawn.settings.solver.path_tolerance;
    (errors.fold(0.0, f64::max), estimate, tolerance)
}

#[test]
fn the_estimated_error_of_the_path_is_honest() {
    let asked = std::env::var("FRET_PATH_ERRORS").ok();
    let asked: Option<u64> = asked.map(|n| n.parse().expect("a number of scenes"));
    let seeds = asked.map_or(15..20, |n| 0..n);
    let scenes = seeds.end - seeds.start;
    let (mut honest, mut met, mut within) = (0, 0, 0);
    for seed in seeds {
        let (error, estimate, tolerance) = compared(seed);
        let ratio = error / estimate;
        println!(
            "{seed:3}: error {error:.2e}, estimate {estimate:.2e}, tolerance {tolerance:.2e}, ratio {ratio:.2}"
        );
        met += u64::from(estimate <= tolerance);
        within += u64::from(error <= tolerance);
        honest += u64::from((HONEST.0..=HONEST.1).contains(&ratio));
    }
    println!(
        "{honest} of {scenes} within {HONEST:?}; estimates of {met}, true errors of {within} within their tolerance"
    );
    assert!(10 * met >= 9 * scenes, "{met} of {scenes}");
    assert!(10 * honest >= 9 * scenes, "{honest} of {scenes}");
}

/// In a contact that grows under its load alone, slip cells were released and slipped again, in
/// every Newton step.
#[test]
fn a_slip_set_that_goes_in_circles_is_solved() {
    let mut scene = scene(17);
    let branches = scene.path.branches.iter_mut();
    for (branch, n) in branches.zip([82, 8, 10, 8, 8]) {
        branch.increments = Some(n);
    }
    scene.path.branches[0].spacing = Spacing::EqualRadius;
    assert_eq!(ends(&scene, &scene.path, TOLERANCE).len(), 5);
}
