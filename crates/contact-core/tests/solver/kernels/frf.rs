//! Frequency responses against a table made with multi-precision arithmetic.

use crate::kernel_tables::{body, load, number, off, whole};
use contact_core::kernels::Stack;

/// Relative to the largest entry of the same kind: rounding of a few hundred operations.
const TOLERANCE: f64 = 1e-12;

#[test]
fn reproduce_the_table() {
    let mut worst: f64 = 0.0;
    for entry in load("kernel_frf.json") {
        let stack = Stack::new(&body(&entry));
        let (m, n) = (number(&entry, "m"), number(&entry, "n"));
        let layer = Some(whole(&entry, "layer_index") as usize);
        let ours = stack.frf(m, n, number(&entry, "x3"), layer).unwrap();
        let u = off(&ours.u, &entry, "u");
        let s = off(&ours.s, &entry, "s");
        worst = worst.max(u).max(s);
        if number(&entry, "x3") == 0.0 {
            let ours = stack.surface_frf(m, n).unwrap();
            let u = off(&ours, &entry, "u");
            worst = worst.max(u);
        }
    }
    assert!(worst < TOLERANCE, "{worst:.2e}");
}
