//! The three ways to ask against the direct sum and the table of single cells.

use contact_core::convolution::Tractions;
use contact_core::kernels::stress_of_cell_at;
use contact_core::scene::{Body, Grid};
use contact_subsurface::{Depth, Line, Points, Section, Side, Slices, depths};
use ndarray::Array2;

use crate::kernel_tables::{body, load, matrix, number, whole};
use crate::{coated, states, tractions};

/// The stress by its definition: the sum over all cells.
fn direct(
    body: &Body,
    grid: &Grid,
    q: &[Array2<f64>; 3],
    at: (f64, f64),
    depth: Depth,
) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for i in 0..grid.nx {
        for j in 0..grid.ny {
            let loads = [0, 1, 2].map(|c| q[c][(i, j)]);
            if loads.iter().all(|q| *q == 0.0) {
                continue;
            }
            let from = (at.0 - grid.x(i), at.1 - grid.y(j), depth.z);
            let s = stress_of_cell_at(body, (grid.dx, grid.dy), from, Some(depth.layer)).unwrap();
            for (sum, row) in sum.iter_mut().zip(s) {
                *sum += row[0] * loads[0] + row[1] * loads[1] + row[2] * loads[2];
            }
        }
    }
    sum
}

/// The table of single cells, whose smallest features point loads have to follow.
#[test]
fn a_single_cell_reproduces_the_table() {
    let mut worst: f64 = 0.0;
    for entry in load("kernel_stress.json") {
        let body = body(&entry);
        let d = (number(&entry, "d1"), number(&entry, "d2"));
        let grid = Grid::from_spacing((1, 1), d).unwrap();
        let depth = Depth {
            z: number(&entry, "x3"),
            layer: whole(&entry, "layer_index") as usize,
        };
        let at = (number(&entry, "x1"), number(&entry, "x2"), depth);
        let one = [1.0];
        let loads = [
            Tractions {
                q_x: Some(&one),
                ..Tractions::default()
            },
            Tractions {
                q_y: Some(&one),
                ..Tractions::default()
            },
            Tractions {
                p: Some(&one),
                ..Tractions::default()
            },
        ];
        let points = Points::new(&body, Side::Body2, &grid, &loads).unwrap();
        let ours = points.stress(&[at]).unwrap();
        let theirs = matrix(&entry["s"]);
        let largest = theirs
            .iter()
            .flatten()
            .fold(0.0, |m: f64, s| m.max(s.abs()));
        for (row, theirs) in theirs.iter().enumerate() {
            for (column, theirs) in theirs.iter().enumerate() {
                let error = (ours[column][0][row] - theirs).abs() / largest;
                assert!(error < 1e-6, "entry {}: {error:.1e}", entry["id"]);
                worst = worst.max(error);
            }
        }
    }
    println!("table of stresses under a cell: {worst:.1e} of the largest component");
}

#[test]
fn all_ways_agree_with_the_direct_sum() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let state = states(&q);
    let z = [0.0, 0.4, 3.0, 9.5, 11.0, 12.0, 14.0, 40.0];
    let depths = depths(&body, &z).unwrap();
    assert_eq!(depths.len(), 10);
    let slices = Slices::new(&body, Side::Body2, &grid, &[state]).unwrap();
    let points = Points::new(&body, Side::Body2, &grid, &[state]).unwrap();
    // Through the middles of cells, between them, and off both.
    let lines = [
        Line::AlongX(grid.y(4)),
        Line::AlongX(0.0),
        Line::AlongX(2.171),
        Line::AlongY(grid.x(9)),
        Line::AlongY(-1.83),
    ];
    let sections =
        lines.map(|line| Section::new(&body, Side::Body2, &grid, line, &[state]).unwrap());
    let lines_stress: Vec<_> = sections
        .iter()
        .map(|s| s.stress(&depths).unwrap().remove(0))
        .collect();
    for (k, depth) in depths.iter().enumerate() {
        // Point loads stand for cells from eight cells' depth on.
        let tolerance = if depth.z < 8.0 { 1e-11 } else { 3e-8 };
        let plane = slices.stress(*depth).unwrap().remove(0);
        for (i, j) in [(0, 0), (7, 4), (3, 10)] {
            let at = (grid.x(i), grid.y(j));
            let truth = direct(&body, &grid, &q, at, *depth);
            let point = points.stress(&[(at.0, at.1, *depth)]).unwrap()[0][0];
            for c in 0..6 {
                let error = (plane[c][(i, j)] - truth[c]).abs();
                assert!(error < tolerance, "plane {depth:?} {c}: {error:.1e}");
                let error = (point[c] - truth[c]).abs();
                assert!(error < tolerance, "point {depth:?} {c}: {error:.1e}");
            }
        }
        for (line, stress) in lines.iter().zip(&lines_stress) {
            for i in [5] {
                let at = line.place(line.places(&grid)[i]);
                // On a border between cells the surface stress has no value.
                if depth.z == 0.0 && matches!(line, Line::AlongX(0.0)) {
                    continue;
                }
                let truth = direct(&body, &grid, &q, at, *depth);
                for c in 0..6 {
                    let error = (stress[(c, k, i)] - truth[c]).abs();
                    assert!(error < tolerance, "{line:?} {depth:?} {c}: {error:.1e}");
                }
            }
        }
    }
}
