//! One coating, no friction: the integral-equation solution, any indenter.

use std::collections::HashMap;

use contact_core::scene::{Body, Coating, Elastic, Grid, LoadPath, Scene, Shape};
use contact_reference::{CoatedIndentation, coated_indentation, hertz};
use serde_json::Value;

use crate::bench::{
    FIELD, R, RIM, SMOOTH, STEEL, W, WHOLE_CELLS, close, coated, norm, run, sphere_on_flat,
};

/// Runs one frictionless increment and compares it with the truth.
fn compare(scene: &Scene, truth: &CoatedIndentation) {
    let d = scene.grid.dx / truth.a;
    // A stiff coating narrows the field it carries to its own thickness.
    let h = scene.body2.coatings[0].thickness;
    let narrow = (scene.grid.dx / h).powi(2);
    let smooth = SMOOTH * (d * d + narrow) + 1e-4;
    // Eight cells of a round contact have one radius.
    let mut known = HashMap::new();
    let exact = scene.grid.map(|x, y| {
        let r = x.hypot(y);
        *known.entry(r.to_bits()).or_insert_with(|| truth.p(r))
    });
    run(scene, |march, increment| {
        let p = march.fields().p;
        let highest = truth.p(scene.grid.dx / 2f64.sqrt());
        // The pressure a few cells inside tells less of the rim where it changes over the coating's
        // thickness: what a parabola leaves out over some four cells.
        let rim = RIM + 16.0 * narrow;
        close("a", increment.contact_radius / truth.a, 1.0, rim * d);
        close("p_max", increment.p_max / highest, 1.0, smooth);
        close(
            "delta_z",
            increment.motion.delta_z / truth.delta_z,
            1.0,
            smooth,
        );
        close("p", norm(&(&p - &exact)) / norm(&exact), 0.0, FIELD * d);
    });
}

/// E1/E2 and h/a0 of the rows of the table.
const ROWS: [(f64, f64); 8] = [
    (0.25, 0.25),
    (2.0, 0.25),
    (0.5, 0.5),
    (4.0, 0.5),
    (0.25, 1.0),
    (2.0, 1.0),
    (0.5, 2.0),
    (4.0, 2.0),
];

/// A rigid sphere under the Hertz load of the bare substrate, `n` cells a side, and the truth.
fn row(ratio: f64, h: f64, n: usize) -> (Scene, CoatedIndentation) {
    let bare = hertz(R, Elastic::RIGID, STEEL, W);
    let layer = Coating {
        material: Elastic {
            E: ratio * STEEL.E,
            nu: 0.3,
        },
        thickness: h * bare.a,
    };
    let truth = coated_indentation(R, Elastic::RIGID, layer, STEEL, W).expect("a closed form");
    let path = LoadPath::start().normal(W, 1);
    let extent = 2.3 * truth.a / bare.a;
    let scene = sphere_on_flat(Elastic::RIGID, STEEL, 0.0, (extent, n), path);
    (coated(scene, layer.material, layer.thickness), truth)
}

#[test]
fn a_rigid_sphere_at_the_load_of_the_bare_substrate() {
    for (ratio, h) in ROWS {
        let (scene, truth) = row(ratio, h, 128);
        compare(&scene, &truth);
    }
}

#[test]
fn radius_pressure_and_approach_within_three_per_mille_at_512() {
    for (ratio, h) in ROWS {
        let (scene, truth) = row(ratio, h, 512);
        run(&scene, |_, increment| {
            close("a", increment.contact_radius / truth.a, 1.0, 3e-3);
            close("p_max", increment.p_max / truth.p(0.0), 1.0, 3e-3);
            close(
                "delta_z",
                increment.motion.delta_z / truth.delta_z,
                1.0,
                3e-3,
            );
        });
    }
}

/// Under a thin hard coating the pressure changes over its thickness at the rim: where the cells do
/// not resolve that, the radius is that of whole cells.
#[test]
fn the_radius_on_a_thin_hard_coating_is_no_worse_than_that_of_whole_cells() {
    for (ratio, h) in [(4.0, 0.05), (4.0, 0.02), (2.0, 0.05), (3.0, 0.1)] {
        for n in [64, 101, 128, 256] {
            let (scene, truth) = row(ratio, h, n);
            run(&scene, |_, increment| {
                let off = increment.contact_radius / truth.a - 1.0;
                let cell = scene.grid.dx / truth.a;
                assert!(off.abs() < WHOLE_CELLS * cell, "{off} of {cell}");
            });
        }
    }
}

#[test]
fn the_grid_converges_to_the_integral_equation() {
    let bare = hertz(R, Elastic::RIGID, STEEL, W);
    let layer = Coating {
        material: Elastic {
            E: 4.0 * STEEL.E,
            nu: 0.3,
        },
        thickness: 0.5 * bare.a,
    };
    let truth = coated_indentation(R, Elastic::RIGID, layer, STEEL, W).unwrap();
    let error = |n: usize| {
        let path = LoadPath::start().normal(W, 1);
        let scene = sphere_on_flat(Elastic::RIGID, STEEL, 0.0, (2.0, n), path);
        let mut scene = coated(scene, layer.material, layer.thickness);
        scene.settings.solver.tolerance = Some(1e-8);
        run(&scene, |_, _| {})[0].motion.delta_z / truth.delta_z - 1.0
    };
    let (coarse, fine) = (error(32), error(128));
    // Second order: sixteen times less with a quarter of the cell.
    assert!(fine.abs() < coarse.abs() / 8.0, "{coarse:e} {fine:e}");
}

#[test]
fn another_program_in_extended_precision_finds_the_same_contact() {
    let data: Value =
        serde_json::from_str(include_str!("../data/axisym_indentation.json")).expect("JSON");
    let material = |value: &Value| {
        if value == "rigid" {
            return Elastic::RIGID;
        }
        Elastic {
            E: value["E"].as_f64().expect("E"),
            nu: value["nu"].as_f64().expect("nu"),
        }
    };
    for entry in data["entries"].as_array().expect("entries") {
        let number = |key: &str| entry[key].as_f64().expect(key);
        let (a, load) = (number("a"), number("load_W"));
        let layer = &entry["layers"][0];
        let coating = Coating {
            material: material(layer),
            thickness: layer["h"].as_f64().expect("h"),
        };
        let (indenter, substrate) = (material(&entry["indenter"]), material(&entry["substrate"]));
        let path = LoadPath::start().normal(load, 1);
        let mut scene = sphere_on_flat(indenter, substrate, 0.0, (1.0, 96), path);
        scene.body1 = Body::homogeneous(indenter, Shape::Sphere { R: number("R") });
        scene.body2.coatings = vec![coating];
        scene.grid = Grid::centred(2.3 * a, 96).expect("a grid");
        let truth = CoatedIndentation::of_radius(number("R"), indenter, coating, substrate, a);
        compare(&scene, &truth);
    }
}

/// A layer a thousand times thinner than the contact, on a rigid base: p = (M/h)(delta_z - r^2/(2
/// R)), W = pi M a^4/(4 h R), M = 2 G (1 - nu)/(1 - 2 nu) (K. L. Johnson, Contact Mechanics, sec.
/// 5.8). The pressure ends like the distance from the rim, and the rim is known within its cell.
#[test]
fn a_layer_thinner_than_the_cells() {
    let layer = Elastic { E: 1e9, nu: 0.3 };
    let (h, a): (f64, f64) = (2e-6, 2e-3);
    let M = 2.0 * layer.G() * (1.0 - layer.nu) / (1.0 - 2.0 * layer.nu);
    let force = std::f64::consts::PI * M * a.powi(4) / (4.0 * h * R);
    for n in [48, 64, 90] {
        let path = LoadPath::start().normal(force, 1);
        let mut scene = sphere_on_flat(Elastic::RIGID, STEEL, 0.0, (2.4, n), path);
        scene.body2 = Body::homogeneous(Elastic::RIGID, Shape::Flat);
        scene = coated(scene, layer, h);
        scene.grid = Grid::centred(2.4 * a, n).expect("a grid");
        let increment = run(&scene, |_, _| {}).remove(0);
        let d = scene.grid.dx / a;
        close("a", increment.contact_radius / a, 1.0, RIM * d);
        // Even numbers of cells have none in the middle.
        let highest = M * a * a / (2.0 * R * h) * (1.0 - 0.5 * d * d);
        close("p_max", increment.p_max / highest, 1.0, 1e-4);
        close(
            "delta_z",
            increment.motion.delta_z * 2.0 * R / (a * a),
            1.0,
            1e-3,
        );
    }
}
