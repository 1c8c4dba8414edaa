//! Plane strain: Hertz, Cattaneo, a bulk stress, McEwen, rolling.

use contact_core::Scene;
use contact_core::convolution::Tractions;
use contact_core::march::{Fields, Increment};
use contact_core::scene::{Coating, Elastic, Grid, LoadPath, Shape};
use contact_reference::{LineContact, line_contact};
use contact_subsurface::{Depth, Line, Section, Side};
use ndarray::Array2;

use crate::bench::{CORK, FIELD, R, SMOOTH, STEEL, close, norm, run, sphere_on_flat};

const MU: f64 = 0.3;
/// Force per length \[N/m\].
const W: f64 = 1e5;
/// Length of the grid over the contact half-width.
const EXTENT: f64 = 2.4;

fn e_star(upper: Elastic, lower: Elastic) -> f64 {
    let compliance = |m: Elastic| (1.0 - m.nu * m.nu) / m.E;
    1.0 / (compliance(upper) + compliance(lower))
}

/// A cylinder on a flat, `n` cells.
fn cylinder(upper: Elastic, lower: Elastic, n: usize, path: LoadPath) -> (Scene, LineContact) {
    let line = line_contact(R, e_star(upper, lower), W);
    let mut scene = sphere_on_flat(upper, lower, MU, (1.0, 4), path);
    scene.body1.shape = Shape::Cylinder {
        R,
        length: f64::INFINITY,
        angle: 0.0,
    };
    scene.grid = Grid::strip(EXTENT * line.a, n, 1.0).expect("a grid");
    (scene, line)
}

/// Runs and checks the balance of every increment; one that rolls with slip takes energy.
fn audited(scene: &Scene) -> Vec<(Fields, Increment)> {
    let mut all: Vec<(Fields, Increment)> = Vec::new();
    run(scene, |march, increment| {
        let fields = march.fields();
        let r = increment.residuals;
        assert!(r.balance < 1e-9, "{r:?} at {}", increment.index);
        let still = increment.point.loads.rolled == 0.0;
        assert!(still || increment.energy.dissipated > 0.0);
        all.push((fields, *increment));
    });
    all
}

/// First and last place where a mask holds \[m\].
fn ends(scene: &Scene, mask: &Array2<bool>) -> (f64, f64) {
    let held: Vec<usize> = (0..scene.grid.nx).filter(|&i| mask[(i, 0)]).collect();
    let half = 0.5 * scene.grid.dx;
    (
        scene.grid.x(held[0]) - half,
        scene.grid.x(held[held.len() - 1]) + half,
    )
}

/// Under little friction the stick zone is narrower than a cell. If no cell lies in the middle all
/// but one slip, which takes up what the bounds leave of the force.
#[test]
fn a_stick_zone_narrower_than_a_cell_is_no_obstacle() {
    let aluminium = Elastic { E: 70e9, nu: 0.33 };
    for (lower, n) in [(CORK, 60), (aluminium, 60), (aluminium, 72)] {
        let (mut scene, _) = cylinder(STEEL, lower, n, LoadPath::start().normal(2.5e4, 1));
        scene.friction.mu = 0.02;
        scene.body1.shape = Shape::Cylinder {
            R: 0.0175,
            length: f64::INFINITY,
            angle: 0.0,
        };
        scene.grid = Grid::strip(7e-4, n, 1.0).expect("a grid");
        run(&scene, |march, increment| {
            let (fields, r) = (march.fields(), increment.residuals);
            assert!(r.balance < 1e-9 && r.coulomb < 1e-9, "{r:?}");
            let T = fields.q_x.sum() * scene.grid.cell_area();
            assert!(T.abs() < 1e-9 * 0.02 * 2.5e4, "{T} N");
            assert!(increment.work.convolutions < 20.0, "{:?}", increment.work);
            assert!(fields.stick.iter().filter(|s| **s).count() < 3);
        });
    }
}

#[test]
fn cylinders_of_hertz_and_cattaneo() {
    let n = 128;
    let T = 0.6 * MU * W;
    // In plane strain Cattaneo is exact for every nu.
    for material in [STEEL, CORK] {
        let path = LoadPath::start().normal(W, 1).tangential(&[T], 1);
        let (scene, line) = cylinder(material, material, n, path);
        let cell = EXTENT / n as f64;
        let hertz = scene.hertz().expect("a Hertz contact");
        assert!((hertz.a / line.a - 1.0).abs() < 1e-14 && (hertz.p0 / line.p0 - 1.0).abs() < 1e-14);
        let all = audited(&scene);
        let (fields, end) = &all[1];
        let p = scene.grid.map(|x, _| line.p(x));
        let error = norm(&(&fields.p - &p)) / norm(&p);
        assert!(error < FIELD * cell, "{error}");
        close(
            "delta_z",
            end.motion.delta_z / hertz.delta_z,
            1.0,
            SMOOTH * cell * cell,
        );
        let q = scene.grid.map(|x, _| line.q(x, T, MU));
        let error = norm(&(&fields.q_x - &q)) / norm(&p) / MU;
        assert!(error < 2.0 * FIELD * cell, "{error}");
        let c = line.stick_half_width(T, MU);
        let (left, right) = ends(&scene, &fields.stick);
        close("stick width", (right - left) / (2.0 * c), 1.0, 2.0 * cell);
    }
}

#[test]
fn the_line_is_the_middle_of_a_long_row() {
    // A coated body: a row of cells a thousand contacts long is a strip.
    let coat = |scene: &mut Scene, a: f64| {
        scene.body2.coatings = vec![Coating {
            material: Elastic { E: 600e9, nu: 0.2 },
            thickness: 0.5 * a,
        }];
    };
    let path = LoadPath::start()
        .normal(W, 2)
        .tangential(&[0.5 * MU * W], 3);
    let (mut strip, line) = cylinder(STEEL, CORK, 48, path);
    coat(&mut strip, line.a);
    let mut row = strip.clone();
    let long = 3e3 * line.a;
    row.grid = Grid::from_spacing((48, 3), (strip.grid.dx, long)).expect("a grid");
    row.grid.plane_strain = false;
    row.path = LoadPath::start();
    let body1 = Shape::Cylinder {
        R,
        length: 1.5 * long,
        angle: 0.0,
    };
    row.body1.shape = body1;
    row.path = LoadPath::start()
        .normal(W * long, 2)
        .tangential(&[0.5 * MU * W * long], 3);
    let (ours, theirs) = (audited(&strip), run(&row, |_, _| ()));
    let (ours, theirs) = (&ours[4].1, theirs.last().expect("an increment"));
    // Of a row of the length L, what p does to u_z differs from the line's by (x/L)^2 beside a
    // constant, and what it does to u_x, that is 2/pi atan(L/2x) of the line's, by 4/pi x/L.
    let x_over_L = EXTENT * line.a / long;
    close("p_max", ours.p_max / theirs.p_max, 1.0, 1e-5);
    close(
        "q_max",
        ours.q_max / theirs.q_max,
        1.0,
        4.0 / std::f64::consts::PI * x_over_L,
    );
    close(
        "stick ratio",
        ours.stick_ratio(),
        theirs.stick_ratio(),
        2e-3,
    );
}

#[test]
fn a_bulk_stress_shifts_the_stick_zone() {
    let n = 256;
    let T = 0.6 * MU * W;
    for part in [-0.2, 0.3] {
        // e = a sigma_B/(4 mu p0) for similar bodies.
        let (bare, line) = cylinder(STEEL, STEEL, n, LoadPath::start());
        let sigma_B = part * 4.0 * MU * line.p0;
        let mut scene = bare;
        scene.path = LoadPath::start()
            .normal(W, 1)
            .change_to(|to| (to.T_x, to.sigma_B) = (T, sigma_B), 5);
        let eps_x = sigma_B * (1.0 - STEEL.nu * STEEL.nu) / STEEL.E;
        let e = line.stick_middle(eps_x, e_star(STEEL, STEEL), MU);
        close("e/a", e / line.a, part, 1e-12);
        let all = audited(&scene);
        let fields = &all.last().expect("an increment").0;
        let cell = EXTENT / n as f64;
        let (left, right) = ends(&scene, &fields.stick);
        close("middle", 0.5 * (left + right) / line.a, part, cell);
        close(
            "width",
            0.5 * (right - left) / line.a,
            line.stick_half_width(T, MU) / line.a,
            cell,
        );
        let q = scene.grid.map(|x, _| line.q_shifted(x, e, T, MU));
        let p = scene.grid.map(|x, _| line.p(x));
        let error = norm(&(&fields.q_x - &q)) / norm(&p) / MU;
        assert!(error < 2.0 * FIELD * cell, "{error}");
    }
}

#[test]
fn a_bulk_stress_out_of_phase_keeps_the_energy() {
    let (mut scene, line) = cylinder(STEEL, CORK, 96, LoadPath::start());
    let (T, sigma) = (0.4 * MU * W, 1.5 * MU * line.p0);
    let mut path = LoadPath::start().normal(W, 3);
    for (x, s) in [
        (1.0, 0.0),
        (0.0, 1.0),
        (-1.0, 0.0),
        (0.0, -1.0),
        (1.0, 0.0),
        (0.0, 1.0),
    ] {
        path = path.change_to(move |to| (to.T_x, to.sigma_B) = (x * T, s * sigma), 4);
    }
    scene.path = path;
    scene.settings.solver.tolerance = Some(1e-8);
    let all = audited(&scene);
    // Back at the same loads after a cycle: the loop has closed.
    let (one, two) = (&all[3 + 3].0, &all[3 + 19].0);
    assert!(norm(&(&one.q_x - &two.q_x)) > 0.0);
    let dissipated: f64 = all.iter().map(|(_, i)| i.energy.dissipated).sum();
    assert!(dissipated > 0.0);
    // On a grid in three dimensions the surface contracts across the stress.
    let mut sphere = sphere_on_flat(STEEL, CORK, MU, (2.6, 32), LoadPath::start());
    sphere.path = LoadPath::start()
        .normal(crate::bench::W, 3)
        .change_to(|to| to.sigma_B = 2e8, 3)
        .change_to(|to| to.T_y = 0.5 * MU * crate::bench::W, 3);
    for i in run(&sphere, |_, _| ()) {
        assert!(
            i.residuals.energy.abs() < sphere.tolerance() && i.energy.dissipated >= -1e-12,
            "{:?}",
            i.energy
        );
    }
}

#[test]
fn the_stress_of_mcewen() {
    let n = 256;
    let T = 0.6 * MU * W;
    let path = LoadPath::start().normal(W, 1).tangential(&[T], 1);
    let (scene, line) = cylinder(STEEL, STEEL, n, path);
    let all = audited(&scene);
    let fields = &all[1].0;
    let state = Tractions {
        q_x: fields.q_x.as_slice(),
        q_y: fields.q_y.as_slice(),
        p: fields.p.as_slice(),
    };
    let section = Section::new(
        &scene.body2,
        Side::Body2,
        &scene.grid,
        Line::AlongX(0.0),
        &[state],
    )
    .expect("a section");
    let depths: Vec<Depth> = [0.05, 0.25, 0.78, 2.0]
        .map(|z| Depth {
            z: z * line.a,
            layer: 0,
        })
        .to_vec();
    let stress = &section.stress(&depths).expect("stress")[0];
    let cell = EXTENT / n as f64;
    for (k, depth) in depths.iter().enumerate() {
        for i in 0..n {
            let truth = line.partial_slip_stress((scene.grid.x(i), depth.z), T, MU);
            // The tractions are those of the cells: near the surface the rim shows.
            let allowed = if k == 0 { 8.0 * cell } else { cell };
            for (row, truth) in [(0, truth[0]), (2, truth[1]), (4, truth[2])] {
                close(
                    "stress/p0",
                    stress[(row, k, i)] / line.p0,
                    truth / line.p0,
                    allowed,
                );
            }
            let (s_xx, s_yy, s_zz) = (stress[(0, k, i)], stress[(1, k, i)], stress[(2, k, i)]);
            close(
                "plane strain",
                s_yy / line.p0,
                STEEL.nu * (s_xx + s_zz) / line.p0,
                1e-6,
            );
        }
    }
}

#[test]
fn rolling_goes_from_cattaneo_to_carter() {
    let n = 240;
    let T = 0.6 * MU * W;
    let (mut scene, line) = cylinder(STEEL, STEEL, n, LoadPath::start());
    let way = 400;
    let rolled = way as f64 * scene.grid.dx;
    scene.path = LoadPath::start()
        .normal(W, 1)
        .tangential(&[T], 1)
        .change_to(|to| to.rolled = rolled, way);
    let all = audited(&scene);
    let cell = EXTENT / n as f64;
    let c = line.stick_half_width(T, MU);
    // At first the stick zone lies in the middle, in the end at the leading edge.
    let (left, right) = ends(&scene, &all[1].0.stick);
    close(
        "Cattaneo's middle",
        0.5 * (left + right) / line.a,
        0.0,
        cell,
    );
    let (fields, end) = &all[all.len() - 1];
    let (left, right) = ends(&scene, &fields.stick);
    let d = line.a - c;
    close(
        "Carter's middle",
        0.5 * (left + right) / line.a,
        d / line.a,
        2.0 * cell,
    );
    close("stick width", (right - left) / (2.0 * c), 1.0, 3.0 * cell);
    let p = scene.grid.map(|x, _| line.p(x));
    let q = scene.grid.map(|x, _| line.q_shifted(x, d, T, MU));
    let error = norm(&(&fields.q_x - &q)) / norm(&p) / MU;
    assert!(error < 4.0 * FIELD * cell, "{error}");
    // Creepage mu (a - c)/R: the shift per way rolled.
    let before = &all[all.len() - 2].1;
    let creep = (end.motion.delta_x - before.motion.delta_x) / scene.grid.dx;
    // The way leaves a third of a per mille; cells that enter leave second order of a cell.
    close("creepage", creep / (MU * d / R), 1.0, 5e-4);
    // What is dissipated is the work of T on the creep.
    close(
        "dissipated",
        end.energy.dissipated / (T * creep * scene.grid.dx),
        1.0,
        1e-3,
    );
}

#[test]
fn a_coated_body_rolls_into_a_steady_state() {
    let n = 120;
    let (mut scene, line) = cylinder(CORK, STEEL, n, LoadPath::start());
    scene.body2.coatings = vec![Coating {
        material: Elastic { E: 420e9, nu: 0.25 },
        thickness: 0.4 * line.a,
    }];
    // Creep per increment is a small difference of shifts.
    scene.settings.solver.tolerance = Some(1e-9);
    let way = 480;
    let rolled = way as f64 * scene.grid.dx;
    scene.path = LoadPath::start()
        .normal(W, 4)
        .tangential(&[0.5 * MU * W], 4)
        .change_to(|to| to.rolled = rolled, way);
    let all = audited(&scene);
    let creep =
        |k: usize| all[all.len() - k].1.motion.delta_x - all[all.len() - k - 1].1.motion.delta_x;
    close("steady creep", creep(1) / creep(2), 1.0, 1e-4);
}
