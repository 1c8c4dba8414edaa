//! The stored cells, half of the grid of a mirrored scene: their positions, neighbours, and
//! the borders of zones of cells.

use crate::plan::Mirror;
use crate::scene::Grid;

/// Columns and rows of the stored cells.
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    columns: isize,
    rows: isize,
    mirrored: bool,
    /// Whether there is one row.
    pub(crate) is_single_row: bool,
}

impl Lattice {
    /// The cells of a grid that are solved for.
    pub fn new(grid: &Grid, mirror: Mirror) -> Self {
        Self {
            columns: grid.nx as isize,
            rows: mirror.rows(grid.ny) as isize,
            mirrored: mirror == Mirror::Y,
            is_single_row: grid.ny == 1,
        }
    }

    /// Cells of a column that are stored.
    pub(crate) fn rows(self) -> usize {
        self.rows as usize
    }

    /// Whether a half of the grid is stored: its first row touches its mirror image.
    pub(crate) fn is_mirrored(self) -> bool {
        self.mirrored
    }

    /// The cells at the border of a zone, inside and outside it: those with a neighbour (along x or y) of the
    /// other kind.
    pub fn border(self, zone: &[bool]) -> Vec<usize> {
        let (columns, rows) = (self.columns as usize, self.rows as usize);
        let triples_of_column = |i: usize| zone[i * rows..(i + 1) * rows].windows(3);
        let (mut border, mut is_border) = (Vec::new(), Vec::new());
        for i in 0..columns {
            let (first, last) = (i * rows, (i + 1) * rows - 1);
            let outermost = i == 0 || i + 1 == columns || rows < 3;
            if outermost {
                border.extend((first..=last).filter(|&n| self.is_at_border(n, zone)));
                continue;
            }
            // A whole column at once, except its ends.
            is_border.clear();
            let neighbourhoods = triples_of_column(i - 1)
                .zip(triples_of_column(i))
                .zip(triples_of_column(i + 1));
            is_border.extend(neighbourhoods.map(|((a, b), c)| {
                let middle = b[1];
                let neighbours = [a[0], a[1], a[2], b[0], b[2], c[0], c[1], c[2]];
                let differences = neighbours.map(|other| u8::from(other != middle));
                differences.into_iter().sum::<u8>() > 0
            }));
            border.extend(self.is_at_border(first, zone).then_some(first));
            let border_cells = (first + 1..)
                .zip(&is_border)
                .filter(|(_, at_border)| **at_border);
            border.extend(border_cells.map(|(n, _)| n));
            border.extend(self.is_at_border(last, zone).then_some(last));
        }
        border
    }

    /// Whether a cell has neighbours of the other kind.
    fn is_at_border(self, n: usize, zone: &[bool]) -> bool {
        self.cells_around(n, 1)
            .any(|(_, m)| m.is_some_and(|m| zone[m]) != zone[n])
    }

    /// Whether a cell or one around it is in a zone.
    pub(crate) fn is_beside(self, n: usize, zone: &[bool]) -> bool {
        self.cells_around(n, 1)
            .any(|(_, m)| m.is_some_and(|m| zone[m]))
    }

    /// The direction, out of eight, that points most directly into the zone.
    pub(crate) fn direction_into(self, n: usize, zone: &[bool]) -> Option<[isize; 2]> {
        const REACH: isize = 2;
        let mut sum = [0, 0];
        let mut add = |[columns, rows]: [isize; 2], inside: bool| {
            sum[0] += columns * isize::from(inside);
            sum[1] += rows * isize::from(inside);
        };
        if self.is_clear(n, REACH) {
            for columns in -REACH..=REACH {
                let first = n.strict_add_signed(self.step(columns, -REACH));
                for (rows, &inside) in (-REACH..=REACH).zip(&zone[first..]) {
                    add([columns, rows], inside);
                }
            }
        } else {
            for (d, m) in self.cells_around(n, REACH) {
                add(d, m.is_some_and(|m| zone[m]));
            }
        }
        // The tangent of 22.5 degrees is 0.414.
        let component = |k: isize, other: isize| {
            if 1000 * k.abs() > 414 * other.abs() {
                k.signum()
            } else {
                0
            }
        };
        (sum != [0, 0]).then(|| [component(sum[0], sum[1]), component(sum[1], sum[0])])
    }

    /// Yields the cells around a cell with their offsets.
    fn cells_around(
        self,
        n: usize,
        reach: isize,
    ) -> impl Iterator<Item = ([isize; 2], Option<usize>)> {
        let row_reach = if self.is_single_row { 0 } else { reach };
        let (i, j) = self.column_and_row(n);
        (-reach..=reach)
            .flat_map(move |columns| (-row_reach..=row_reach).map(move |rows| [columns, rows]))
            .map(move |d| (d, self.stored_cell(i + d[0], j + d[1])))
    }

    /// Stored cell at an offset of columns and rows, its mirror image where that is stored.
    pub(crate) fn cell_at_offset(self, n: usize, [columns, rows]: [isize; 2]) -> Option<usize> {
        let (i, j) = self.column_and_row(n);
        self.stored_cell(i + columns, j + rows)
    }

    /// Difference of cell numbers for an offset in columns and rows, without mirror images.
    pub(crate) fn step(self, columns: isize, rows: isize) -> isize {
        columns * self.rows + rows
    }

    /// Whether a stored cell is at least `reach` columns and rows from the border.
    pub(crate) fn is_clear(self, n: usize, reach: isize) -> bool {
        let (i, j) = self.column_and_row(n);
        let is_inside = |k: isize, of: isize| (reach..of - reach).contains(&k);
        is_inside(i, self.columns) && is_inside(j, self.rows)
    }

    /// Column and row of a stored cell.
    pub(crate) fn column_and_row(self, n: usize) -> (isize, isize) {
        (n as isize / self.rows, n as isize % self.rows)
    }

    /// Stored cell in a column and row, its mirror image where that is stored.
    pub(crate) fn stored_cell(self, i: isize, j: isize) -> Option<usize> {
        // The stored half lies at y > 0.
        let j = if j < 0 && self.mirrored { -1 - j } else { j };
        let on_grid = (0..self.columns).contains(&i) && (0..self.rows).contains(&j);
        on_grid.then(|| (i * self.rows + j) as usize)
    }
}
