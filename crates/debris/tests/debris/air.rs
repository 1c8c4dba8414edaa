//! Oxygen in strips, discs, squares, rings and ellipses.

use debris::{Lattice, Region, aerated_share, diffuse_air};

use crate::rows::{Half, Row, Strip, near, row};

/// Cells per lambda.
const CELLS: f64 = 20.0;

fn even(cells: f64) -> usize {
    2 * (0.5 * cells).round() as usize
}

/// Half-width of the core of a strip of `cells` per lambda, by the share of each cell.
fn core_of_strip(strip: &Row, cells: f64) -> (f64, f64) {
    let (b, lambda, threshold) = (
        strip.input("half_width"),
        strip.input("lam"),
        strip.input("threshold"),
    );
    let line = Strip::new(b, even(2.0 * b / lambda * cells));
    let region = Region::from_mask(line.lattice, &line.map(|x| x.abs() < b));
    let squares = line.map(|_| lambda * lambda);
    let P = diffuse_air(&region, &squares, threshold, None).unwrap();
    let share = aerated_share(&region, &P, threshold);
    let core = 0.5 * line.lattice.dx * share.iter().map(|s| 1.0 - s).sum::<f64>();
    (core, line.log_at(&P, 0.5 * b))
}

#[test]
fn air_of_a_strip() {
    let strip = row("strip_aerated");
    let (core, half) = core_of_strip(&strip, CELLS);
    assert_eq!(core, strip.output("core_half_width"));
    near(half, strip.output("P_half"), 0.01, "P_half");
    let strip = row("strip_core");
    let (b, core) = (strip.input("half_width"), strip.output("core_half_width"));
    // The scheme is fitted to the wave: exact on cells as large as lambda and larger.
    for cells in [0.4, 1.0, 3.0, CELLS] {
        let (found, half) = core_of_strip(&strip, cells);
        near(b - found, b - core, 1e-6, "oxygen distance");
        // Half of the strip lies between two centres.
        if cells == CELLS {
            near(half, strip.output("P_half"), 1e-6, "P_half");
        }
    }
}

#[test]
fn air_of_a_border_that_cuts_cells() {
    // The strip ends anywhere within a cell.
    let strip = row("strip_core");
    let (b, lambda, threshold) = (0.002, strip.input("lam"), strip.input("threshold"));
    for part in [0.03, 0.2, 0.5, 0.77, 0.98] {
        let line = Strip::new(b * (1.0 + part / 400.0), 400);
        let region = Region::from_levels(line.lattice, &line.map(|x| b - x.abs()));
        let squares = line.map(|_| lambda * lambda);
        let P = diffuse_air(&region, &squares, threshold, None).unwrap();
        let share = aerated_share(&region, &P, threshold);
        let core = 0.5 * line.lattice.dx * share.iter().map(|s| 1.0 - s).sum::<f64>();
        near(
            b - core,
            b - strip.output("core_half_width"),
            1e-3,
            "distance",
        );
    }
}

#[test]
fn air_of_discs_squares_and_ellipses() {
    let disc = row("disc_core");
    let (a, lambda, threshold) = (
        disc.input("radius"),
        disc.input("lam"),
        disc.input("threshold"),
    );
    let half = Half::new(a, even(2.0 * a / lambda * CELLS));
    let level = half.map(|x, y| a - x.hypot(y));
    let region = Region::from_levels(half.lattice, &level);
    let squares = half.map(|_, _| lambda * lambda);
    let P = diffuse_air(&region, &squares, threshold, None).unwrap();
    near(
        half.log_at(&P, 0.5 * a, 0.0),
        disc.output("P_half"),
        0.01,
        "disc",
    );
    let starved: Vec<f64> = aerated_share(&region, &P, threshold)
        .iter()
        .map(|s| 1.0 - s)
        .collect();
    let core = (half.sum(&starved) / std::f64::consts::PI).sqrt();
    near(a - core, a - disc.output("core_radius"), 1e-3, "disc");

    let square = row("square");
    let (a, lambda, threshold) = (
        square.input("half_x"),
        square.input("lam"),
        square.input("threshold"),
    );
    let half = Half::new(a, even(2.0 * a / lambda * CELLS));
    let region = Region::from_mask(half.lattice, &half.map(|x, y| x.abs() < a && y < a));
    let squares = half.map(|_, _| lambda * lambda);
    let P = diffuse_air(&region, &squares, threshold, None).unwrap();
    for [x, y, exact] in square.points("P_at") {
        near(half.log_at(&P, x, y), exact, 0.01, "square");
    }
    let share = aerated_share(&region, &P, threshold);
    let (rows, columns) = (half.lattice.rows, half.lattice.columns);
    let along = (0..columns).map(|i| 1.0 - share[i * rows]).sum::<f64>();
    let core = 0.5 * half.lattice.dx * along;
    near(a - core, a - square.output("core_half_x"), 1e-3, "square");
    let starved = half.sum(&share.iter().map(|s| 1.0 - s).collect::<Vec<f64>>());
    let aerated = 1.0 - starved / (4.0 * a * a);
    near(aerated, square.output("aerated_share"), 1e-3, "square");

    let ellipse = row("ellipse");
    let (a, b, lambda) = (
        ellipse.input("half_x"),
        ellipse.input("half_y"),
        ellipse.input("lam"),
    );
    let half = Half::new(a, even(2.0 * a / lambda * CELLS));
    let level = half.map(|x, y| 1.0 - (x / a).hypot(y / b));
    let region = Region::from_levels(half.lattice, &level);
    let squares = half.map(|_, _| lambda * lambda);
    let P = diffuse_air(&region, &squares, 1e-3, None).unwrap();
    for [x, y, exact] in ellipse.points("P_at") {
        near(half.log_at(&P, x, y), exact, 0.01, "ellipse");
    }
}

#[test]
fn a_groove_lets_air_in() {
    let ring = row("ring");
    let (inner, outer, lambda) = (ring.input("inner"), ring.input("outer"), ring.input("lam"));
    let half = Half::new(outer, even(2.0 * outer / lambda * CELLS));
    let level = half.map(|x, y| (x.hypot(y) - inner).min(outer - x.hypot(y)));
    let region = Region::from_levels(half.lattice, &level);
    let squares = half.map(|_, _| lambda * lambda);
    let P = diffuse_air(&region, &squares, 1e-3, None).unwrap();
    let at = |part: f64| half.log_at(&P, inner + part * (outer - inner), 0.0);
    near(at(0.5), ring.output("P_middle"), 0.01, "P_middle");
    near(at(0.25), ring.output("P_quarter"), 0.01, "P_quarter");
}

#[test]
fn air_that_the_power_of_a_hertz_contact_consumes() {
    let strip = row("strip_hertz");
    let (b, lambda, m, threshold) = (
        strip.input("half_width"),
        strip.input("lam_centre"),
        strip.input("m"),
        strip.input("threshold"),
    );
    let exact = strip.output("core_half_width");
    let solve = |cells: f64| {
        let line = Strip::new(b, even(2.0 * b / lambda * cells));
        let region = Region::from_mask(line.lattice, &line.map(|x| x.abs() < b));
        let reaction = |x: f64| (1.0 - (x / b).powi(2)).max(0.0).powf(0.5 * m);
        let squares = line.map(|x| lambda * lambda / reaction(x));
        let P = diffuse_air(&region, &squares, threshold, None).unwrap();
        let share = aerated_share(&region, &P, threshold);
        let core = 0.5 * line.lattice.dx * share.iter().map(|s| 1.0 - s).sum::<f64>();
        (line, P, core)
    };
    let (line, P, core) = solve(CELLS);
    near(
        line.log_at(&P, 0.0),
        strip.output("P_centre"),
        0.01,
        "P_centre",
    );
    near(
        line.log_at(&P, 0.5 * b),
        strip.output("P_half"),
        0.01,
        "P_half",
    );
    near(b - core, b - exact, 1e-3, "distance");
    // Of second order where lambda varies.
    let order = (solve(8.0).2 - exact) / (core - exact).abs();
    let order = order.abs().ln() / (CELLS / 8.0).ln();
    assert!((1.8..2.5).contains(&order), "{order}");
}

#[test]
fn a_region_without_reaction_or_cells_is_aerated() {
    let half = Half::new(1.0, 20);
    let region = Region::from_mask(half.lattice, &half.map(|x, y| x.abs() < 1.0 && y < 1.0));
    let squares = half.map(|_, _| f64::INFINITY);
    let P = diffuse_air(&region, &squares, 1e-5, None).unwrap();
    assert!(P.iter().all(|P| (P - 1.0).abs() < 1e-8));
    let none = Region::from_mask(half.lattice, &half.map(|_, _| false));
    assert!(none.is_empty());
    let P = diffuse_air(&none, &squares, 1e-5, None).unwrap();
    assert!(aerated_share(&none, &P, 1e-5).iter().all(|s| *s == 1.0));
    // A whole grid that is closed has its border at the edge of the grid.
    let lattice = Lattice {
        sealed: [false; 2],
        ..half.lattice
    };
    let all = Region::from_mask(lattice, &vec![true; lattice.cells()]);
    let P = diffuse_air(&all, &half.map(|_, _| 0.01), 1e-5, None).unwrap();
    assert!(P.iter().all(|P| *P > 0.0 && *P < 1.0));
}
