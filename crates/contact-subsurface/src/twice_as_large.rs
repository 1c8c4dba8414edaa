//! Cells twice as large as those of a grid, paired in two ways.
//!
//! Beside a rim a value depends on where the rim lies in its cell, so that the change by one pairing may
//! vanish by chance.

use contact_core::scene::Grid;

/// Cells of twice the length along each axis.
pub struct TwiceAsLarge {
    fine: Grid,
    /// Cells by which their grid begins before the finer one.
    before: usize,
    /// Its grid.
    pub grid: Grid,
    /// The middle of their grid \[m\]; beyond a grid of an odd number of cells there are no
    /// tractions.
    pub middle: (f64, f64),
}

impl TwiceAsLarge {
    /// The cells twice as large as those of a grid, paired in both ways: from the first cell on, and
    /// from the second.
    pub fn both(fine: &Grid) -> [Self; 2] {
        [0, 1].map(|before| Self::new(fine, before))
    }

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
        let off = |cells: usize, own: usize, before: usize, d: f64| {
            ((cells - own) as f64 - 2.0 * before as f64) * 0.5 * d
        };
        let middle = (
            off(2 * nx, fine.nx, before, fine.dx),
            off(across * ny, fine.ny, before_y, fine.dy),
        );
        Self {
            fine: *fine,
            before,
            grid,
            middle,
        }
    }

    /// The cells twice as large as others, paired as these are.
    pub(crate) fn of_cells(&self, [nx, ny]: [usize; 2], [dx, dy]: [f64; 2]) -> Self {
        let fine = Grid {
            nx,
            ny,
            dx,
            dy,
            ..self.fine
        };
        Self::new(&fine, self.before)
    }

    /// The cell that a cell of the finer grid is part of.
    pub(crate) fn cell_of(&self, [i, j]: [usize; 2]) -> usize {
        let of = |n: usize, times: usize| (n + self.before * (times - 1)) / times;
        of(i, 2) * self.grid.ny + of(j, self.across())
    }

    /// Part of a cell that one of the finer grid is.
    pub(crate) fn part(&self) -> f64 {
        1.0 / (2 * self.across()) as f64
    }

    fn across(&self) -> usize {
        if self.fine.ny == 1 { 1 } else { 2 }
    }

    /// The cells of the finer grid that make cell n.
    fn cells(&self, n: usize) -> impl Iterator<Item = usize> {
        let (across, Grid { nx, ny, .. }) = (self.across(), self.fine);
        let of = |n: usize, times: usize, count: usize| {
            let (from, before) = (times * n, self.before * (times - 1));
            from.saturating_sub(before)..(from + times - before).min(count)
        };
        let rows = of(n % self.grid.ny, across, ny);
        of(n / self.grid.ny, 2, nx).flat_map(move |i| rows.clone().map(move |j| i * ny + j))
    }

    /// The mean over each cell.
    pub(crate) fn mean(&self, field: &[f64]) -> Vec<f64> {
        let part = self.part();
        let of = |n: usize| part * self.cells(n).map(|m| field[m]).sum::<f64>();
        (0..self.grid.cells()).map(of).collect()
    }

    /// For each cell whether any part of it is marked.
    pub(crate) fn any(&self, mask: &[bool]) -> Vec<bool> {
        let of = |n: usize| self.cells(n).any(|m| mask[m]);
        (0..self.grid.cells()).map(of).collect()
    }
}
