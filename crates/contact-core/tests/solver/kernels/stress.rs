//! Stress below one loaded cell, against a table made with multi-precision arithmetic.

use crate::kernel_tables::{body, load, matrix, number, whole};
use contact_core::kernels::{StressCoefficients, stress_coefficients, stress_of_cell_at};
use contact_core::scene::{Body, Coating, Elastic, Grid, Shape};

/// The table's own accuracy is 2.5e-12 of the largest component.
const TOLERANCE: f64 = 1e-11;

#[test]
fn reproduces_the_table() {
    for entry in load("kernel_stress.json") {
        let cell = (number(&entry, "d1"), number(&entry, "d2"));
        let [x, y, z] = ["x1", "x2", "x3"].map(|key| number(&entry, key));
        let layer = Some(whole(&entry, "layer_index") as usize);
        let ours = stress_of_cell_at(&body(&entry), cell, (x, y, z), layer).unwrap();
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
    for (entry, stretch) in load("kernel_stress.json")
        .iter()
        .step_by(3)
        .zip([1.0, 0.7].iter().cycle())
    {
        let body = body(entry);
        let d = (number(entry, "d1"), stretch * number(entry, "d1"));
        let grid = Grid::from_spacing((4, 5), d).unwrap();
        let z = number(entry, "x3");
        let layer = Some(whole(entry, "layer_index") as usize);
        let c = stress_coefficients(&body, &grid, z, layer, None).unwrap();
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
            let point = stress_of_cell_at(&body, d, at, layer).unwrap();
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

/// A layer cut in two is the same body, but not the same computation: other scales, nodes and
/// closed forms, another layer to look into. Any contrast, thin and thick layers.
#[test]
fn a_layer_may_be_cut_in_two() {
    let mut state = 11_u64;
    let mut draw = |from: f64, to: f64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        from + (to - from) * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for case in 0..30 {
        let mut layer = || Coating {
            material: Elastic::new(210e9 * 10_f64.powf(draw(-3.0, 3.0)), draw(-0.9, 0.4999))
                .unwrap(),
            thickness: 10_f64.powf(draw(-1.3, 2.0)),
        };
        let coatings: Vec<_> = (0..[1, 2, 4][case % 3]).map(|_| layer()).collect();
        let whole = Body {
            substrate: Elastic { E: 210e9, nu: 0.3 },
            coatings,
            bonds: Vec::new(),
            plastic: Vec::new(),
            hardness: f64::INFINITY,
            residual: Vec::new(),
            shape: Shape::Flat,
            bulk: contact_core::scene::Bulk::default(),
        };
        let mut cut = whole.clone();
        let h = whole.coatings[0].thickness;
        cut.coatings[0].thickness = 0.6 * h;
        cut.coatings.insert(
            0,
            Coating {
                thickness: 0.4 * h,
                ..whole.coatings[0]
            },
        );
        let point = [draw(-3.0, 3.0), draw(-3.0, 3.0)];
        let below = draw(0.0, 0.5);
        // Above the cut, below it, and in the next material.
        for (depth, layer, cut_layer) in [
            (0.4 * below * h, 0, 0),
            (0.4 * h, 0, 1),
            ((0.4 + 0.6 * below) * h, 0, 1),
            (h, 1, 2),
            (h + below, 1, 2),
        ] {
            if layer == 1 && whole.coatings.get(1).is_some_and(|c| c.thickness < below) {
                continue;
            }
            let at = (point[0], point[1], depth);
            let ours = stress_of_cell_at(&whole, (1.0, 0.8), at, Some(layer)).unwrap();
            let theirs = stress_of_cell_at(&cut, (1.0, 0.8), at, Some(cut_layer)).unwrap();
            let largest = ours.iter().flatten().fold(0.0, |m: f64, s| m.max(s.abs()));
            for (a, b) in ours.iter().flatten().zip(theirs.iter().flatten()) {
                // Where a soft layer carries little, two large parts cancel: then against the
                // traction.
                let error = (a - b).abs() / largest.max(1.0);
                assert!(error < 1e-11, "case {case}, z = {depth}: {error:.1e}");
            }
        }
    }
}
