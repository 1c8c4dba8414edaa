//! Oxygen and debris in runs of wear, against closed forms and an independent dense code: the rows of
//! crates/debris/tests/data/rows.json.

use std::sync::Arc;

use contact_core::scene::{Body, Elastic, Grid, Scene, Shape};
use contact_wear::{
    Aerated, Air, BodyWear, Cycling, DebrisBed, DissipatedEnergy, Jump, Jumps, Law, Reaction, Wear,
    WearRun,
};
use serde_json::Value;

use crate::bench::{cylinder, run, scene, to_and_fro, wear};

fn row(name: &str) -> Value {
    let text = include_str!("../../../debris/tests/data/rows.json");
    let rows: Value = serde_json::from_str(text).unwrap();
    rows[name].clone()
}

fn number(row: &Value, part: &str, key: &str) -> f64 {
    row[part][key].as_f64().unwrap_or_else(|| panic!("{key}"))
}

/// Worn volume is bed and ejected debris together, at the end of every jump.
fn assert_mass(jumps: &[Jump]) {
    for jump in jumps {
        let worn = jump.volume[0] + jump.volume[1];
        let off = (jump.debris + jump.ejected - worn).abs();
        assert!(
            off <= 1e-9 * worn,
            "jump {}: {off:e} of {worn:e}",
            jump.index
        );
    }
}

/// Energy wear with and without oxygen.
fn in_air(alpha: f64, starved: f64) -> BodyWear {
    let law = |alpha| {
        Arc::new(DissipatedEnergy {
            alpha,
            threshold: 0.0,
        })
    };
    BodyWear {
        laws: vec![Arc::new(Aerated {
            law: law(alpha),
            starved_law: law(starved),
            coefficients: [alpha, starved],
        }) as Arc<dyn Law>],
        share: None,
    }
}

/// The cylinder of a row on a flat, with strokes that are short beside a cell. Energy, frequency and
/// transport keep the values of the row.
fn elastic(row: &Value, cells: usize) -> (Scene, Wear) {
    let get = |key: &str| number(row, "input", key);
    let (W, stroke, mu) = (get("W_per_m"), 2e-6, 0.65);
    let times = get("energy_per_metre_and_cycle") / (4.0 * mu * W * stroke);
    let grid = Grid::strip(2.6 * number(row, "output", "b"), cells, 1.0).unwrap();
    let mut scene = scene(cylinder(get("R")), grid, to_and_fro(W, stroke, 1), mu);
    let nu: f64 = 0.3;
    let body = Elastic {
        E: 2.0 * get("E_star") * (1.0 - nu * nu),
        nu,
    };
    scene.body1 = Body::homogeneous(body, cylinder(get("R")));
    scene.body2 = Body::homogeneous(body, Shape::Flat);
    let half = |alpha: f64| 0.5 * times * alpha;
    let law = || in_air(half(get("alpha_aerated")), half(get("alpha_starved")));
    let mut wear = wear([law(), law()], get("cycles"), Cycling::Sliding);
    let mut bed = DebrisBed::new(get("transport") / (stroke * stroke));
    let air = &row["input"]["air"];
    if !air.is_null() {
        let get = |key: &str| air[key].as_f64().unwrap();
        let threshold = 0.1;
        let ambient = threshold / get("th");
        wear.air = Some(Air {
            distance: get("lam") * (2.0 / get("th")).ln(),
            reaction: Reaction::Power {
                power_density: get("phi"),
                power_exponent: get("m"),
            },
            threshold,
            ambient,
        });
        wear.frequency = Some(times * number(row, "input", "frequency"));
        bed.starved_yield = get("es");
    }
    wear.bed = Some(bed);
    wear.closed_below = number(row, "input", "closed_below_gap");
    (scene, wear)
}

#[test]
fn elastic_cylinders_wear_as_in_a_dense_code() {
    for name in ["titanium_bed", "titanium_air_2Hz", "steel_air_20Hz"] {
        let row = row(name);
        let (scene, mut wear) = elastic(&row, 240);
        wear.jumps = Jumps::Tolerance(5e-3);
        let (run, jumps) = run(&scene, &wear);
        assert_mass(&jumps);
        let last = jumps.last().unwrap();
        let block = run.block();
        let worn = &block.worn1 + &block.worn2;
        let middle = scene.grid.nx / 2;
        let w0 = 0.5 * (worn[(middle, 0)] + worn[(middle - 1, 0)]);
        let w_max = worn.iter().fold(0.0, |m: f64, w| m.max(*w));
        let starved: f64 = block.aerated.iter().map(|s| 1.0 - s).sum();
        let V = last.volume[0] + last.volume[1];
        let values = [
            ("w0", w0, 0.01),
            ("w_max", w_max, 0.01),
            ("V", V, 0.01),
            ("core", 0.5 * scene.grid.dx * starved, 0.03),
        ];
        println!("{name}: {} jumps, p_max {:.4e}", jumps.len(), last.p_max);
        for (key, value, within) in values {
            let (exact, error) = (number(&row, "output", key), number(&row, "error", key));
            println!("  {key} {value:.5e}, {exact:.5e}");
            assert!(
                (value - exact).abs() <= within * exact + error,
                "{name} {key}: {value}, {exact}"
            );
        }
    }
}

#[test]
fn a_state_goes_on_with_the_same_bits() {
    let (scene, mut wear) = elastic(&row("titanium_air_2Hz"), 96);
    wear.jumps = Jumps::Number(6);
    let (whole, _) = run(&scene, &wear);
    let mut first = WearRun::new(&scene, &wear, &Arc::default()).unwrap();
    for _ in 0..3 {
        first.advance().unwrap().unwrap();
    }
    let bytes = postcard::to_allocvec(first.state()).unwrap();
    let state = postcard::from_bytes(&bytes).unwrap();
    let mut second = WearRun::resume(&scene, &wear, state, &Arc::default()).unwrap();
    while let Some(jump) = second.advance() {
        jump.unwrap();
    }
    assert!(second.state() == whole.state() && second.block() == whole.block());
}
