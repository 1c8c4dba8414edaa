//! The test rig: a sphere on a flat, run through a path.

use contact_core::march::{Increment, March};
use contact_core::reference::{Hertz, hertz};
use contact_core::scene::{
    Body, Coating, Elastic, Friction, Grid, LoadPath, Scene, Settings, Shape,
};
use ndarray::Array2;

/// Radius of the sphere \[m\].
pub(crate) const R: f64 = 0.018;
/// Largest normal force \[N\].
pub(crate) const W: f64 = 1e3;
/// The paper's material.
pub(crate) const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };
/// Without lateral contraction the shear kernel is isotropic.
pub(crate) const CORK: Elastic = Elastic { E: 210e9, nu: 0.0 };

/// A sphere of `upper` on a flat of `lower`, `n` x `n` cells over `extent` times the Hertz radius.
pub(crate) fn sphere_on_flat(
    upper: Elastic,
    lower: Elastic,
    mu: f64,
    (extent, n): (f64, usize),
    path: LoadPath,
) -> Scene {
    let a = hertz(R, upper, lower, W).a;
    Scene {
        title: "ladder".into(),
        body1: Body::homogeneous(upper, Shape::Sphere { R }),
        body2: Body::homogeneous(lower, Shape::Flat),
        friction: Friction { mu },
        grid: Grid::centred(extent * a, n).expect("a grid"),
        path,
        settings: Settings::default(),
    }
}

/// The same with one coating on the flat.
pub(crate) fn coated(mut scene: Scene, material: Elastic, thickness: f64) -> Scene {
    scene.body2.coatings = vec![Coating {
        material,
        thickness,
    }];
    scene
}

/// The Hertz contact of the uncoated pair.
pub(crate) fn hertz_of(scene: &Scene) -> Hertz {
    scene.hertz().expect("a Hertz contact")
}

/// Runs the path; `watch` sees every increment.
pub(crate) fn run(scene: &Scene, mut watch: impl FnMut(&March, &Increment)) -> Vec<Increment> {
    let mut march = March::new(scene).expect("a scene");
    let mut increments = Vec::new();
    while let Some(increment) = march.advance() {
        let increment = increment.expect("a solution");
        watch(&march, &increment);
        increments.push(increment);
    }
    increments
}

/// Distance of two fields in the L2 norm, relative to the second.
pub(crate) fn distance(field: &Array2<f64>, truth: &Array2<f64>) -> f64 {
    let norm = |f: &Array2<f64>| f.iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(&(field - truth)) / norm(truth)
}
