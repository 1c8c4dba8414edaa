//! The error bar of a number, with its parts from cells, increments and solver.

use serde::{Deserialize, Serialize};

/// The estimated error of a number and its parts, >= 0, in the unit of the number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bar {
    /// The root of the sum of squares; if the errors of cells and increments have the same sign,
    /// their sum combined with the solver's part. Errors of opposite sign are not taken to cancel:
    /// neither is known well enough.
    pub total: f64,
    /// Error of the cells.
    pub cells: f64,
    /// Error of the increments.
    pub path: f64,
    /// Error within the solver's tolerance.
    pub solver: f64,
}

impl Bar {
    /// Combines the errors of the cells, of the increments (`path`) and of the solver, whose signs are not
    /// known, as the root of the sum of squares.
    pub(super) fn new(cells: f64, path: f64, solver: f64) -> Self {
        Self {
            total: cells.hypot(path).hypot(solver),
            cells,
            path,
            solver,
        }
    }

    /// The error bar of a number times a constant `factor` >= 0: each part times it.
    pub(super) fn times(&self, factor: f64) -> Self {
        Self {
            total: factor * self.total,
            cells: factor * self.cells,
            path: factor * self.path,
            solver: factor * self.solver,
        }
    }

    /// The bar of the sum of two numbers. Their errors may have the same sign, so that the parts are added.
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self {
            total: self.total + other.total,
            cells: self.cells + other.cells,
            path: self.path + other.path,
            solver: self.solver + other.solver,
        }
    }

    /// Builds the bar of a number from signed errors: `off` of the cells, with the random part `scatter`, and
    /// `path` of the increments. Where `off` and `path` have one sign they are added, otherwise their squares.
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
