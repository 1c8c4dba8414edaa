//! Influence coefficients against tables made with multi-precision arithmetic, and their limits.

use crate::kernel_tables::{body, load, matrix, number, whole};
use contact_core::kernels::influence_coefficients;
use contact_core::scene::{Grid, KernelSettings};

/// What the tables are good to and the conversion promises: 1e-11 of C33(0,0).
const TOLERANCE: f64 = 1e-11;

#[test]
fn reproduce_the_table() {
    for entry in load("kernel_ic.json") {
        let (i, j) = (whole(&entry, "i"), whole(&entry, "j"));
        let n = (i.unsigned_abs() as usize + 1, j.unsigned_abs() as usize + 1);
        let grid = Grid::from_spacing(n, (number(&entry, "d1"), number(&entry, "d2"))).unwrap();
        let c =
            influence_coefficients(&body(&entry), &grid, &KernelSettings::default(), true, None);
        let c = c.unwrap_or_else(|e| panic!("{}: {e}", entry["id"]));
        let at = (n.0 - 1, n.1 - 1);
        let (sx, sy) = (i.signum() as f64, j.signum() as f64);
        let (xy, xz, yz) = (sx * sy * c.xy[at], sx * c.xz[at], sy * c.yz[at]);
        let ours = [[c.xx[at], xy, xz], [xy, c.yy[at], yz], [-xz, -yz, c.zz[at]]];
        let scale = number(&entry, "self_C33");
        for (row, theirs) in ours.iter().zip(matrix(&entry["C"])) {
            for (ours, theirs) in row.iter().zip(theirs) {
                let error = (ours - theirs).abs() / scale;
                assert!(error < TOLERANCE, "entry {}: {error:.2e}", entry["id"]);
            }
        }
    }
}
