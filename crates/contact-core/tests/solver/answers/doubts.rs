//! Numbers that are hardly meant are told, once, with what was understood.

use contact_core::Scene;
use contact_core::march::{Increment, Reached};
use contact_core::scene::{Coating, Elastic, Friction, Grid, LoadPath, Plastic, Shape};

use super::{STEEL, W, sphere};

fn usual() -> Scene {
    sphere((STEEL, STEEL), (2.6, 64), LoadPath::start().normal(W, 1)).0
}

/// What is doubted of a scene that a slip of the pen has changed.
fn doubts(slip: impl FnOnce(&mut Scene)) -> Vec<String> {
    let mut scene = usual();
    slip(&mut scene);
    scene.doubts()
}

#[test]
fn slips_of_the_pen_are_told_once() {
    assert_eq!(doubts(|_| ()), [""; 0]);
    let told = |says: &str, slip: fn(&mut Scene)| {
        let doubts = doubts(slip);
        let saying = doubts.iter().filter(|doubt| doubt.contains(says)).count();
        assert_eq!(saying, 1, "{says}: {doubts:?}");
    };
    told("friction.mu = 30", |scene| {
        scene.friction = Friction::coulomb(30.0);
    });
    told("body1.shape.R = 5 m", |scene| {
        scene.body1.shape = Shape::Sphere { R: 5.0 }
    });
    told("body1.E = 210 Pa", |scene| {
        scene.body1.substrate.E = 210.0;
    });
    told("as of gels", |scene| {
        let mpa = Elastic { E: 210e3, nu: 0.3 };
        (scene.body1.substrate, scene.body2.substrate) = (mpa, mpa);
        scene.body1.shape = Shape::Sphere { R: 5.0 };
        scene.grid = Grid::centred(0.17, 64).expect("a grid");
    });
    told("a/R = 0.1", |scene| {
        scene.path = LoadPath::start().normal(1500.0 * W, 1);
    });
    told("of a cell", |scene| {
        let material = Elastic { E: 450e9, nu: 0.25 };
        let thickness = 0.3 * scene.grid.dx;
        scene.body2.coatings = vec![Coating {
            material,
            thickness,
        }];
    });
}

/// Rubber, a train wheel on its rail and a soft coating of a cell of its own substrate are what
/// they are.
#[test]
fn what_is_meant_is_not_doubted() {
    let quiet = |change: fn(&mut Scene)| {
        let doubts = doubts(change);
        assert!(doubts.is_empty(), "{doubts:?}");
    };
    quiet(|scene| {
        let rubber = Elastic { E: 3e6, nu: 0.49 };
        (scene.body1.substrate, scene.body2.substrate) = (rubber, rubber);
        scene.path = LoadPath::start().normal(1e-3 * W, 1);
        scene.grid = Grid::centred(3e-3, 64).expect("a grid");
    });
    quiet(|scene| {
        scene.body1.shape = Shape::Sphere { R: 0.46 };
        scene.path = LoadPath::start().normal(1e5, 1);
        scene.grid = Grid::centred(0.02, 64).expect("a grid");
    });
    quiet(|scene| {
        let thickness = 0.3 * scene.grid.dx;
        scene.body2.coatings = vec![Coating {
            material: STEEL,
            thickness,
        }];
    });
}

#[test]
fn a_grid_that_is_too_small_for_a_slip_of_the_pen_says_so() {
    let mut scene = usual();
    scene.body1.shape = Shape::Sphere { R: 5.0 };
    let refused = scene.check_fit().expect_err("too small").to_string();
    assert!(refused.contains("body1.shape.R = 5 m"), "{refused}");
}

#[test]
fn a_pressure_above_a_hundredth_of_the_softest_modulus_is_told() {
    let mut scene = usual();
    let of = |scene: &Scene, p_max: f64| {
        Reached {
            cells_per_radius: 20.0,
            contact_radius: 1e-4,
            p_max,
            ..Reached::default()
        }
        .doubts(scene)
    };
    let told = |scene: &Scene, layer: &str| {
        let found = of(scene, 2.2e9);
        assert!(
            found.len() == 1 && found[0].contains("2.2 GPa") && found[0].contains(layer),
            "{found:?}"
        );
    };
    assert!(of(&scene, 2.0e9).is_empty());
    told(&scene, "body1 (");
    let film = |E: f64, thickness: f64| {
        let material = Elastic { E, nu: 0.3 };
        vec![Coating {
            material,
            thickness,
        }]
    };
    // A hard film leaves the substrate below it the softest, unless that lies deep.
    scene.body1.substrate.E = 500e9;
    scene.body2.coatings = film(500e9, 2e-6);
    told(&scene, "body2 (");
    scene.body2.coatings = film(500e9, 2e-3);
    assert!(of(&scene, 2.2e9).is_empty());
    scene.body2.coatings = film(100e9, 2e-6);
    told(&scene, "body2.coatings[0]");
    // A layer that yields in the computation is no elastic one.
    scene.body2.coatings.clear();
    scene.body2.plastic = vec![Some(Plastic::perfect(1e9))];
    assert!(of(&scene, 2.2e9).is_empty());
    assert_eq!(
        Reached::from_increments(&[] as &[Increment]).doubts(&scene),
        [""; 0]
    );
}

/// A contact in plane strain or not, of bodies with these radii along x and y (infinite for flat),
/// whose half width along x is `half_width`.
fn pressed(first: [f64; 2], second: [f64; 2], half_width: f64, line: bool) -> Scene {
    let mut scene = usual();
    let shape = |[R_x, R_y]: [f64; 2]| match (R_x.is_infinite(), R_y.is_infinite()) {
        (true, true) => Shape::Flat,
        (false, true) => Shape::cylinder(R_x),
        _ => Shape::Ellipsoid {
            R_x,
            R_y,
            angle: 0.0,
        },
    };
    (scene.body1.shape, scene.body2.shape) = (shape(first), shape(second));
    let extent = 4.0 * half_width;
    scene.grid = if line {
        Grid::strip(extent, 64, 1.0).expect("a grid")
    } else {
        Grid::centred(extent, 64).expect("a grid")
    };
    // Loads go as the square of the half width of a line, as the cube of that of a ball.
    scene.path = LoadPath::start().normal(1.0, 1);
    let one = scene.hertz_breadth().expect("curved").half_width;
    let power = if line { 2 } else { 3 };
    scene.path = LoadPath::start().normal((half_width / one).powi(power), 1);
    scene
}

/// Radii of body 1 and body 2, whether they are lines, and the body that the other one fits.
type Pair = ([f64; 2], [f64; 2], bool, Option<&'static str>);

#[test]
fn a_contact_is_held_against_the_radius_of_each_body() {
    let flat = [f64::INFINITY; 2];
    let cases: [Pair; 8] = [
        ([0.01, 0.01], flat, false, None),
        (flat, [0.01, 0.01], false, None),
        ([0.01, f64::INFINITY], flat, true, None),
        // Two equal balls: the relative radius is half of either.
        ([0.01, 0.01], [0.01, 0.01], false, None),
        // An ellipse whose longer axis lies along the smaller curvature.
        ([0.01, 0.1], flat, false, None),
        // A hip socket, a bushing, a ball in a groove.
        (
            [0.01, 0.01],
            [-0.0101, -0.0101],
            false,
            Some("body2 (R = -0.0101 m)"),
        ),
        (
            [0.01, f64::INFINITY],
            [-0.0101, f64::INFINITY],
            true,
            Some("body2 (R = -0.0101 m)"),
        ),
        (
            [0.01, 0.01],
            [-0.011, f64::INFINITY],
            false,
            Some("body2 (R = -0.011 m)"),
        ),
    ];
    for (first, second, line, conforms) in cases {
        for ratio in [0.05, 0.099, 0.101, 0.2, 0.9, 0.99, 1.01, 2.0] {
            let scene = pressed(first, second, ratio * 0.01, line);
            let breadth = scene.hertz_breadth().expect("curved");
            let case = format!("{first:?} {second:?} {ratio} {breadth:?}");
            assert!((breadth.ratio() - ratio).abs() < 1e-6 * ratio, "{case}");
            let told: Vec<_> = scene.doubts();
            let told: Vec<_> = told.iter().filter(|d| d.contains("a/R = ")).collect();
            assert_eq!(
                told.len(),
                usize::from(ratio > 0.1 && ratio < 1.0),
                "{case} {told:?}"
            );
            let refused = scene.check();
            assert_eq!(refused.is_err(), ratio > 1.0, "{case} {refused:?}");
            let words = told.first().map(ToString::to_string);
            let words = words
                .into_iter()
                .chain(refused.err().map(|e| e.to_string()));
            for words in words {
                let conformal = words.contains("conformal contact with");
                assert_eq!(conformal, conforms.is_some(), "{words}");
                assert!(words.contains(conforms.unwrap_or("body")), "{words}");
            }
        }
    }
}

/// What the solution shows counts, where the scene alone cannot know it.
#[test]
fn a_contact_that_comes_out_wide_is_told_and_refused() {
    let scene = pressed([0.01, 0.01], [f64::INFINITY; 2], 0.0005, false);
    let reached = |a: f64| Reached {
        cells_per_radius: 20.0,
        contact_radius: a,
        ..Reached::default()
    };
    assert!(reached(0.0009).all_doubts(&scene).is_empty());
    let told = reached(0.0015).all_doubts(&scene);
    assert!(
        told.len() == 1 && told[0].contains("a/R = 0.15"),
        "{told:?}"
    );
    assert!(reached(0.0099).check(&scene).is_ok());
    let refused = reached(0.0101)
        .check(&scene)
        .expect_err("as wide as the ball");
    assert!(refused.to_string().contains("a/R = 1.01"), "{refused}");
}
