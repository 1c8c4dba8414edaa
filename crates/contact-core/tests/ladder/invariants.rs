//! Random bodies, grids and load paths: what holds for every contact.

use contact_core::march::{Fields, Motion};
use contact_core::scene::{
    Body, Branch, Coating, Elastic, Friction, Grid, LoadPath, Loads, Scene, Settings, Shape,
    Spacing,
};
use ndarray::Array2;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::audit::Audit;
use crate::bench::{R, W, hertz_of, norm, run};

/// An elastic material; nu near 1/2 and below zero included.
fn material() -> impl Strategy<Value = Elastic> {
    (0.0..2.0, -0.3..0.49).prop_map(|(log, nu)| Elastic {
        E: 1e10 * 10f64.powf(log),
        nu,
    })
}

/// No coating or one: its material and its thickness over the Hertz radius.
fn layer() -> impl Strategy<Value = Option<(Elastic, f64)>> {
    prop::option::of((material(), 0.05..3.0f64))
}

/// A branch to a part of W and, as parts of mu W, T_x and T_y.
fn branch() -> impl Strategy<Value = (f64, f64, f64, usize)> {
    let angle = 0.0..std::f64::consts::TAU;
    (0.3..1.0, 0.0..0.95, angle, 2..5usize).prop_map(|(part, size, angle, increments)| {
        (part, size * angle.cos(), size * angle.sin(), increments)
    })
}

prop_compose! {
    fn scene()(
        upper in material(),
        lower in material(),
        layers in [layer(), layer()],
        mu in 0.05..0.9,
        (nx, ny) in (18..27usize, 18..27usize),
        (long, wide) in (2.7..3.4f64, 2.7..3.4f64),
        branches in prop::collection::vec(branch(), 1..4),
    ) -> Scene {
        let body1 = Body::homogeneous(upper, Shape::Sphere { R });
        let body2 = Body::homogeneous(lower, Shape::Flat);
        let mut path = LoadPath::start().branch(Branch {
            to: Loads { W, ..Loads::default() },
            increments: 4,
            spacing: Spacing::EqualRadius,
            t_end: 1.0,
        });
        for (i, (part, x, y, increments)) in branches.into_iter().enumerate() {
            let load = part * W;
            path = path.branch(Branch {
                to: Loads {
                    W: load,
                    T_x: x * mu * load,
                    T_y: y * mu * load,
                    ..Loads::default()
                },
                increments,
                spacing: Spacing::Uniform,
                t_end: i as f64 + 2.0,
            });
        }
        let mut scene = Scene {
            title: "any".into(),
            body1,
            body2,
            friction: Friction::coulomb(mu),
            grid: Grid::from_spacing((nx, ny), (1.0, 1.0)).expect("a grid"),
            path,
            settings: Settings::default(),
        };
        let a = hertz_of(&scene).a;
        scene.grid.dx = long * a / nx as f64;
        scene.grid.dy = wide * a / ny as f64;
        // A layer much softer than its substrate widens the contact.
        let mut widest = 1.0_f64;
        for (body, layer) in [&mut scene.body1, &mut scene.body2].into_iter().zip(layers) {
            if let Some((material, h)) = layer {
                widest = widest.max(body.substrate.E / material.E);
                body.coatings = vec![Coating { material, thickness: h * a }];
            }
        }
        scene.grid.dx *= widest.cbrt();
        scene.grid.dy *= widest.cbrt();
        scene
    }
}

/// How far solutions of one contact may differ that were solved to 1e-6: waves of a few cells make
/// of a misfit a hundred times as much traction.
const ALIKE: f64 = 1e-4;

/// Fields and motion at the end of the path.
fn end(scene: &Scene) -> (Fields, Motion) {
    let mut kept = None;
    run(scene, |march, increment| {
        kept = Some((march.fields(), increment.motion));
    });
    kept.expect("an increment")
}

fn loads_mapped(scene: &Scene, f: impl Fn(Loads) -> Loads) -> LoadPath {
    let mut path = scene.path.clone();
    for branch in &mut path.branches {
        branch.to = f(branch.to);
    }
    path
}

/// Distance of `field` from `sign` times `other`, over the norm of `scale`.
fn distance(field: &Array2<f64>, sign: f64, other: &Array2<f64>, scale: &Array2<f64>) -> f64 {
    norm(&(field - &(other * sign))) / norm(scale)
}

/// The same cases in every run.
fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        max_shrink_iters: 50,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(cases(60))]

    /// Balance, complementarity, Coulomb's law, the direction of slip, the energy.
    #[test]
    fn every_increment_stands_the_audit(scene in scene()) {
        let mut audit = Audit::new(&scene);
        run(&scene, |march, increment| audit.check(march, increment));
    }
}

proptest! {
    #![proptest_config(cases(12))]

    /// Lengths, moduli and loads scaled together: the same contact.
    #[test]
    fn scaled_twins_are_alike(mut scene in scene(), length in -3..4i32, modulus in -3..4i32) {
        scene.settings.solver.tolerance = 1e-6;
        let (length, modulus) = (2f64.powi(2 * length), 2f64.powi(2 * modulus));
        let force = modulus * length * length;
        let mut twin = scene.clone();
        twin.body1.shape = Shape::Sphere { R: R * length };
        for body in [&mut twin.body1, &mut twin.body2] {
            body.substrate.E *= modulus;
            for coating in &mut body.coatings {
                coating.material.E *= modulus;
                coating.thickness *= length;
            }
        }
        twin.grid.dx *= length;
        twin.grid.dy *= length;
        twin.path = loads_mapped(&scene, |l| Loads {
            W: l.W * force,
            T_x: l.T_x * force,
            T_y: l.T_y * force,
            ..l
        });
        let ((ours, motion), (theirs, other)) = (end(&scene), end(&twin));
        prop_assert!(distance(&theirs.p, modulus, &ours.p, &theirs.p) < ALIKE);
        prop_assert!(distance(&theirs.q_x, modulus, &ours.q_x, &theirs.p) < ALIKE);
        prop_assert!(distance(&theirs.q_y, modulus, &ours.q_y, &theirs.p) < ALIKE);
        prop_assert!((other.delta_z / motion.delta_z / length - 1.0).abs() < ALIKE);
    }

    /// The same contact mirrored at the diagonal, and with the bodies exchanged.
    #[test]
    fn mirrored_and_exchanged_scenes_are_alike(mut scene in scene()) {
        scene.settings.solver.tolerance = 1e-6;
        let (ours, motion) = end(&scene);

        let mut mirrored = scene.clone();
        (mirrored.grid.nx, mirrored.grid.ny) = (scene.grid.ny, scene.grid.nx);
        (mirrored.grid.dx, mirrored.grid.dy) = (scene.grid.dy, scene.grid.dx);
        mirrored.path = loads_mapped(&scene, |l| Loads { T_x: l.T_y, T_y: l.T_x, ..l });
        let (theirs, other) = end(&mirrored);
        let across = |f: &Array2<f64>| f.t().to_owned();
        prop_assert!(distance(&across(&theirs.p), 1.0, &ours.p, &ours.p) < ALIKE);
        prop_assert!(distance(&across(&theirs.q_y), 1.0, &ours.q_x, &ours.p) < ALIKE);
        prop_assert!(distance(&across(&theirs.q_x), 1.0, &ours.q_y, &ours.p) < ALIKE);
        prop_assert!((other.delta_y - motion.delta_x).abs() < ALIKE * motion.delta_z);

        // What acted on the lower body now acts on the upper one.
        let mut exchanged = scene.clone();
        std::mem::swap(&mut exchanged.body1, &mut exchanged.body2);
        exchanged.path = loads_mapped(&scene, |l| Loads { T_x: -l.T_x, T_y: -l.T_y, ..l });
        let (theirs, other) = end(&exchanged);
        prop_assert!(distance(&theirs.p, 1.0, &ours.p, &ours.p) < ALIKE);
        prop_assert!(distance(&theirs.q_x, -1.0, &ours.q_x, &ours.p) < ALIKE);
        prop_assert!(distance(&theirs.q_y, -1.0, &ours.q_y, &ours.p) < ALIKE);
        prop_assert!((other.delta_x + motion.delta_x).abs() < ALIKE * motion.delta_z);
    }
}
