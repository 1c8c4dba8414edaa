//! Random bodies, grids and load paths: what holds for every contact.

use contact_core::march::{Fields, Motion};
use contact_core::scene::{
    Body, Branch, Coating, Elastic, Friction, Grid, LoadPath, Loads, Scene, Settings, Shape,
    Spacing,
};
use ndarray::Array2;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::bench::{R, W, hertz_of, norm, run, run_audited};

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
        let mut path = LoadPath::start().push_branch(Branch {
            to: Loads { W, ..Loads::default() },
            increments: Some(4),
            spacing: Spacing::EqualRadius,
            t_end: 1.0,
            path_error: None,
        });
        for (i, (part, x, y, increments)) in branches.into_iter().enumerate() {
            let load = part * W;
            path = path.push_branch(Branch {
                to: Loads {
                    W: load,
                    T_x: x * mu * load,
                    T_y: y * mu * load,
                    ..Loads::default()
                },
                increments: Some(increments),
                spacing: Spacing::Uniform,
                t_end: i as f64 + 2.0,
                path_error: None,
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

/// How far solutions of one contact may differ that were solved to [`TIGHT`]: waves of a few cells
/// make of a misfit a hundred times as much traction.
pub(crate) const TWINS: f64 = 1e-9;
/// Twins differ by rounding alone, but rounding decides where in the tolerance the iterations end.
const TIGHT: f64 = 1e-11;

/// Fields and motion at the end of the path.
pub(crate) fn end(scene: &Scene) -> (Fields, Motion) {
    let mut kept = None;
    run(scene, |march, increment| {
        kept = Some((march.fields(), increment.motion));
    });
    kept.expect("an increment")
}

pub(crate) fn loads_mapped(scene: &Scene, f: impl Fn(Loads) -> Loads) -> LoadPath {
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
    fn every_increment_obeys_the_equations_of_contact_and_friction(scene in scene()) {
        run_audited(&scene, |_, _| ());
    }
}

proptest! {
    #![proptest_config(cases(12))]

    /// Lengths, moduli and loads scaled together: the same contact.
    #[test]
    fn scaled_twins_are_alike(mut scene in scene(), length in -3..4i32, modulus in -3..4i32) {
        scene.settings.solver.tolerance = Some(TIGHT);
        let (length, modulus) = (3f64.powi(length), 7f64.powi(modulus));
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
        prop_assert!(distance(&theirs.p, modulus, &ours.p, &theirs.p) < TWINS);
        prop_assert!(distance(&theirs.q_x, modulus, &ours.q_x, &theirs.p) < TWINS);
        prop_assert!(distance(&theirs.q_y, modulus, &ours.q_y, &theirs.p) < TWINS);
        prop_assert!((other.delta_z / motion.delta_z / length - 1.0).abs() < TWINS);
    }

    /// The same contact mirrored at the diagonal, turned by a right angle, and with the bodies
    /// exchanged.
    #[test]
    fn mirrored_turned_and_exchanged_twins_are_alike(mut scene in scene()) {
        scene.settings.solver.tolerance = Some(TIGHT);
        let (ours, motion) = end(&scene);

        let mut mirrored = scene.clone();
        (mirrored.grid.nx, mirrored.grid.ny) = (scene.grid.ny, scene.grid.nx);
        (mirrored.grid.dx, mirrored.grid.dy) = (scene.grid.dy, scene.grid.dx);
        mirrored.path = loads_mapped(&scene, |l| Loads { T_x: l.T_y, T_y: l.T_x, ..l });
        let (theirs, other) = end(&mirrored);
        let across = |f: &Array2<f64>| f.t().to_owned();
        prop_assert!(distance(&across(&theirs.p), 1.0, &ours.p, &ours.p) < TWINS);
        prop_assert!(distance(&across(&theirs.q_y), 1.0, &ours.q_x, &ours.p) < TWINS);
        prop_assert!(distance(&across(&theirs.q_x), 1.0, &ours.q_y, &ours.p) < TWINS);
        prop_assert!((other.delta_y - motion.delta_x).abs() < TWINS * motion.delta_z);

        // Cell (i, j) of ours lies at (-j, i) there.
        let (theirs, other) = end(&turned(&scene));
        prop_assert!(distance(&turned_back(&theirs.p), 1.0, &ours.p, &ours.p) < TWINS);
        prop_assert!(distance(&turned_back(&theirs.q_y), 1.0, &ours.q_x, &ours.p) < TWINS);
        prop_assert!(distance(&turned_back(&theirs.q_x), -1.0, &ours.q_y, &ours.p) < TWINS);
        prop_assert!((other.delta_x + motion.delta_y).abs() < TWINS * motion.delta_z);

        // What acted on the lower body now acts on the upper one.
        let mut exchanged = scene.clone();
        std::mem::swap(&mut exchanged.body1, &mut exchanged.body2);
        exchanged.path = loads_mapped(&scene, |l| Loads { T_x: -l.T_x, T_y: -l.T_y, ..l });
        let (theirs, other) = end(&exchanged);
        prop_assert!(distance(&theirs.p, 1.0, &ours.p, &ours.p) < TWINS);
        prop_assert!(distance(&theirs.q_x, -1.0, &ours.q_x, &ours.p) < TWINS);
        prop_assert!(distance(&theirs.q_y, -1.0, &ours.q_y, &ours.p) < TWINS);
        prop_assert!((other.delta_x + motion.delta_x).abs() < TWINS * motion.delta_z);
    }
}

/// Radial fretting, mode II, of dissimilar bodies: W to and fro alone. Whatever the rounding does,
/// the answer has the eight symmetries of the square grid, and slip is radial to the grid's error.
#[test]
fn radial_fretting_of_dissimilar_bodies_is_round() {
    let path = LoadPath::start().radial(&[W, 0.3 * W, W], 24);
    let upper = Elastic { E: 70e9, nu: 0.1 };
    let lower = Elastic { E: 300e9, nu: 0.45 };
    let mut scene = crate::bench::sphere_on_flat(upper, lower, 0.15, (2.4, 49), path);
    scene.settings.solver.tolerance = Some(1e-9);
    // An odd grid, so that nothing of the symmetry is put in by solving half of it.
    let mut kept = Vec::new();
    run(&scene, |march, i| {
        assert!(
            i.energy.dissipated >= 0.0 && i.residuals.energy.abs() < 1e-9,
            "{:?}",
            i.energy
        );
        if i.point.ends_branch {
            kept.push(march.fields());
        }
    });
    for fields in kept {
        let turned = |f: &Array2<f64>| f.t().to_owned();
        let flipped = |f: &Array2<f64>| f.slice(ndarray::s![..;-1, ..]).to_owned();
        let scale = &fields.p;
        assert!(distance(&turned(&fields.p), 1.0, &fields.p, scale) < TWINS);
        assert!(distance(&flipped(&fields.p), 1.0, &fields.p, scale) < TWINS);
        assert!(distance(&turned(&fields.q_y), 1.0, &fields.q_x, scale) < TWINS);
        assert!(distance(&flipped(&fields.q_x), -1.0, &fields.q_x, scale) < TWINS);
        assert!(distance(&flipped(&fields.q_y), 1.0, &fields.q_y, scale) < TWINS);
        let q = norm(&fields.q_x).hypot(norm(&fields.q_y));
        assert!(q > 0.01 * norm(scale), "{q}");
        // The hoop part of the shear over the radial one, at all angles.
        let hoop = Array2::from_shape_fn(fields.p.dim(), |(i, j)| {
            let (x, y) = (scene.grid.x(i), scene.grid.y(j));
            let r = x.hypot(y).max(scene.grid.dx);
            (x * fields.q_y[(i, j)] - y * fields.q_x[(i, j)]) / r
        });
        assert!(norm(&hoop) < 0.02 * q, "{}", norm(&hoop) / q);
    }
}

/// An ellipsoid on a coated flat, both of dissimilar materials, under W, T_x and T_y that turn.
pub(crate) fn twin() -> Scene {
    let body1 = Body::homogeneous(
        Elastic { E: 120e9, nu: 0.15 },
        Shape::Ellipsoid {
            R_x: R,
            R_y: 1.7 * R,
            angle: 0.3,
        },
    );
    let mut body2 = Body::homogeneous(Elastic { E: 210e9, nu: 0.4 }, Shape::Flat);
    body2.coatings = vec![Coating {
        material: Elastic { E: 330e9, nu: 0.25 },
        thickness: 2e-4,
    }];
    let loads = |normal, along_x, along_y| {
        move |to: &mut Loads| (to.W, to.T_x, to.T_y) = (normal, along_x, along_y)
    };
    let path = LoadPath::start()
        .change_to(loads(W, 0.0, 0.0), 4)
        .change_to(loads(W, 0.15 * W, 0.05 * W), 3)
        .change_to(loads(0.8 * W, 0.02 * W, -0.16 * W), 3);
    let mut settings = Settings::default();
    settings.solver.tolerance = Some(TIGHT);
    Scene {
        title: "twin".into(),
        body1,
        body2,
        friction: Friction::coulomb(0.3),
        grid: Grid::from_spacing((26, 24), (7.2e-5, 7.6e-5)).expect("a grid"),
        path,
        settings,
    }
}

/// Turns the grid and the ellipsoid by a right angle: x goes to y, y to -x.
fn turned(scene: &Scene) -> Scene {
    let mut turned = scene.clone();
    (turned.grid.nx, turned.grid.ny) = (scene.grid.ny, scene.grid.nx);
    (turned.grid.dx, turned.grid.dy) = (scene.grid.dy, scene.grid.dx);
    if let Shape::Ellipsoid { angle, .. } = &mut turned.body1.shape {
        *angle += 0.5 * std::f64::consts::PI;
    }
    turned.path = loads_mapped(scene, |l| Loads {
        T_x: -l.T_y,
        T_y: l.T_x,
        ..l
    });
    turned
}

/// A field of the turned scene where it was: cell (i, j) lies at (-j, i) there.
fn turned_back(field: &Array2<f64>) -> Array2<f64> {
    let (ny, nx) = field.dim();
    Array2::from_shape_fn((nx, ny), |(i, j)| field[(ny - 1 - j, i)])
}

pub(crate) fn assert_twins(what: &str, ours: [&Array2<f64>; 3], theirs: [&Array2<f64>; 3]) {
    for (ours, theirs_field) in ours.iter().zip(theirs) {
        let off = distance(theirs_field, 1.0, ours, theirs[0]);
        assert!(off < TWINS, "{what}: {off:e}");
    }
}

#[test]
fn twins_are_the_same_to_nine_digits() {
    let scene = twin();
    let (ours, motion) = end(&scene);
    let same = [&ours.p, &ours.q_x, &ours.q_y];

    let (theirs, other) = end(&turned(&scene));
    let turned = [
        turned_back(&theirs.p),
        turned_back(&theirs.q_y),
        -turned_back(&theirs.q_x),
    ];
    assert_twins("turned", [&turned[0], &turned[1], &turned[2]], same);
    let scale = motion.delta_z;
    crate::bench::close(
        "delta_x",
        (other.delta_y - motion.delta_x) / scale,
        0.0,
        TWINS,
    );
    crate::bench::close("delta_z", other.delta_z / scale, 1.0, TWINS);

    let mut mirrored = scene.clone();
    if let Shape::Ellipsoid { angle, .. } = &mut mirrored.body1.shape {
        *angle = -*angle;
    }
    mirrored.path = loads_mapped(&scene, |l| Loads { T_x: -l.T_x, ..l });
    let (theirs, _) = end(&mirrored);
    let flip = |f: &Array2<f64>, sign: f64| f.slice(ndarray::s![..;-1, ..]).to_owned() * sign;
    let back = [
        flip(&theirs.p, 1.0),
        flip(&theirs.q_x, -1.0),
        flip(&theirs.q_y, 1.0),
    ];
    assert_twins("mirrored", [&back[0], &back[1], &back[2]], same);

    let mut exchanged = scene.clone();
    std::mem::swap(&mut exchanged.body1, &mut exchanged.body2);
    exchanged.path = loads_mapped(&scene, |l| Loads {
        T_x: -l.T_x,
        T_y: -l.T_y,
        ..l
    });
    let (theirs, _) = end(&exchanged);
    let back = [theirs.p.clone(), -&theirs.q_x, -&theirs.q_y];
    assert_twins("exchanged", [&back[0], &back[1], &back[2]], same);

    // Lengths by 3, moduli by 7.
    let (length, modulus) = (3.0, 7.0);
    let mut scaled = scene.clone();
    scaled.body1.shape = Shape::Ellipsoid {
        R_x: R * length,
        R_y: 1.7 * R * length,
        angle: 0.3,
    };
    for body in [&mut scaled.body1, &mut scaled.body2] {
        body.substrate.E *= modulus;
        for coating in &mut body.coatings {
            coating.material.E *= modulus;
            coating.thickness *= length;
        }
    }
    (scaled.grid.dx, scaled.grid.dy) = (scene.grid.dx * length, scene.grid.dy * length);
    let force = modulus * length * length;
    scaled.path = loads_mapped(&scene, |l| Loads {
        W: l.W * force,
        T_x: l.T_x * force,
        T_y: l.T_y * force,
        ..l
    });
    let (theirs, _) = end(&scaled);
    let back = [&theirs.p, &theirs.q_x, &theirs.q_y].map(|f| f / modulus);
    assert_twins("scaled", [&back[0], &back[1], &back[2]], same);
}
