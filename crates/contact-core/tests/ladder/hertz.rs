//! Frictionless and homogeneous: Hertz, and its convergence with the grid.

use contact_core::scene::LoadPath;
use contact_core::zones::continue_pressure_to_rim;

use crate::bench::{
    FIELD, RIM, SMOOTH, STEEL, W, cell, close, hertz_of, norm, run, sphere_on_flat,
};

#[test]
fn radius_pressure_and_approach_converge_with_the_grid() {
    let (mut errors, mut continued) = (Vec::new(), Vec::new());
    for n in [64, 128, 256] {
        let path = LoadPath::start().normal(W, 1);
        let scene = sphere_on_flat(STEEL, STEEL, 0.0, (2.4, n), path);
        let (hertz, d) = (hertz_of(&scene), cell(&scene));
        // The gap is off by the tolerance, at the ends of a change of the approach or the pressure.
        let smooth = SMOOTH * d * d + 2.0 * scene.tolerance();
        run(&scene, |march, increment| {
            let truth = scene.grid.map(|x, y| hertz.p(x.hypot(y)));
            let p = march.fields().p;
            let error = norm(&(&p - &truth)) / norm(&truth);
            let highest = hertz.p(scene.grid.dx / 2f64.sqrt());
            close("a", increment.contact_radius / hertz.a, 1.0, RIM * d);
            close("p0", increment.p_max / highest, 1.0, smooth);
            close(
                "delta_z",
                increment.motion.delta_z / hertz.delta_z,
                1.0,
                smooth,
            );
            close("p", error, 0.0, FIELD * d);
            errors.push(error);
            let p = continue_pressure_to_rim(&p, &scene.grid);
            continued.push(norm(&(&p - &truth)) / norm(&truth));
        });
    }
    // First order: the rim, where p rises like a square root.
    assert!(errors[0] / errors[2] > 3.0, "{errors:?}");
    // The second cell from the rim is off as well, by a fourth of that.
    assert!(continued[2] < 1e-3, "{continued:?}");
    assert!(continued[2] < errors[2] / 2.0, "{continued:?}");
}

/// A tolerance far below the error of the cells.
const TIGHT: f64 = 1e-9;

#[test]
fn the_path_does_not_matter() {
    let run_in = |increments: usize| {
        let path = LoadPath::start().normal(W, increments);
        let mut scene = sphere_on_flat(STEEL, STEEL, 0.0, (2.4, 64), path);
        scene.settings.solver.tolerance = Some(TIGHT);
        let mut p = None;
        run(&scene, |march, _| p = Some(march.fields().p));
        p.expect("an increment")
    };
    let (once, often) = (run_in(1), run_in(7));
    let error = norm(&(&once - &often)) / norm(&once);
    // The shortest waves cost a few tens of times less displacement than pressure.
    assert!(error < 100.0 * TIGHT, "{error}");
}
