//! Numbers that are hardly meant are told, once, with what was understood.

use contact_core::Scene;
use contact_core::march::{Increment, Reached};
use contact_core::scene::{Coating, Elastic, Friction, Grid, LoadPath, Shape};

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
    told("those of gels", |scene| {
        let mpa = Elastic { E: 210e3, nu: 0.3 };
        (scene.body1.substrate, scene.body2.substrate) = (mpa, mpa);
        scene.body1.shape = Shape::Sphere { R: 5.0 };
        scene.grid = Grid::centred(0.17, 64).expect("a grid");
    });
    told("a_H/R = 0.1", |scene| {
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
        scene.path = LoadPath::start().normal(1e-5 * W, 1);
        scene.grid = Grid::centred(6e-4, 64).expect("a grid");
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
fn a_pressure_that_no_metal_bears_is_told() {
    let scene = usual();
    let of = |p_max: f64| {
        Reached {
            cells_per_radius: 20.0,
            p_max,
            ..Reached::default()
        }
        .doubts(&scene)
    };
    assert!(of(5e9).is_empty());
    let told = of(13.9e9);
    assert!(told.len() == 1 && told[0].contains("13.9 GPa"), "{told:?}");
    assert_eq!(Reached::of(&[] as &[Increment]).doubts(&scene), [""; 0]);
}
