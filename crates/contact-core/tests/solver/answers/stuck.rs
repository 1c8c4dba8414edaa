//! Dissimilar bodies that stick everywhere: the law of their rims has no power without bound.

use contact_core::scene::{Elastic, Friction, LoadPath};
use fastrand::Rng;
use rayon::prelude::*;

use super::{STEEL, W, run, sphere};

#[test]
fn the_area_of_a_contact_that_sticks_is_a_number() {
    let rng = &mut Rng::with_seed(7);
    let scenes = (0..40).map(|_| {
        let lower = Elastic {
            E: 10f64.powf(9.0 + 3.5 * rng.f64()),
            nu: -0.3 + 0.79 * rng.f64(),
        };
        let upper = Elastic {
            nu: if rng.bool() { 0.0 } else { 0.3 },
            ..STEEL
        };
        let n = [12, 16, 24, 33, 21][rng.usize(0..5)];
        let (mut scene, hertz) = sphere((upper, lower), (3.4, n), LoadPath::start());
        scene.friction = Friction::coulomb(f64::INFINITY);
        scene.settings.solver.tolerance = Some(10f64.powf(-7.0 + 4.0 * rng.f64()));
        let (x, y) = (0.2 + 2.3 * rng.f64(), 2.0 * rng.f64() - 1.0);
        scene.path = LoadPath::start().normal(W, 2).change_to(
            |to| {
                to.given.delta_x = Some(x * hertz.delta_z);
                to.given.delta_y = Some(y * hertz.delta_z);
            },
            3,
        );
        (scene, hertz)
    });
    let scenes: Vec<_> = scenes.collect();
    scenes.par_iter().for_each(|(scene, hertz)| {
        let Ok(increments) = contact_core::march::solve(scene, &mut ()) else {
            return;
        };
        for increment in increments {
            let area = increment.contact_area;
            assert!(area > 0.0 && area < 10.0 * hertz.a * hertz.a, "{area}");
            assert!((0.0..=1.0 + 1e-12).contains(&increment.stick_ratio()));
        }
    });
    let (scene, _) = sphere((STEEL, STEEL), (2.6, 24), LoadPath::start().normal(W, 1));
    assert!(run(&scene)[0].contact_area > 0.0);
}
