//! Similar bodies, constant W, T to and fro.

use contact_core::march::{Increment, March};
use contact_core::scene::{Elastic, LoadPath, Scene};
use contact_reference::CattaneoMindlin;
use ndarray::Array2;

use crate::bench::{
    CORK, FIELD, RIM, SMOOTH, STEEL, W, WHOLE_CELLS, cell, close, hertz_of, norm, radius, run,
    sphere_on_flat,
};

const MU: f64 = 0.3;
const T_M: f64 = 0.9 * MU * W;

fn scene(material: Elastic, n: usize, increments: usize) -> Scene {
    let path = LoadPath::start()
        .normal(W, 1)
        .tangential(&[T_M, -T_M, T_M], increments);
    sphere_on_flat(material, material, MU, (2.4, n), path)
}

/// What the closed form says at an increment: the traction at r, the shift, the stick radius.
fn truth(c: &CattaneoMindlin, increment: &Increment, r: f64) -> [f64; 3] {
    let T = increment.point.loads.T_x;
    match increment.point.branch {
        1 => [c.q_loading(r, T), c.shift_loading(T), c.stick_radius(T)],
        2 => [
            c.q_unloading(r, T, T_M),
            c.shift_unloading(T, T_M),
            c.stick_radius_reversed(T, T_M),
        ],
        3 => [
            c.q_reloading(r, T, T_M),
            c.shift_reloading(T, T_M),
            c.stick_radius_reversed(T, -T_M),
        ],
        _ => [0.0; 3],
    }
}

/// Distance of q_x from the closed form over the norm of full sliding, mu p.
fn shear_error(scene: &Scene, c: &CattaneoMindlin, march: &March, increment: &Increment) -> f64 {
    let q_x = march.fields().q_x;
    let exact = scene.grid.map(|x, y| truth(c, increment, x.hypot(y))[0]);
    let sliding = scene.grid.map(|x, y| MU * c.hertz.p(x.hypot(y)));
    norm(&(&q_x - &exact)) / norm(&sliding)
}

#[test]
fn isotropic_shear_follows_the_closed_form_round_the_loop() {
    let mut ends = Vec::new();
    for n in [64, 128, 256] {
        let scene = scene(CORK, n, 50);
        let c = CattaneoMindlin::new(hertz_of(&scene), CORK, CORK, MU);
        let d = cell(&scene);
        let mut dissipated = 0.0;
        run(&scene, |march, increment| {
            let [_, shift, stick] = truth(&c, increment, 0.0);
            let branch = increment.point.branch;
            // The closed loop.
            if branch >= 2 {
                dissipated += increment.energy.dissipated;
            }
            if branch == 0 {
                return;
            }
            let c_num = radius(increment.stick_area);
            // Near the end of a reversed stroke the border comes within a few cells of that of the
            // last stroke, and merges with it in the end.
            let last_stroke = c.stick_radius(T_M);
            let near = (stick - last_stroke) / (d * c.hertz.a);
            let merging = branch >= 2 && !increment.point.ends_branch && near < 12.0;
            let allowed = if merging { WHOLE_CELLS } else { RIM };
            close("c", c_num / c.hertz.a, stick / c.hertz.a, allowed * d);
            let shift_num = increment.motion.delta_x / c.shift_limit();
            close(
                "delta_x",
                shift_num,
                shift / c.shift_limit(),
                SMOOTH * d * d + 3e-5,
            );
            if increment.point.ends_branch || increment.index % 9 == 0 {
                let error = shear_error(&scene, &c, march, increment);
                // After a reversal 2 mu p is taken off: the inner rim counts twice.
                let rims = if branch == 1 { 1.0 } else { 2.0 };
                close("q_x", error, 0.0, rims * FIELD * d);
                if increment.index == 51 {
                    ends.push(error);
                }
                let across = march.fields().q_y;
                assert!(norm(&across) < 1e-12 * norm(&march.fields().q_x));
            }
        });
        // A cell slips at its bound: increments of any size take what the path takes.
        close(
            "loop energy",
            dissipated / c.loop_energy(T_M),
            1.0,
            2.0 * SMOOTH * d * d + 2e-4,
        );
    }
    assert!(ends[0] / ends[2] > 3.0, "first order: {ends:?}");
}

#[test]
fn one_increment_per_reversal_is_exact() {
    let last_shear = |increments: usize| -> (Array2<f64>, f64) {
        let mut scene = scene(CORK, 96, increments);
        scene.settings.solver.tolerance = Some(1e-9);
        let mut kept = None;
        run(&scene, |march, increment| {
            kept = Some((march.fields().q_x, increment.motion.delta_x));
        });
        kept.expect("an increment")
    };
    let ((once, shift), (often, fine_shift)) = (last_shear(3), last_shear(60));
    // Both within the solver's tolerance of the same state.
    let error = norm(&(&once - &often)) / norm(&often);
    assert!(error < 1e-6, "{error}");
    close("delta_x", shift / fine_shift, 1.0, 1e-8);
}

#[test]
fn steel_follows_the_isotropic_formula_to_a_per_cent() {
    // With nu = 0.3 the closed form neglects q_y, a few per cent of mu p_H, in the slip annulus.
    let scene = scene(STEEL, 128, 50);
    let c = CattaneoMindlin::new(hertz_of(&scene), STEEL, STEEL, MU);
    let mut dissipated = 0.0;
    run(&scene, |march, increment| {
        let [_, shift, stick] = truth(&c, increment, 0.0);
        let branch = increment.point.branch;
        if branch >= 2 {
            dissipated += increment.energy.dissipated;
        }
        if branch > 0 {
            let c_num = radius(increment.stick_area);
            close("c", c_num / c.hertz.a, stick / c.hertz.a, 0.01);
            close(
                "delta_x",
                increment.motion.delta_x / c.shift_limit(),
                shift / c.shift_limit(),
                1e-3,
            );
            if increment.point.ends_branch {
                close("q_x", shear_error(&scene, &c, march, increment), 0.0, 0.01);
            }
        }
    });
    close("loop energy", dissipated / c.loop_energy(T_M), 1.0, 0.01);
}
