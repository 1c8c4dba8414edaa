//! Answers that are right, or that say they are not: contacts of few cells, cells at the limit of
//! friction, the onset of sliding, material that rolls in, rims that stick, coated lines, numbers
//! that doubt themselves.

#![allow(clippy::print_stdout, reason = "numbers for people")]

mod at_limit;
mod bars;
mod coarse;
mod doubts;
mod lines;
mod rolling;
mod sliding;
mod stuck;

use contact_core::Scene;
use contact_core::march::{Increment, solve};
use contact_core::scene::{Body, Elastic, Friction, Grid, LoadPath, Settings, Shape};
use contact_reference::{Hertz, hertz};

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };
const ALUMINIUM: Elastic = Elastic { E: 70e9, nu: 0.3 };
const R: f64 = 0.01;
const W: f64 = 60.0;

/// A sphere on a flat, `n` cells over `extent` Hertz radii.
fn sphere(bodies: (Elastic, Elastic), (extent, n): (f64, usize), path: LoadPath) -> (Scene, Hertz) {
    let of = hertz(R, bodies.0, bodies.1, W);
    let scene = Scene {
        title: "sphere on flat".into(),
        body1: Body::homogeneous(bodies.0, Shape::Sphere { R }),
        body2: Body::homogeneous(bodies.1, Shape::Flat),
        friction: Friction::coulomb(0.3),
        grid: Grid::centred(extent * of.a, n).expect("a grid"),
        path,
        settings: Settings::default(),
    };
    (scene, of)
}

/// Every increment of a scene that is solved.
fn run(scene: &Scene) -> Vec<Increment> {
    solve(scene, &mut ()).expect("a solution")
}
