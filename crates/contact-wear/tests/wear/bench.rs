//! Scenes that wear, and runs of them.

use std::sync::Arc;

use contact_core::scene::{
    Body, Elastic, Friction, Grid, LoadPath, PrescribedMotions, Scene, Settings, Shape,
};
use contact_wear::{Archard, BodyWear, Cycling, Jump, Wear, WearRun};
use ndarray::Array2;

pub(crate) const STEEL: Elastic = Elastic { E: 200e9, nu: 0.3 };

pub(crate) fn archard(k: f64) -> BodyWear {
    BodyWear::with_law(Archard { k, threshold: 0.0 })
}

/// Presses with W and slides to and fro by +-`stroke` in so many increments a way.
pub(crate) fn to_and_fro(W: f64, stroke: f64, places: usize) -> LoadPath {
    let ways = [(stroke, 1), (-stroke, places), (stroke, places)];
    ways.into_iter()
        .fold(LoadPath::start().normal(W, 1), |path, (to, places)| {
            path.change_to(
                |at| {
                    at.given = PrescribedMotions {
                        delta_x: Some(to),
                        ..at.given
                    }
                },
                places,
            )
        })
}

/// Presses with W and pulls to and fro with +-T in so many increments a way.
pub(crate) fn pulled(W: f64, T: f64, increments: usize) -> LoadPath {
    let path = LoadPath::start().normal(W, 1);
    [T, -T, T]
        .into_iter()
        .fold(path, |path, T| path.tangential(&[T], increments))
}

/// A steel body of a shape on a steel flat.
pub(crate) fn scene(shape: Shape, grid: Grid, path: LoadPath, mu: f64) -> Scene {
    Scene {
        title: String::new(),
        body1: Body::homogeneous(STEEL, shape),
        body2: Body::homogeneous(STEEL, Shape::Flat),
        friction: Friction::coulomb(mu),
        grid,
        path,
        settings: Settings::default(),
    }
}

pub(crate) fn cylinder(R: f64) -> Shape {
    Shape::Cylinder {
        R,
        length: f64::INFINITY,
        angle: 0.0,
    }
}

/// The cycle is what follows the way to its first end.
pub(crate) fn wear(bodies: [BodyWear; 2], cycles: f64, cycling: Cycling) -> Wear {
    Wear {
        first_branch: Some(2),
        cycling,
        ..Wear::new(bodies, cycles)
    }
}

/// Runs to the end.
pub(crate) fn run(scene: &Scene, wear: &Wear) -> (WearRun, Vec<Jump>) {
    let mut run = WearRun::new(scene, wear, &Arc::default()).unwrap();
    let mut jumps = Vec::new();
    while let Some(jump) = run.advance() {
        jumps.push(jump.unwrap());
    }
    (run, jumps)
}

/// The half-width at which a parabola of the profile along y = 0 ends, from where it is a twentieth
/// of its depth.
pub(crate) fn half_width(worn: &Array2<f64>, grid: &Grid) -> f64 {
    let row = worn.column(grid.ny / 2);
    let part = 0.05 * row.iter().fold(0.0, |m: f64, w| m.max(*w));
    let out = (grid.nx / 2..grid.nx).find(|&i| row[i] < part).unwrap();
    let (a, b) = (row[out - 1], row[out]);
    let x = grid.x(out - 1) + (a - part) / (a - b) * grid.dx;
    x / 0.95_f64.sqrt()
}
