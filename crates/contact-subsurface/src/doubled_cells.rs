//! Cells of twice the length, paired in two ways.
//!
//! Beside a rim a value depends on where the rim lies in its cell, so that the change by one pairing may
//! vanish by chance.

use contact_core::scene::Grid;

/// Cells of twice the length along each axis.
pub struct DoubledCells {
    fine: Grid,
    /// Cells by which their grid begins before the finer one.
    before: usize,
    /// The grid of the larger cells.
    pub grid: Grid,
    /// The middle of their grid \[m\]; beyond a grid of an odd number of cells there are no
    /// tractions.
    pub middle: (f64, f64),
}

impl DoubledCells {
    /// Pairs the cells of a grid in both ways: from the first cell on, and from the second.
    pub fn new_pair(fine: &Grid) -> [Self; 2] {
        [0, 1].map(|before| Self::new(fine, before))
    }

    /// Pairs the cells of a grid, the first pair having `before` (0 or 1) cells beyond the grid.
    fn new(fine: &Grid, before: usize) -> Self {
        let across = if fine.ny == 1 { 1 } else { 2 };
        let before_y = before * (across - 1);
        let nx = (fine.nx + before).div_ceil(2);
        let ny = (fine.ny + before_y).div_ceil(across);
        let grid = Grid {
            nx,
            ny,
            dx: 2.0 * fine.dx,
            dy: across as f64 * fine.dy,
            ..*fine
        };
        // Half of the cells beyond the end less half of those before the start.
        let offset = |cells: usize, count: usize, before: usize, d: f64| {
            ((cells - count) as f64 - 2.0 * before as f64) * 0.5 * d
        };
        let middle = (
            offset(2 * nx, fine.nx, before, fine.dx),
            offset(across * ny, fine.ny, before_y, fine.dy),
        );
        Self {
            fine: *fine,
            before,
            grid,
            middle,
        }
    }

    /// Pairs the cells of another grid of nx x ny cells in the same way.
    pub(crate) fn for_cells(&self, [nx, ny]: [usize; 2], [dx, dy]: [f64; 2]) -> Self {
        let fine = Grid {
            nx,
            ny,
            dx,
            dy,
            ..self.fine
        };
        Self::new(&fine, self.before)
    }

    /// The larger cell that contains a cell of the finer grid.
    pub(crate) fn cell_of(&self, [i, j]: [usize; 2]) -> usize {
        let index = |n: usize, times: usize| (n + self.before * (times - 1)) / times;
        index(i, 2) * self.grid.ny + index(j, self.rows_per_cell())
    }

    /// Fraction of a larger cell that a cell of the finer grid covers.
    pub(crate) fn fraction(&self) -> f64 {
        1.0 / (2 * self.rows_per_cell()) as f64
    }

    /// Rows of fine cells in a larger one: 2, or 1 in plane strain.
    fn rows_per_cell(&self) -> usize {
        if self.fine.ny == 1 { 1 } else { 2 }
    }

    /// The cells of the finer grid in the larger cell n.
    fn fine_cells(&self, n: usize) -> impl Iterator<Item = usize> {
        let (across, Grid { nx, ny, .. }) = (self.rows_per_cell(), self.fine);
        let range = |n: usize, times: usize, count: usize| {
            let (from, before) = (times * n, self.before * (times - 1));
            from.saturating_sub(before)..(from + times - before).min(count)
        };
        let rows = range(n % self.grid.ny, across, ny);
        range(n / self.grid.ny, 2, nx).flat_map(move |i| rows.clone().map(move |j| i * ny + j))
    }

    /// The mean over each larger cell.
    pub(crate) fn mean(&self, field: &[f64]) -> Vec<f64> {
        let part = self.fraction();
        let mean_of = |n: usize| part * self.fine_cells(n).map(|m| field[m]).sum::<f64>();
        (0..self.grid.cells()).map(mean_of).collect()
    }

    /// Marks each larger cell that contains a marked cell.
    pub(crate) fn any(&self, mask: &[bool]) -> Vec<bool> {
        let is_marked = |n: usize| self.fine_cells(n).any(|m| mask[m]);
        (0..self.grid.cells()).map(is_marked).collect()
    }
}
