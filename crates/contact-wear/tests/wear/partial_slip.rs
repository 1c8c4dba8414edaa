//! Partial slip worn until nothing changes any more: the contact has shrunk to the stick zone (V.
//! L. Popov, Sci. Rep. 4 (2014) 3749). W and the amplitude of T are constant, the bodies alike with
//! nu = 0.
//!
//! `FRET_WEAR_CELLS=256` takes so many cells along a side under the sphere and both amplitudes
//! (`make wear`).

use std::f64::consts::PI;

use contact_core::scene::{Elastic, Grid, Scene, Shape};
use contact_wear::{Block, Cycling, Jumps};

use crate::audit::Audit;
use crate::bench::{archard, cylinder, pulled, run, scene, wear};

const MU: f64 = 0.6;
const R: f64 = 10e-3;

/// What is compared, in a (length), p0, a^2/R (depth) and a^4/R (volume; a^3/R per length).
struct Row {
    c: f64,
    p: f64,
    d: Option<f64>,
    volume: f64,
    largest: f64,
}

fn alike(shape: Shape, W: f64, T: f64, grid: impl Fn(f64) -> Grid) -> Scene {
    let mut scene = scene(shape, grid(1e-3), pulled(W, T, 6), MU);
    let elastic = Elastic { E: 200e9, nu: 0.0 };
    (scene.body1.substrate, scene.body2.substrate) = (elastic, elastic);
    scene.grid = grid(scene.hertz().unwrap().a);
    scene
}

/// Wears until nothing changes and compares; volume and largest depth within parts `bounds`.
fn assert_worn(name: &str, scene: &Scene, tolerance: f64, row: &Row, bounds: (f64, f64)) {
    let hertz = scene.hertz().unwrap();
    let grid = &scene.grid;
    let mut wear = wear([archard(5e-14), archard(5e-14)], 1e6, Cycling::March);
    wear.jumps = Jumps::Tolerance(tolerance);
    let (run, jumps) = run(scene, &wear);
    let block: Block = run.block();
    let worn = &block.worn1 + &block.worn2;
    let (a, cell) = (hertz.a, grid.cell_area());
    let deep = a * a / R;
    let in_stick = block.stick.iter().filter(|s| **s).count() as f64 * cell;
    let (c, large) = if grid.plane_strain {
        (0.5 * in_stick / grid.dy / a, deep * a * grid.dy)
    } else {
        ((in_stick / PI).sqrt() / a, deep * a * a)
    };
    let found = Row {
        c,
        p: block.p[(grid.nx / 2, grid.ny / 2)] / hertz.p0,
        d: row
            .d
            .map(|_| Audit::new(name, scene, &wear, None).approach(&block) / deep),
        volume: worn.sum() * cell / large,
        largest: worn.iter().fold(0.0, |m: f64, w| m.max(*w)) / deep,
    };
    println!("{name}: {} jumps, work {:?}", jumps.len(), run.work());
    let compare = |what: &str, found: f64, asked: f64, bound: f64| {
        let off = found / asked - 1.0;
        println!(
            "  {what} {found:.5}, closed form {asked:.5}: {:+.2} %",
            100.0 * off
        );
        assert!(
            off.abs() < bound,
            "{name}: {what} off by {off}, allowed {bound}"
        );
    };
    compare("stick radius", found.c, row.c, grid.dx / a / row.c);
    compare("p(0)", found.p, row.p, 0.01);
    if let (Some(found), Some(asked)) = (found.d, row.d) {
        compare("approach", found, asked, 0.01);
    }
    compare("volume", found.volume, row.volume, bounds.0);
    compare("largest depth", found.largest, row.largest, bounds.1);
    // The border may run through the outermost cells that stick.
    let inside = |(i, j): (usize, usize)| {
        let sticks = |i: usize| block.stick[(i, j)];
        sticks(i) && (!grid.plane_strain || sticks(i - 1) && sticks(i + 1))
    };
    let stick = worn.indexed_iter().filter(|(at, _)| inside(*at));
    assert!(stick.fold(0.0, |m: f64, (_, w)| m.max(*w)) < 1e-9 * worn.sum());
}

#[test]
fn a_sphere_wears_until_it_rests_on_its_stick_zone() {
    let cells = std::env::var("FRET_WEAR_CELLS").map(|n| n.parse().unwrap());
    let row = |q: f64, d, volume, largest| {
        let c = (1.0 - q).cbrt();
        let p = 2.0 * c / 3.0 + 1.0 / (3.0 * c * c);
        (
            q,
            Row {
                c,
                p,
                d: Some(d),
                volume,
                largest,
            },
        )
    };
    let rows = [
        row(0.5, 1.049_934, 0.132_158, 0.094_485),
        row(0.7, 1.145_248, 0.517_739, 0.219_995),
    ];
    let wanted = if cells.is_ok() { rows.len() } else { 1 };
    for (q, row) in &rows[..wanted] {
        let (W, n) = (50.0, *cells.as_ref().unwrap_or(&96));
        let grid = |a: f64| Grid::centred(2.8 * a, n).unwrap();
        let scene = alike(Shape::Sphere { R }, W, q * MU * W, grid);
        // The border of the stick zone lies within an eighth of a cell of where it should: by the
        // closed form, what it is off in parts of a moves volume and depth by 6.4 and 10.6 times
        // that.
        let rim = 0.125 * 2.8 / n as f64;
        let bounds = if n < 256 {
            (6.4 * rim, 10.6 * rim)
        } else {
            (0.01, 0.02)
        };
        let name = format!("sphere, T = {q} mu W, {n}^2 cells");
        assert_worn(&name, &scene, 0.03, row, bounds);
    }
}

/// Under a pressure p0 (c^2 - x^2)^(1/2)/a and that of a flat punch of the width 2c that carries
/// the rest of W, the gap of the unworn surfaces outside would be, its slope being ((x^2 -
/// c^2)^(1/2) - (a^2 - c^2)/2/(x^2 - c^2)^(1/2))/R,
///
/// ```text
/// g = [x (x^2 - c^2)^(1/2) - a^2 arcosh(x/c)]/(2 R) = -w < 0   for c < x < b.
/// ```
///
/// The worn depth is largest at x^2 = (a^2 + c^2)/2, and the area (b^2 - c^2)^(1/2) [b^2 - a^2 -
/// (b^2 - c^2)/3]/R.
fn line(q: f64) -> Row {
    let c = (1.0 - q).sqrt();
    let w = |x: f64| 0.5 * ((x / c).acosh() - x * (x * x - c * c).sqrt());
    let (mut low, mut high) = (1.0, 3.0);
    for _ in 0..60 {
        let b = 0.5 * (low + high);
        (low, high) = if w(b) > 0.0 { (b, high) } else { (low, b) };
    }
    let rest = low * low - c * c;
    Row {
        c,
        p: 0.5 * (1.0 / c + c),
        d: None,
        volume: rest.sqrt() * (low * low - 1.0 - rest / 3.0),
        largest: w((0.5 * (1.0 + c * c)).sqrt()),
    }
}

/// Wherever the border of the stick zone lies in its cell, 256 cells do: the cell that it runs
/// through wears in part.
#[test]
fn a_cylinder_wears_until_it_rests_on_its_stick_zone() {
    let everywhere = (0..10).map(|k| (0.5, 256, 56.0 + 0.1 * f64::from(k)));
    let others = [
        (0.3, 256, 72.6),
        (0.7, 256, 44.4),
        (0.7, 256, 44.7),
        (0.7, 2048, 360.3),
    ];
    for (q, n, cells) in everywhere.chain(others) {
        let (W, c) = (2e5, f64::sqrt(1.0 - q));
        let grid = |a: f64| Grid::strip(n as f64 * c / cells * a, n, 1.0).unwrap();
        let scene = alike(cylinder(R), W, q * MU * W, grid);
        let name = format!("cylinder, T = {q} mu W, {cells} cells in c");
        assert_worn(&name, &scene, 0.01, &line(q), (0.01, 0.02));
    }
}
