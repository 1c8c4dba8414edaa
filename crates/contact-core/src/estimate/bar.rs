//! The error bar of a number, of what cells, increments and solver leave in it.

use serde::{Deserialize, Serialize};

/// The estimated error of a number and its parts, >= 0, in the unit of the number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bar {
    /// All: the root of the sum of the squares; where cells and increments are off to the same side, their sum
    /// and the solver's part. Errors of opposite signs are not taken to cancel: neither is known so well.
    pub total: f64,
    /// What the cells leave.
    pub cells: f64,
    /// What the increments leave.
    pub path: f64,
    /// What the solver's tolerance leaves.
    pub solver: f64,
}

impl Bar {
    /// Of parts whose signs are not known.
    pub(super) fn new(cells: f64, path: f64, solver: f64) -> Self {
        Self {
            total: cells.hypot(path).hypot(solver),
            cells,
            path,
            solver,
        }
    }

    /// Of an error of the cells `off`, whose sign is known, and of the `scatter` that they leave to chance; the sign
    /// of what the increments leave is known too.
    pub(super) fn signed(off: f64, scatter: f64, path: f64, solver: f64) -> Self {
        let together = off.hypot(path).max((off + path).abs());
        Self {
            total: together.hypot(scatter).hypot(solver),
            cells: off.hypot(scatter),
            path: path.abs(),
            solver,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Bar;

    #[test]
    fn errors_of_opposite_signs_do_not_cancel() {
        let same = Bar::signed(3.0, 0.0, 4.0, 0.0);
        let opposite = Bar::signed(3.0, 0.0, -4.0, 0.0);
        assert_eq!([same.total, opposite.total], [7.0, 5.0]);
        assert_eq!(Bar::signed(3.0, 4.0, 0.0, 12.0).total, 13.0);
        assert_eq!(Bar::new(3.0, 4.0, 12.0).total, 13.0);
    }
}
