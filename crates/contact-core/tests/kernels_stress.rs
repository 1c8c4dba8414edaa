//! Stress below one loaded cell, against a table made with multi-precision arithmetic.

#![allow(clippy::unwrap_used)]

mod kernel_tables;

use contact_core::kernels::{StressCoefficients, stress_at, stress_coefficients};
use contact_core::scene::Grid;
use kernel_tables::{body, load, matrix, number, whole};

/// The table's own accuracy is 2.5e-12 of the largest component.
const TOLERANCE: f64 = 1e-11;

#[test]
fn reproduces_the_table() {
    for entry in load("kernel_stress.json") {
        let cell = (number(&entry, "d1"), number(&entry, "d2"));
        let [x, y, z] = ["x1", "x2", "x3"].map(|key| number(&entry, key));
        let layer = Some(whole(&entry, "layer_index") as usize);
        let ours = stress_at(&body(&entry), cell, (x, y, z), layer).unwrap();
        let theirs = matrix(&entry["s"]);
        let largest = theirs
            .iter()
            .flatten()
            .fold(0.0, |m: f64, s| m.max(s.abs()));
        let differences = ours.iter().flatten().zip(theirs.iter().flatten());
        let worst = differences.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / largest;
        assert!(
            worst < TOLERANCE,
            "entry {}: {worst:.2e} {ours:?}",
            entry["id"]
        );
    }
}

/// The coefficients of a grid are the stresses at its offsets, with their parities.
#[test]
fn coefficients_are_the_stress_at_the_offsets() {
    for entry in load("kernel_stress.json").iter().step_by(5) {
        let body = body(entry);
        let d = (number(entry, "d1"), 0.7 * number(entry, "d1"));
        let grid = Grid::from_spacing((4, 5), d).unwrap();
        let z = number(entry, "x3");
        let layer = Some(whole(entry, "layer_index") as usize);
        let c = stress_coefficients(&body, &grid, z, layer).unwrap();
        for (i, j) in [
            (0_i32, 0_i32),
            (3, 2),
            (-2, 4),
            (1, -1),
            (-3, -3),
            (0, 3),
            (2, 0),
        ] {
            let at = (f64::from(i) * d.0, f64::from(j) * d.1, z);
            let point = stress_at(&body, d, at, layer).unwrap();
            for (row, point) in point.iter().enumerate() {
                for (column, point) in point.iter().enumerate() {
                    let (odd_x, odd_y) = StressCoefficients::is_odd(row, column);
                    let flips = (odd_x && i < 0) != (odd_y && j < 0);
                    let offset = (i.unsigned_abs() as usize, j.unsigned_abs() as usize);
                    let ours = c.s[row][column][offset] * if flips { -1.0 } else { 1.0 };
                    assert!((ours - point).abs() < 1e-12, "{row} {column} {i} {j}");
                }
            }
        }
    }
}
