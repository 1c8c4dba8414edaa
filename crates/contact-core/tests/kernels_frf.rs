//! Frequency responses against a table made with multi-precision arithmetic.

#![allow(clippy::unwrap_used)]

mod kernel_tables;

use contact_core::kernels::{Complex64, Stack};
use kernel_tables::{body, load, matrix, number, whole};

/// Relative to the largest entry of the same kind: rounding of a few hundred operations.
const TOLERANCE: f64 = 1e-12;

/// Largest difference over the largest entry.
fn error<const R: usize>(ours: &[[Complex64; 3]; R], re: &[Vec<f64>], im: &[Vec<f64>]) -> f64 {
    let (mut largest, mut worst): (f64, f64) = (0.0, 0.0);
    for (row, ours) in ours.iter().enumerate() {
        for (column, ours) in ours.iter().enumerate() {
            let theirs = Complex64::new(re[row][column], im[row][column]);
            largest = largest.max(theirs.norm());
            worst = worst.max((ours - theirs).norm());
        }
    }
    worst / largest
}

#[test]
fn reproduce_the_table() {
    let mut worst: f64 = 0.0;
    for entry in load("kernel_frf.json") {
        let stack = Stack::new(&body(&entry));
        let (m, n) = (number(&entry, "m"), number(&entry, "n"));
        let layer = Some(whole(&entry, "layer_index") as usize);
        let ours = stack.frf(m, n, number(&entry, "x3"), layer).unwrap();
        let u = error(&ours.u, &matrix(&entry["u_re"]), &matrix(&entry["u_im"]));
        let s = error(&ours.s, &matrix(&entry["s_re"]), &matrix(&entry["s_im"]));
        worst = worst.max(u).max(s);
        if number(&entry, "x3") == 0.0 {
            let ours = stack.surface_frf(m, n).unwrap();
            let u = error(&ours, &matrix(&entry["u_re"]), &matrix(&entry["u_im"]));
            worst = worst.max(u);
        }
    }
    assert!(worst < TOLERANCE, "{worst:.2e}");
}
