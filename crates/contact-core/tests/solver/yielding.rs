//! Bodies that yield: against finite elements, and against elastic bodies where nothing yields.
#![allow(missing_docs)]

use std::path::Path;

use contact_core::estimate::first_yield;
use contact_core::march::{Increment, March};
use contact_core::scene::{
    Body, Branch, Coating, Elastic, Friction, Grid, LoadPath, Loads, Plastic, PrescribedMotions,
    Profile, Scene, Shape,
};
use serde_json::Value;

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };

fn approach(delta_z: f64, increments: usize, t_end: f64) -> Branch {
    let given = PrescribedMotions {
        delta_z: Some(delta_z),
        ..PrescribedMotions::default()
    };
    let to = Loads {
        given,
        ..Loads::default()
    };
    Branch::new(to, increments, t_end)
}

fn indentation(R: f64, yields: Plastic, grid: Grid, path: Vec<Branch>) -> Scene {
    let mut body2 = Body::homogeneous(STEEL, Shape::Flat);
    body2.plastic = vec![Some(yields)];
    let path = LoadPath {
        branches: path,
        ..LoadPath::default()
    };
    let rigid = Body::homogeneous(Elastic::RIGID, Shape::Sphere { R });
    Scene::new(rigid, body2, Friction::coulomb(0.0), grid, path)
}

fn run(scene: &Scene) -> (Vec<Increment>, March) {
    let mut march = March::new(scene).expect("a scene");
    let mut increments = Vec::new();
    while let Some(increment) = march.advance() {
        increments.push(increment.expect("an increment"));
    }
    (increments, march)
}

fn number(of: &Value, key: &str) -> [f64; 2] {
    ["value", "error"].map(|part| of[key][part].as_f64().expect("a number of the table"))
}

#[test]
fn indentation_follows_finite_elements() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/plastic/rows.json");
    let text = std::fs::read_to_string(file).expect("the table");
    let table: Value = serde_json::from_str(&text).expect("a table");
    let rows = table["normal"].as_array().expect("rows");
    let bare = |row: &&Value| row["coatings"].as_array().is_some_and(Vec::is_empty);
    for row in rows.iter().filter(bare) {
        let law = &row["substrate"];
        let yields = Plastic {
            hardening: law["hardening"].as_f64().expect("a modulus"),
            ..Plastic::perfect(law["yield_stress"].as_f64().expect("a stress"))
        };
        let R = row["indenter"]["R"].as_f64().expect("a radius");
        let state = &row["states"][1];
        let delta_z = state["approach"].as_f64().expect("an approach");
        let radius = state["contact_radius_between"][1]
            .as_f64()
            .expect("a radius");
        let grid = Grid::centred(3.2 * radius, 32).expect("a grid");
        let path = vec![approach(delta_z, 5, 1.0), approach(-0.3 * delta_z, 1, 2.0)];
        let (increments, march) = run(&indentation(R, yields, grid, path));
        let name = &row["name"];
        let close = |what: &str, found: f64, [wanted, error]: [f64; 2], bar: f64| {
            let off = ((found - wanted).abs() - error).max(0.0) / wanted.abs();
            assert!(off < bar, "{name} {what}: {found:e} for {wanted:e}");
        };
        let loaded = &increments[4];
        close("load", loaded.point.loads.W, number(state, "load"), 7.5e-3);
        close(
            "volume",
            loaded.yielded.volume,
            number(state, "plastic_volume"),
            0.06,
        );
        // What unloads does not yield anew.
        assert_eq!(increments[5].energy.plastic, 0.0);
        let imprint = march.residual().expect("an imprint").gap;
        let depth = imprint.iter().fold(0.0_f64, |m, h| m.max(*h));
        close(
            "imprint",
            depth,
            number(&state["unloaded"], "imprint_depth"),
            0.02,
        );
    }
}

#[test]
fn the_energy_of_the_residual_stress_is_left_after_unloading() {
    let law = Plastic {
        hardening: 1e10,
        ..Plastic::perfect(1e9)
    };
    let grid = Grid::centred(6e-4, 24).expect("a grid");
    let path = vec![approach(6e-6, 4, 1.0), approach(-2e-6, 2, 2.0)];
    let (increments, mut march) = run(&indentation(0.01, law, grid, path));
    let left: f64 = increments.iter().map(|i| i.energy.elastic).sum();
    let state = march.state().yielded.clone().expect("plastic strain");
    let bodies = march.yielding().expect("a body that yields");
    let stress = bodies
        .stress(&state, None, (2, 0.0))
        .expect("residual stress");
    let (mesh, cells) = (bodies.mesh(2).expect("a mesh"), grid.nx * grid.ny);
    let volume = bodies.volume();
    // -1/2 int sigma : e dV, without any traction.
    let of_point = |point: &contact_core::yielding::PlasticPoint| {
        let plane = point.plane as usize;
        let cell = volume.cell(point.cell).expect("on the grid");
        let at = |c: usize| stress[(plane * 6 + c) * cells + cell];
        let sum = |c: usize| (if c < 3 { 1.0 } else { 2.0 }) * at(c) * point.strain[c];
        -0.5 * grid.cell_area() * mesh.weight(plane) * (0..6).map(sum).sum::<f64>()
    };
    let locked: f64 = state.bodies[0].points.iter().map(of_point).sum();
    assert!(
        locked > 0.0 && (left / locked - 1.0).abs() < 2e-3,
        "{left:e}, {locked:e}"
    );
    let done: f64 = increments.iter().map(|i| i.energy.plastic).sum();
    assert!(locked < 0.2 * done, "{locked:e} of {done:e}");
    for increment in &increments {
        assert!(increment.energy.imbalance().abs() < 1e-6 * done);
    }
}

#[test]
fn bodies_that_do_not_reach_their_yield_stress_are_elastic_to_the_bit() {
    let law = Plastic::perfect(1e12);
    let grid = Grid::centred(4e-4, 32).expect("a grid");
    let mut scene = indentation(0.01, law, grid, vec![approach(2e-6, 3, 1.0)]);
    scene.body2.coatings = vec![Coating {
        material: Elastic { E: 300e9, nu: 0.25 },
        thickness: 2e-5,
    }];
    scene.body2.plastic = vec![None, Some(law)];
    scene.friction = Friction::coulomb(0.3);
    let (mut yielding, march) = run(&scene);
    let (elastic, other) = run(&scene.elastic());
    for increment in &mut yielding {
        // How far it is from yielding is told only of a body that may.
        let reached = std::mem::take(&mut increment.yielded.reached);
        assert!(reached > 0.0 && reached < 1.0, "{reached}");
    }
    assert_eq!(yielding, elastic);
    assert_eq!(march.tractions(), other.tractions());
}

#[test]
fn a_run_goes_on_from_its_state_to_the_same_bits() {
    let law = Plastic {
        hardening: 1e10,
        ..Plastic::perfect(1e9)
    };
    let grid = Grid::centred(5e-4, 24).expect("a grid");
    let scene = indentation(0.01, law, grid, vec![approach(3e-6, 4, 1.0)]);
    let (whole, ended) = run(&scene);
    let mut first = March::new(&scene).expect("a scene");
    for _ in 0..2 {
        first
            .advance()
            .expect("an increment")
            .expect("an increment");
    }
    let mut second = March::resume(&scene, first.state().clone()).expect("the state");
    let rest: Vec<Increment> = (0..2)
        .map(|_| {
            second
                .advance()
                .expect("an increment")
                .expect("an increment")
        })
        .collect();
    assert_eq!(whole[2..], rest[..]);
    assert_eq!(ended.state(), second.state());
}

/// A hard film on a soft substrate, pressed by a rigid ball in one increment.
fn hard_film() -> Scene {
    let substrate = Plastic::perfect(3e8);
    let to = Loads {
        W: 300.0,
        ..Loads::default()
    };
    let grid = Grid::centred(1.2e-3, 24).expect("a grid");
    let mut scene = indentation(0.005, substrate, grid, vec![Branch::new(to, 1, 1.0)]);
    scene.body2.substrate = Elastic { E: 115e9, nu: 0.32 };
    scene.body2.coatings = vec![Coating {
        material: Elastic { E: 460e9, nu: 0.2 },
        thickness: 3e-5,
    }];
    let film = Plastic {
        hardening: 1e10,
        ..Plastic::perfect(3.1e9)
    };
    scene.body2.plastic = vec![Some(film), Some(substrate)];
    scene
}

/// The film comes to 2.2 GPa on an elastic substrate, 0.72 of its yield stress, and to 3.3 GPa once the
/// substrate has given way.
#[test]
fn no_point_is_beyond_its_yield_stress() {
    let scene = hard_film();
    let (_, mut march) = run(&scene);
    let [p, q_x, q_y] = march.tractions();
    let state = march.state().yielded.clone().expect("plastic strain");
    let bodies = march.yielding().expect("a body that yields");
    let stress = bodies.stress(&state, Some([&p, &q_x, &q_y]), (2, 0.0));
    let stress = stress.expect("a stress");
    let (volume, mesh) = (bodies.volume(), bodies.mesh(2).expect("a mesh"));
    let cells = volume.cells.len();
    let mut hardened = vec![0.0; mesh.planes() * cells];
    for point in &state.bodies[0].points {
        let cell = volume.cell(point.cell).expect("on the grid");
        hardened[point.plane as usize * cells + cell] = point.equivalent;
    }
    let mut worst = 0.0_f64;
    for plane in 0..mesh.planes() {
        let law = scene.body2.plastic[mesh.layer(plane)].expect("a law");
        for cell in 0..cells {
            let s: [f64; 6] = std::array::from_fn(|c| stress[(plane * 6 + c) * cells + cell]);
            let mean = (s[0] + s[1] + s[2]) / 3.0;
            let of = |c: usize| {
                if c < 3 {
                    (s[c] - mean).powi(2)
                } else {
                    2.0 * s[c] * s[c]
                }
            };
            let mises = (1.5 * (0..6).map(of).sum::<f64>()).sqrt();
            let limit = law.s_y + law.hardening * hardened[plane * cells + cell];
            worst = worst.max(mises / limit);
        }
    }
    assert!(worst < 1.0 + 1e-3, "{worst} of the yield stress");
}

#[test]
fn the_volume_grid_grows_once_where_the_plastic_zone_reaches_its_border() {
    // On a grid that holds the contact alone the zone beside it comes to the border.
    let law = Plastic {
        hardening: 2e10,
        ..Plastic::perfect(4e8)
    };
    let scene = |extent: f64, n: usize, law: Plastic| {
        let grid = Grid::centred(extent, n).expect("a grid");
        indentation(0.01, law, grid, vec![approach(3.5e-6, 3, 1.0)])
    };
    let narrow = scene(5.2e-4, 16, law);
    let (increments, march) = run(&narrow);
    let state = march.state().yielded.clone().expect("plastic strain");
    assert!(state.grown && !state.at_border);
    assert!(
        increments
            .iter()
            .all(|increment| !increment.yielded.at_border)
    );
    // The work is that on a grid that is wide from the beginning.
    let (wide, _) = run(&scene(2.0 * 5.2e-4, 32, law));
    let work = |of: &[Increment]| of.iter().map(|i| i.energy.plastic).sum::<f64>();
    let (found, wanted) = (work(&increments), work(&wide));
    assert!(
        (found / wanted - 1.0).abs() < 5e-3,
        "{found:e} for {wanted:e}"
    );
    // From every increment to the same bits, before the grid grows and after.
    for kept in 1..increments.len() {
        let mut first = March::new(&narrow).expect("a scene");
        for _ in 0..kept {
            first
                .advance()
                .expect("an increment")
                .expect("an increment");
        }
        let mut second = March::resume(&narrow, first.state().clone()).expect("the state");
        for wanted in &increments[kept..] {
            let found = second
                .advance()
                .expect("an increment")
                .expect("an increment");
            assert_eq!(found, *wanted);
        }
        assert_eq!(second.state(), march.state());
    }
    // A zone that comes to the second border is doubted.
    let (beyond, _) = run(&scene(5.2e-4, 16, Plastic { s_y: 1e8, ..law }));
    assert!(beyond[2].yielded.at_border);
}

#[test]
fn yielding_begins_where_hertz_says() {
    let law = Plastic::perfect(1e9);
    let to = Loads {
        W: 400.0,
        ..Loads::default()
    };
    let grid = Grid::centred(6e-4, 64).expect("a grid");
    let scene = indentation(0.01, law, grid, vec![Branch::new(to, 4, 1.0)]);
    let found = first_yield(&scene).expect("a scene").expect("a load");
    // Johnson, Contact Mechanics, eq. (6.8) with p_0 = 1.613 Y for nu = 0.3, at 0.48 a.
    let modulus = STEEL.E / (1.0 - STEEL.nu * STEEL.nu);
    let p_0: f64 = 1.613 * law.s_y;
    let W = (std::f64::consts::PI * p_0).powi(3) * 1e-4 / (6.0 * modulus * modulus);
    assert!((found.W / W - 1.0).abs() < 0.02, "{} for {W}", found.W);
    let a = std::f64::consts::PI * p_0 * 0.01 / (2.0 * modulus);
    assert!(
        (found.depth / a - 0.48).abs() < 0.08,
        "{:?}",
        found.depth / a
    );
    assert_eq!((found.body, found.layer), (2, 0));
}

#[test]
fn a_mean_pressure_that_nothing_bears_is_refused_with_its_load() {
    let law = Plastic::perfect(1e8);
    let to = |W: f64| Loads {
        W,
        ..Loads::default()
    };
    let grid = Grid::centred(1e-3, 32).expect("a grid");
    let scene =
        |W: f64, law: Plastic| indentation(0.01, law, grid, vec![Branch::new(to(W), 4, 1.0)]);
    let said = scene(100.0, law).check().expect_err("too much").to_string();
    assert!(
        said.contains("body2.plastic.hardening") && said.contains("2.8 s_y"),
        "{said}"
    );
    // 356 times the load of first yield, 0.0398 N.
    assert!(said.contains("1.4") && said.contains("e1 N"), "{said}");
    scene(13.0, law).check().expect("less than that");
    let hardening = 1e9;
    scene(100.0, Plastic { hardening, ..law })
        .check()
        .expect("it hardens");
}

/// Below a ball s_xx - s_zz of the contact is positive: a residual compression s_R = s_xx = s_yy is added to the
/// yield stress, so that loads of first yield grow as ((s_y - s_R)/s_y)^3.
#[test]
fn residual_compression_moves_first_yield_as_it_does_by_hand() {
    let law = Plastic::perfect(1e9);
    let grid = Grid::centred(6e-4, 32).expect("a grid");
    let of = |W: f64, residual: Vec<Profile>| {
        let to = Loads {
            W,
            ..Loads::default()
        };
        let mut scene = indentation(0.01, law, grid, vec![Branch::new(to, 1, 1.0)]);
        scene.body2.residual = residual;
        scene
    };
    let begins = |residual: Vec<Profile>| {
        let found = first_yield(&of(400.0, residual)).expect("a scene");
        found.expect("a load")
    };
    let bare = begins(Vec::new());
    let s_R = -3e8;
    let pressed = begins(vec![Profile::uniform(s_R)]);
    let ratio = pressed.W / bare.W;
    assert!((ratio / 1.3_f64.powi(3) - 1.0).abs() < 0.01, "{ratio}");
    // Compression at the surface, which ends above the point that yields: the load is that without.
    let shallow = Profile {
        rows: vec![[0.0, s_R, s_R], [0.3 * bare.depth, 0.0, 0.0]],
    };
    let ratio = begins(vec![shallow]).W / bare.W;
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    // Tension s along x alone: von Mises of (s_r + s, s_r, s_z) with d = s_r - s_z, over s_y.
    let s = 0.2_f64;
    let mises = |d: f64| (((d + s).powi(2) + d * d + s * s) / 2.0).sqrt();
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if mises(middle) < 1.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let along = Profile {
        rows: vec![[0.0, 2e8, 0.0]],
    };
    let ratio = begins(vec![along]).W / bare.W;
    assert!(
        (ratio / low.powi(3) - 1.0).abs() < 0.02,
        "{ratio} for {}",
        low.powi(3)
    );

    // How far a load is from yielding, and that it yields beyond.
    let run_at = |W: f64| run(&of(W, vec![Profile::uniform(s_R)])).0[0];
    let below = run_at(1.5 * bare.W);
    let reached = 1.5_f64.cbrt() + s_R / law.s_y;
    assert!(
        (below.yielded.reached / reached - 1.0).abs() < 0.02,
        "{below:?}"
    );
    assert_eq!(below.energy.plastic, 0.0);
    assert!(run_at(2.4 * bare.W).energy.plastic > 0.0);
    assert!(run(&of(1.5 * bare.W, Vec::new())).0[0].energy.plastic > 0.0);
    // The work of the trapezoidal rule is that along the curve: that of the residual stress counts.
    let to = |W: f64| Loads {
        W,
        ..Loads::default()
    };
    let mut scene = of(1.0, vec![Profile::uniform(s_R)]);
    scene.path.branches = vec![Branch::new(to(8.0 * bare.W), 12, 1.0)];
    let done = run(&scene).0;
    let sum = |f: fn(&Increment) -> f64| done.iter().map(f).sum::<f64>();
    let (plastic, quadrature) = (sum(|i| i.energy.plastic), sum(|i| i.energy.quadrature));
    assert!(
        plastic > 0.0 && quadrature.abs() < 0.05 * plastic,
        "{quadrature:e} of {plastic:e}"
    );
    // A residual stress that alone is beyond the yield stress is refused.
    let said = of(1.0, vec![Profile::uniform(-1.1e9)])
        .check()
        .expect_err("too much");
    let said = said.to_string();
    assert!(
        said.contains("body2.residual = 1.1e9 Pa by von Mises"),
        "{said}"
    );
}
