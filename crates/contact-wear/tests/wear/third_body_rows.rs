//! Rigid bodies with oxygen, debris and layers: the closed forms of crates/debris/tests/data/rows.json.

use std::sync::Arc;

use contact_core::scene::{
    BedFriction, Body, Coating, Elastic, Friction, Grid, Missing, Scene, Shape, SurfaceMap,
};
use contact_wear::{
    Air, BodyWear, Cycling, DebrisBed, DissipatedEnergy, Jump, Jumps, Law, Reaction, Wear, WearRun,
    WornThrough,
};
use ndarray::Array2;
use serde_json::Value;

use crate::bench::{cylinder, run, scene, to_and_fro, wear};
use crate::third_body::{assert_mass, in_air, number, row};

fn numbers(row: &Value, part: &str, key: &str) -> Vec<f64> {
    let list = row[part][key].as_array().unwrap();
    list.iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Bodies that hardly deform.
fn stiffen(scene: &mut Scene, E: f64) {
    let body = Elastic { E, nu: 0.3 };
    scene.body1.substrate = body;
    scene.body2.substrate = body;
}

/// Wears with alpha of the pair, half of it off each body.
fn pair(alpha: f64) -> [BodyWear; 2] {
    let law = || {
        BodyWear::with_law(DissipatedEnergy {
            alpha: 0.5 * alpha,
            threshold: 0.0,
        })
    };
    [law(), law()]
}

fn assert_near(name: &str, value: f64, exact: f64, within: f64) {
    println!(
        "{name}: {value:.6e}, {exact:.6e}, {:+.2e}",
        value / exact - 1.0
    );
    assert!(
        (value / exact - 1.0).abs() <= within,
        "{name}: {value}, {exact}"
    );
}

#[test]
fn a_rigid_cylinder_keeps_the_debris_of_the_closed_form() {
    let row = row("cylinder_rigid");
    let (R, area) = (
        number(&row, "input", "R"),
        number(&row, "input", "worn_area_per_cycle"),
    );
    let (W, stroke, mu) = (1e5, 2e-6, 0.5);
    let alpha = area / (4.0 * mu * W * stroke);
    let cycles = numbers(&row, "input", "cycles");
    for (n, N) in cycles.into_iter().enumerate() {
        let at = |key: &str| numbers(&row, "output", key)[n];
        let grid = Grid::strip(2.4 * at("half_width"), 200, 1.0).unwrap();
        let mut scene = scene(cylinder(R), grid, to_and_fro(W, stroke, 1), mu);
        stiffen(&mut scene, 1e14);
        let mut wear = wear(pair(alpha), N, Cycling::Sliding);
        wear.bed = Some(DebrisBed::new(
            number(&row, "input", "transport") / (stroke * stroke),
        ));
        wear.jumps = Jumps::Tolerance(2e-3);
        let (run, jumps) = run(&scene, &wear);
        assert_mass(&jumps);
        let (block, last) = (run.block(), jumps.last().unwrap());
        let open = &block.worn1 + &block.worn2 - &block.bed;
        let middle = |field: &Array2<f64>| 0.5 * (field[(99, 0)] + field[(100, 0)]);
        let half_width = (2.0 * R * middle(&open)).sqrt();
        println!("{N} cycles, {} jumps", jumps.len());
        assert_near("half-width", half_width, at("half_width"), 5e-3);
        assert_near(
            "kept",
            last.debris / (last.volume[0] + last.volume[1]),
            at("kept"),
            5e-3,
        );
        let both = middle(&(&block.worn1 + &block.worn2));
        assert_near("depth", both, at("depth_both"), 5e-3);
    }
}

#[test]
fn a_rigid_ball_keeps_the_debris_of_the_closed_form() {
    let row = row("ball_rigid");
    let R = number(&row, "input", "R");
    let (W, stroke, mu) = (10.0, 2e-6, 0.5);
    let alpha = number(&row, "input", "worn_volume_per_cycle") / (4.0 * mu * W * stroke);
    for (n, N) in numbers(&row, "input", "cycles").into_iter().enumerate() {
        let at = |key: &str| numbers(&row, "output", key)[n];
        let grid = Grid::centred(2.4 * at("radius"), 96).unwrap();
        let mut scene = scene(Shape::Sphere { R }, grid, to_and_fro(W, stroke, 1), mu);
        stiffen(&mut scene, 1e14);
        let mut wear = wear(pair(alpha), N, Cycling::Sliding);
        wear.bed = Some(DebrisBed::new(
            number(&row, "input", "transport") / (stroke * stroke),
        ));
        wear.jumps = Jumps::Tolerance(4e-3);
        let (run, jumps) = run(&scene, &wear);
        assert_mass(&jumps);
        let (block, last) = (run.block(), jumps.last().unwrap());
        let open = &block.worn1 + &block.worn2 - &block.bed;
        let middle = 0.25 * (open[(47, 47)] + open[(48, 47)] + open[(47, 48)] + open[(48, 48)]);
        println!("{N} cycles, {} jumps", jumps.len());
        let half = 0.5 * grid_offset(&scene.grid);
        assert_near(
            "radius",
            (2.0 * R * middle + half).sqrt(),
            at("radius"),
            5e-3,
        );
        assert_near(
            "kept",
            last.debris / (last.volume[0] + last.volume[1]),
            at("kept"),
            5e-3,
        );
    }
}

/// Square of the distance of the four middle cells from the middle, twice \[m^2\].
fn grid_offset(grid: &Grid) -> f64 {
    grid.dx * grid.dx
}

/// A pad with the air of a row on a flat, on cells within `inside`.
fn pad(row: &Value, grid: Grid, inside: impl Fn(f64, f64) -> bool) -> (Scene, Wear) {
    let get = |key: &str| number(row, "input", key);
    let (stroke, mu) = (2e-6, 0.5);
    // A map has two lines at least.
    let lines = grid.ny.max(2);
    let heights = Array2::from_shape_fn((grid.nx, lines), |(i, j)| {
        let y = if grid.ny == 1 { 0.0 } else { grid.y(j) };
        if inside(grid.x(i), y) { 0.0 } else { -1e-3 }
    });
    let map = SurfaceMap::new(heights, (grid.dx, grid.dy), Missing::default()).unwrap();
    let path = to_and_fro(get("W"), stroke, 1);
    let times = get("Eperp") / (4.0 * mu * stroke);
    let mut scene = scene(Shape::HeightMap(map), grid, path, mu);
    stiffen(&mut scene, 1e13);
    let law = in_air(times * get("aab"), times * get("aad"));
    let mut wear = wear([law, BodyWear::default()], 3000.0, Cycling::Sliding);
    wear.frequency = Some(get("f") * times);
    wear.air = Some(Air {
        distance: get("lref") / Air::decay_length(Air::AMBIENT, Air::THRESHOLD),
        reaction: Reaction::Power {
            power_density: get("phiref"),
            power_exponent: get("m"),
        },
        threshold: Air::THRESHOLD,
        ambient: Air::AMBIENT,
    });
    (scene, wear)
}

/// Compares the core and the rate of a pad that recedes evenly.
fn assert_pad(row: &Value, (run, jumps): (WearRun, Vec<Jump>), core: impl Fn(f64, &Grid) -> f64) {
    let last = jumps.last().unwrap();
    let grid = run.scene().grid.clone();
    let block = run.block();
    let inside = block.p.mapv(|p| f64::from(u8::from(p > 0.0)));
    let starved = (1.0 - &block.aerated) * inside;
    let size = core(starved.sum() * grid.cell_area(), &grid);
    let before = &jumps[jumps.len() - 2];
    let area = inside_area(&block.p) * grid.cell_area();
    let rate = (last.volume[0] - before.volume[0]) / (last.cycles - before.cycles) / area;
    println!("{} jumps", jumps.len());
    assert_near("core", size, number(row, "output", "core"), 5e-3);
    assert_near("recession", rate, number(row, "output", "recession"), 5e-3);
}

fn inside_area(p: &Array2<f64>) -> f64 {
    p.iter().filter(|p| **p > 0.0).count() as f64
}

#[test]
fn a_worn_strip_recedes_evenly_with_its_core() {
    let row = row("strip_pad");
    let b = number(&row, "input", "b");
    let (scene, wear) = pad(&row, Grid::strip(2.4 * b, 240, 1.0).unwrap(), |x, _| {
        x.abs() < b
    });
    // Half the width of the core, of a strip of one metre.
    assert_pad(&row, run(&scene, &wear), |area, grid| 0.5 * area / grid.dy);
}

#[test]
fn a_worn_disc_recedes_evenly_with_its_core() {
    let row = row("disc_pad");
    let b = number(&row, "input", "b");
    let grid = Grid::centred(2.2 * b, 128).unwrap();
    let (scene, wear) = pad(&row, grid, |x, y| x.hypot(y) < b);
    assert_pad(&row, run(&scene, &wear), |area, _| {
        (area / std::f64::consts::PI).sqrt()
    });
}

/// A rigid cylinder on a flat with a coating of other friction.
fn coated(cells: usize, width: f64) -> (Scene, Wear) {
    let row = row("worn_through_slippery");
    let get = |key: &str| number(&row, "input", key);
    let grid = Grid::strip(width, cells, 1.0).unwrap();
    let path = to_and_fro(get("W"), get("delta"), 1);
    let mut scene = scene(cylinder(get("R")), grid, path, get("muc"));
    stiffen(&mut scene, 1e13);
    let film = Coating::new(scene.body2.substrate, get("t")).unwrap();
    scene.body2 = Body {
        coatings: vec![film],
        ..scene.body2
    };
    scene.friction = Friction {
        layers: vec![get("muc"), get("mus")],
        ..Friction::coulomb(get("muc"))
    };
    let law = |alpha| -> Arc<dyn Law> {
        Arc::new(DissipatedEnergy {
            alpha,
            threshold: 0.0,
        })
    };
    let laws = BodyWear {
        laws: vec![law(get("ac")), law(get("as_"))],
        share: None,
    };
    let last = *numbers(&row, "output", "cycles").last().unwrap();
    let mut wear = wear([BodyWear::default(), laws], 1.05 * last, Cycling::Sliding);
    wear.worn_through = WornThrough::GoOn;
    wear.jumps = Jumps::Tolerance(2e-3);
    (scene, wear)
}

#[test]
fn a_film_that_is_worn_through_changes_the_friction() {
    let row = row("worn_through_slippery");
    let (scene, wear) = coated(320, 2.4e-3);
    let (run, jumps) = run(&scene, &wear);
    println!("{} jumps", jumps.len());
    let through = &run.state().events;
    let first = through
        .iter()
        .find(|e| e.kind == contact_wear::EventKind::WornThrough);
    assert_near(
        "worn through",
        first.unwrap().cycles,
        number(&row, "output", "worn_through_at"),
        5e-3,
    );
    let R = number(&row, "input", "R");
    let cycles_to = |depth: f64| {
        let n = jumps
            .iter()
            .position(|jump| jump.depth[1] >= depth)
            .unwrap();
        let (from, to) = (&jumps[n - 1], &jumps[n]);
        let part = (depth - from.depth[1]) / (to.depth[1] - from.depth[1]);
        from.cycles + part * to.length
    };
    // The mean coefficient of a jump belongs to its middle.
    let mu_at = |cycles: f64| {
        let middle = |jump: &Jump| jump.cycles - 0.5 * jump.length;
        let n = jumps
            .iter()
            .position(|jump| middle(jump) >= cycles)
            .unwrap();
        let (from, to) = (&jumps[n - 1], &jumps[n]);
        let part = (cycles - middle(from)) / (middle(to) - middle(from));
        from.mu + part * (to.mu - from.mu)
    };
    for (n, b) in numbers(&row, "input", "half_width").into_iter().enumerate() {
        let cycles = cycles_to(b * b / (2.0 * R));
        let mu = mu_at(numbers(&row, "output", "cycles")[n]);
        println!("half-width {b}");
        assert_near("cycles", cycles, numbers(&row, "output", "cycles")[n], 5e-3);
        assert_near("mu", mu, numbers(&row, "output", "mu_of_contact")[n], 5e-3);
    }
}

/// Friction of the layer, of the oxygen and of the bed, in one scene.
fn friction_of_all(cycling: Cycling) -> (Scene, Wear) {
    let (mut scene, mut wear) = coated(64, 1.2e-3);
    let elastic = Elastic { E: 2e11, nu: 0.3 };
    stiffen(&mut scene, elastic.E);
    scene.body2.coatings[0].material = elastic;
    scene.friction.starved = Some(0.9);
    scene.friction.bed = Some(BedFriction {
        mu: 0.4,
        thickness: 1e-6,
    });
    if cycling == Cycling::March {
        scene.path = to_and_fro(1e5, 5e-6, 4);
    }
    let alphas = [[1e-15; 2], [2e-14, 5e-15]];
    let laws = alphas.map(|[alpha, starved]| in_air(alpha, starved).laws.remove(0));
    wear.bodies[1].laws = laws.to_vec();
    wear.cycling = cycling;
    wear.cycles = if cycling == Cycling::March { 2e6 } else { 4e5 };
    wear.frequency = Some(20.0);
    wear.bed = Some(DebrisBed::new(1e-3));
    wear.air = Some(Air {
        distance: 1e-4,
        reaction: Reaction::Power {
            power_density: 1e5,
            power_exponent: 0.5,
        },
        threshold: Air::THRESHOLD,
        ambient: Air::AMBIENT,
    });
    wear.jumps = Jumps::Number(8);
    (scene, wear)
}

#[test]
fn friction_of_the_surface_goes_on_with_the_same_bits() {
    for cycling in [Cycling::Sliding, Cycling::March] {
        let (scene, wear) = friction_of_all(cycling);
        let (whole, jumps) = run(&scene, &wear);
        assert_mass(&jumps);
        let mu: Vec<f64> = jumps.iter().map(|jump| jump.mu).collect();
        println!(
            "{cycling:?}: mu {mu:?}, aerated {}",
            jumps.last().unwrap().aerated_share
        );
        assert!(mu.iter().all(|mu| (0.1..=0.95).contains(mu)));
        assert!(mu.iter().any(|value| (value - mu[0]).abs() > 0.02));
        // The energy of the cells is the energy of the contact.
        let block = whole.block();
        let area = scene.grid.cell_area();
        let last = jumps.last().unwrap().dissipated;
        for energy in [&block.energy1, &block.energy2] {
            assert!((energy.sum() * area / last - 1.0).abs() < 1e-9);
        }
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
}

#[test]
fn march_and_sliding_agree_on_the_friction_of_a_worn_film() {
    let results = [Cycling::Sliding, Cycling::March].map(|cycling| {
        let (mut scene, mut wear) = coated(96, 0.9e-3);
        let elastic = Elastic { E: 2e11, nu: 0.3 };
        stiffen(&mut scene, elastic.E);
        scene.body2.coatings[0].material = elastic;
        // Beyond the elastic shift, small against the contact.
        scene.path = to_and_fro(1e5, 2e-5, 8);
        wear.cycling = cycling;
        wear.cycles = 8e5;
        wear.jumps = Jumps::Tolerance(0.02);
        if cycling == Cycling::Sliding {
            scene.path = to_and_fro(1e5, 2e-5, 1);
        }
        let (_, jumps) = run(&scene, &wear);
        let last = jumps.last().unwrap();
        (last.mu, last.depth[1])
    });
    println!("{results:?}");
    let [(mu, depth), (marched_mu, marched_depth)] = results;
    assert!(mu > 0.16);
    assert!((marched_mu / mu - 1.0).abs() < 0.05, "{marched_mu}, {mu}");
    // A march loses the elastic shift of its slip.
    assert!(
        (marched_depth / depth - 1.0).abs() < 0.1,
        "{marched_depth}, {depth}"
    );
}
