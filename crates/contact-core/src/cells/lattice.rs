//! The cells that are stored, half of the grid of a mirrored scene: their places, neighbours, and
//! the borders of zones of them.

use crate::plan::Mirror;
use crate::scene::Grid;

/// Where the stored cells are.
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    columns: isize,
    rows: isize,
    mirrored: bool,
    /// Whether there is one row.
    pub(crate) flat: bool,
}

impl Lattice {
    /// The cells of a grid that are solved for.
    pub fn new(grid: &Grid, mirror: Mirror) -> Self {
        Self {
            columns: grid.nx as isize,
            rows: mirror.rows(grid.ny) as isize,
            mirrored: mirror == Mirror::Y,
            flat: grid.ny == 1,
        }
    }

    /// Cells of a column that are stored.
    pub(crate) fn rows(self) -> usize {
        self.rows as usize
    }

    /// Whether a half of the grid stands for all of it: its first row touches its mirror image.
    pub(crate) fn is_mirrored(self) -> bool {
        self.mirrored
    }

    /// The cells that have neighbours of the other kind, in order.
    pub fn border(self, zone: &[bool]) -> Vec<usize> {
        let (columns, rows) = (self.columns as usize, self.rows as usize);
        let near = |i: usize| zone[i * rows..(i + 1) * rows].windows(3);
        let (mut border, mut within) = (Vec::new(), Vec::new());
        for i in 0..columns {
            let (first, last) = (i * rows, (i + 1) * rows - 1);
            let outermost = i == 0 || i + 1 == columns || rows < 3;
            if outermost {
                border.extend((first..=last).filter(|&n| self.at_border(n, zone)));
                continue;
            }
            // A column at once, but for its ends.
            within.clear();
            let around = near(i - 1).zip(near(i)).zip(near(i + 1));
            within.extend(around.map(|((a, b), c)| {
                let own = b[1];
                let others = [a[0], a[1], a[2], b[0], b[2], c[0], c[1], c[2]];
                let differ = others.map(|other| u8::from(other != own));
                differ.into_iter().sum::<u8>() > 0
            }));
            border.extend(self.at_border(first, zone).then_some(first));
            let found = (first + 1..)
                .zip(&within)
                .filter(|(_, at_border)| **at_border);
            border.extend(found.map(|(n, _)| n));
            border.extend(self.at_border(last, zone).then_some(last));
        }
        border
    }

    /// Whether a cell has neighbours of the other kind.
    fn at_border(self, n: usize, zone: &[bool]) -> bool {
        self.around(n, 1)
            .any(|(_, m)| m.is_some_and(|m| zone[m]) != zone[n])
    }

    /// Whether a cell or one around it is in a zone.
    pub(crate) fn is_beside(self, n: usize, zone: &[bool]) -> bool {
        self.around(n, 1).any(|(_, m)| m.is_some_and(|m| zone[m]))
    }

    /// The direction, out of eight, that leads most squarely into the zone.
    pub(crate) fn inwards(self, n: usize, zone: &[bool]) -> Option<[isize; 2]> {
        const REACH: isize = 2;
        let mut to = [0, 0];
        let mut add = |[columns, rows]: [isize; 2], inside: bool| {
            to[0] += columns * isize::from(inside);
            to[1] += rows * isize::from(inside);
        };
        if self.is_clear(n, REACH) {
            for columns in -REACH..=REACH {
                let first = n.strict_add_signed(self.step(columns, -REACH));
                for (rows, &inside) in (-REACH..=REACH).zip(&zone[first..]) {
                    add([columns, rows], inside);
                }
            }
        } else {
            for (d, m) in self.around(n, REACH) {
                add(d, m.is_some_and(|m| zone[m]));
            }
        }
        // The tangent of 22.5 degrees is 0.414.
        let part = |k: isize, other: isize| {
            if 1000 * k.abs() > 414 * other.abs() {
                k.signum()
            } else {
                0
            }
        };
        (to != [0, 0]).then(|| [part(to[0], to[1]), part(to[1], to[0])])
    }

    /// The cells around a cell, and where they are from it.
    fn around(self, n: usize, reach: isize) -> impl Iterator<Item = ([isize; 2], Option<usize>)> {
        let across = if self.flat { 0 } else { reach };
        let (i, j) = self.place(n);
        (-reach..=reach)
            .flat_map(move |columns| (-across..=across).map(move |rows| [columns, rows]))
            .map(move |d| (d, self.kept(i + d[0], j + d[1])))
    }

    /// The stored cell that stands for the one so many columns and rows away.
    pub(crate) fn beside(self, n: usize, [columns, rows]: [isize; 2]) -> Option<usize> {
        let (i, j) = self.place(n);
        self.kept(i + columns, j + rows)
    }

    /// Difference of cell numbers for an offset in columns and rows, without mirror images.
    pub(crate) fn step(self, columns: isize, rows: isize) -> isize {
        columns * self.rows + rows
    }

    /// Whether a stored cell is at least `reach` columns and rows from the border.
    pub(crate) fn is_clear(self, n: usize, reach: isize) -> bool {
        let (i, j) = self.place(n);
        let inside = |k: isize, of: isize| (reach..of - reach).contains(&k);
        inside(i, self.columns) && inside(j, self.rows)
    }

    /// Column and row of a stored cell.
    pub(crate) fn place(self, n: usize) -> (isize, isize) {
        (n as isize / self.rows, n as isize % self.rows)
    }

    /// The stored cell that stands for the one in a column and row.
    pub(crate) fn kept(self, i: isize, j: isize) -> Option<usize> {
        // The stored half lies at y > 0.
        let j = if j < 0 && self.mirrored { -1 - j } else { j };
        let on_grid = (0..self.columns).contains(&i) && (0..self.rows).contains(&j);
        on_grid.then(|| (i * self.rows + j) as usize)
    }
}
