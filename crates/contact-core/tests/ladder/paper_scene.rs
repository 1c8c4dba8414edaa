//! The paper's fretting contact, its section 4: a sphere on a coated flat, three tangential loads.

use contact_core::march::{Fields, Increment, Motion};
use contact_core::scene::{Elastic, Scene};
use contact_reference::CattaneoMindlin;

use crate::bench::{
    FIELD, STEEL, W, cell, close, coated, hertz_of, indentation, radius, run_audited,
    sphere_on_flat,
};

const MU: f64 = 0.3;
const T_M: f64 = 0.9 * MU * W;
/// Increments: indentation in steps of equal radius, then a quarter of a full swing of T.
const INDENTATION: usize = 100;
const QUARTER: usize = 20;

/// E1/E2 = `ratio`, coating as thick as a_H, 2.4 a_H x 2.4 a_H.
fn scene(ratio: f64, n: usize) -> Scene {
    let path = indentation(INDENTATION).tangential(&[T_M, -T_M, T_M, -T_M, T_M], 9 * QUARTER);
    let scene = sphere_on_flat(STEEL, STEEL, MU, (2.4, n), path);
    let a_H = hertz_of(&scene).a;
    let coating = Elastic {
        E: ratio * STEEL.E,
        nu: 0.3,
    };
    let mut scene = coated(scene, coating, a_H);
    // E1/E2 = 1 goes through the conversion too.
    scene.settings.skip.equal_layers = false;
    scene
}

/// What a run leaves: every increment, and the fields at the ends of the branches.
struct Run {
    increments: Vec<Increment>,
    ends: Vec<Fields>,
}

fn audited(scene: &Scene) -> Run {
    let mut ends = Vec::new();
    let increments = run_audited(scene, |march, increment| {
        if increment.point.ends_branch {
            ends.push(march.fields());
        }
    });
    Run { increments, ends }
}

impl Run {
    fn branch(&self, branch: usize) -> impl Iterator<Item = &Increment> {
        self.increments
            .iter()
            .filter(move |i| i.point.branch == branch)
    }

    fn dissipated(&self, branches: [usize; 2]) -> f64 {
        let of = |b: usize| self.branch(b).map(|i| i.energy.dissipated).sum::<f64>();
        of(branches[0]) + of(branches[1])
    }

    fn motion_after(&self, branch: usize) -> Motion {
        self.branch(branch).last().expect("an increment").motion
    }
}

/// Numbers of an independent implementation at 128 x 128 with 1000 increments.
struct Truth {
    ratio: f64,
    p_max: f64,
    radius: f64,
    stick_ratio: f64,
    stick_middle: f64,
    q_after_indentation: f64,
}

const TRUTHS: [Truth; 3] = [
    Truth {
        ratio: 0.5,
        p_max: 0.8165,
        radius: 1.119,
        stick_ratio: 0.211,
        stick_middle: -0.066,
        q_after_indentation: 0.068,
    },
    Truth {
        ratio: 2.0,
        p_max: 1.1796,
        radius: 0.923,
        stick_ratio: 0.209,
        stick_middle: 0.084,
        q_after_indentation: 0.134,
    },
    Truth {
        ratio: 4.0,
        p_max: 1.3436,
        radius: 0.872,
        stick_ratio: 0.198,
        stick_middle: 0.169,
        q_after_indentation: 0.294,
    },
];

#[test]
fn coatings_move_the_stick_zone_and_the_loops_settle() {
    for truth in &TRUTHS {
        let scene = scene(truth.ratio, 128);
        let hertz = hertz_of(&scene);
        let run = audited(&scene);
        let last = run.increments.last().expect("an increment");
        close("p_max", last.p_max / hertz.p0 / truth.p_max, 1.0, 0.005);
        close(
            "radius",
            radius(last.contact_area) / hertz.a / truth.radius,
            1.0,
            0.01,
        );
        close("stick ratio", last.stick_ratio(), truth.stick_ratio, 0.01);

        let row = scene.grid.ny / 2;
        let stuck: Vec<f64> = (0..scene.grid.nx)
            .filter(|&i| run.ends[1].stick[[i, row]])
            .map(|i| scene.grid.x(i))
            .collect();
        let middle = f64::midpoint(stuck[0], stuck[stuck.len() - 1]) / hertz.a;
        close("middle of the stick zone", middle, truth.stick_middle, 0.02);

        let highest = (0..scene.grid.nx)
            .map(|i| run.ends[0].q_x[[i, row]].abs())
            .fold(0.0, f64::max);
        let q = highest / (MU * hertz.p0) / truth.q_after_indentation;
        close("q_x after indentation", q, 1.0, 0.1);

        for branch in 2..=5 {
            // A step of 1/20 of a quarter: the slip annulus is at most 3 % of the area.
            let first = run.branch(branch).next().expect("an increment");
            assert!(first.stick_ratio() > 0.95, "{}", first.stick_ratio());
        }
        // The curves of figure 12; the energies differ by up to 5 %, since the first loop still
        // wipes out what the indentation left.
        let range = run.motion_after(1).delta_x - run.motion_after(2).delta_x;
        for (first, second) in [(2, 4), (3, 5)] {
            let apart = run.branch(first).zip(run.branch(second));
            let apart = apart.map(|(a, b)| (a.motion.delta_x - b.motion.delta_x).abs());
            close("loops apart", apart.fold(0.0, f64::max) / range, 0.0, 0.01);
        }
    }
}

#[test]
fn a_coating_like_its_substrate_gives_cattaneo_and_mindlin() {
    let scene = scene(1.0, 128);
    let hertz = hertz_of(&scene);
    let c = CattaneoMindlin::new(hertz, STEEL, STEEL, MU);
    let run = audited(&scene);
    let rest = run.ends[0].q_x.iter().chain(&run.ends[0].q_y);
    let rest = rest.fold(0.0, |m: f64, q| m.max(q.abs()));
    assert!(rest <= 1e-8 * MU * hertz.p0, "{:e}", rest / (MU * hertz.p0));

    let row = scene.grid.ny / 2;
    let y = scene.grid.y(row);
    for (fields, T) in run.ends[1..].iter().zip([T_M, -T_M, T_M, -T_M, T_M]) {
        let (mut misfit, mut size) = (0.0, 0.0);
        for i in 0..scene.grid.nx {
            let exact = c.q_loading(scene.grid.x(i).hypot(y), T);
            misfit += (fields.q_x[[i, row]] - exact).powi(2);
            size += exact * exact;
        }
        // On a line only four rim cells of a hundred count.
        close(
            "q_x on y = 0",
            (misfit / size).sqrt(),
            0.0,
            FIELD * cell(&scene) + 0.01,
        );
    }
    for branches in [[2, 3], [4, 5]] {
        let loops = run.dissipated(branches) / c.loop_energy(T_M);
        close("loop energy", loops, 1.0, 0.01);
    }
}
