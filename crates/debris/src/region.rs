//! The closed region of a contact, and the distances of its border.

/// Rectangular cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Number of columns along x.
    pub columns: usize,
    /// Number of rows along y.
    pub rows: usize,
    /// Cell size along x \[m\].
    pub dx: f64,
    /// Cell size along y \[m\].
    pub dy: f64,
    /// Whether nothing passes the low and the high edge of the grid along y: both in a line contact,
    /// the low one if y = 0 is a plane of symmetry. A sealed edge is no border of the region.
    pub sealed: [bool; 2],
}

impl Lattice {
    /// The cells of a line contact: one row.
    pub fn line(columns: usize, dx: f64) -> Self {
        Self {
            columns,
            rows: 1,
            dx,
            dy: 1.0,
            sealed: [true; 2],
        }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.columns * self.rows
    }
}

/// Number of sides of a cell: -x, +x, -y, +y.
pub(crate) const SIDES: usize = 4;
/// Distance of the border from the centre of a cell, over the cell, where only a mask is known.
const HALF: f64 = 0.5;
/// Least such distance. It bounds the conductance of a side.
const NEAREST: f64 = 1e-3;

/// A neighbour of a closed cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    /// Another closed cell, by its index among these.
    Closed(usize),
    /// The border of the region at a distance \[cells\] from the centre.
    Border(f64),
    /// Nothing passes.
    Sealed,
}

/// The closed cells of a lattice.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    pub(crate) lattice: Lattice,
    /// Index on the lattice of each closed cell, ascending.
    pub(crate) cells: Vec<usize>,
    pub(crate) sides: Vec<[Side; SIDES]>,
}

impl Region {
    /// The region of the closed cells of a mask. Its border follows the sides of the cells.
    pub fn from_mask(lattice: Lattice, closed: &[bool]) -> Self {
        let level: Vec<f64> = closed
            .iter()
            .map(|closed| if *closed { 1.0 } else { -1.0 })
            .collect();
        Self::from_levels(lattice, &level)
    }

    /// The region of positive `level`, such as a limit less the gap. Its border lies where the level, linear
    /// between two centres, vanishes. Where the level jumps, as at the edge of a flat pad, it lies on the side
    /// of the cell: see `distance`.
    pub fn from_levels(lattice: Lattice, level: &[f64]) -> Self {
        let cells: Vec<usize> = (0..lattice.cells()).filter(|&n| level[n] > 0.0).collect();
        let mut index = vec![usize::MAX; lattice.cells()];
        for (k, &n) in cells.iter().enumerate() {
            index[n] = k;
        }
        let Lattice { columns, rows, .. } = lattice;
        let side = |n: usize, next: [Option<usize>; 2], sealed: bool| match next {
            [Some(m), _] if index[m] != usize::MAX => Side::Closed(index[m]),
            [Some(m), beyond] => {
                let beyond = beyond.map_or(f64::NEG_INFINITY, |k| level[k]);
                Side::Border(distance(level[n], level[m], beyond).clamp(NEAREST, 1.0))
            }
            [None, _] if sealed => Side::Sealed,
            [None, _] => Side::Border(HALF),
        };
        // The next two cells, `index` being the place along an axis of `count` cells.
        let low = |n: usize, index: usize, step: usize| {
            [1, 2].map(|k| (index >= k).then(|| n - k * step))
        };
        let high = |n: usize, (index, count): (usize, usize), step: usize| {
            [1, 2].map(|k| (index + k < count).then(|| n + k * step))
        };
        let sides = cells.iter().map(|&n| {
            let (i, j) = (n / rows, n % rows);
            [
                side(n, low(n, i, rows), false),
                side(n, high(n, (i, columns), rows), false),
                side(n, low(n, j, 1), lattice.sealed[0]),
                side(n, high(n, (j, rows), 1), lattice.sealed[1]),
            ]
        });
        Self {
            sides: sides.collect(),
            lattice,
            cells,
        }
    }

    /// Whether no cell is closed.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Inverse of the square of the cell size along the normal of a side \[1/m^2\].
    pub(crate) fn inverse_square(&self, side: usize) -> f64 {
        let size = if side < 2 {
            self.lattice.dx
        } else {
            self.lattice.dy
        };
        1.0 / (size * size)
    }

    /// The values of a field of the lattice in the closed cells.
    pub(crate) fn gather(&self, field: &[f64]) -> Vec<f64> {
        self.cells.iter().map(|&n| field[n]).collect()
    }

    /// The field of the lattice with the values of the closed cells, and `outside` in the others.
    pub(crate) fn scatter(&self, values: &[f64], outside: f64) -> Vec<f64> {
        let mut field = vec![outside; self.lattice.cells()];
        for (&n, value) in self.cells.iter().zip(values) {
            field[n] = *value;
        }
        field
    }

    /// Smaller extent of the rectangle around the region \[m\].
    pub(crate) fn width(&self) -> f64 {
        let Lattice { rows, dx, dy, .. } = self.lattice;
        let range = |index: &dyn Fn(usize) -> usize| {
            let ends = self.cells.iter().map(|&n| index(n));
            let (low, high) =
                ends.fold((usize::MAX, 0), |(low, high), k| (low.min(k), high.max(k)));
            (high + 1).saturating_sub(low) as f64
        };
        let along_x = range(&|n| n / rows) * dx;
        if self.lattice.sealed == [true; 2] {
            return along_x;
        }
        let mirrored = self.lattice.sealed.iter().any(|sealed| *sealed);
        along_x.min(range(&|n| n % rows) * dy * if mirrored { 2.0 } else { 1.0 })
    }
}

/// Distance \[cells\] of the border from the centre of a closed cell, from the levels of this cell, of the open
/// cell next to it, and of the cell `beyond`:
///
/// ```text
/// theta = 1/2 + (theta_linear - 1/2) w,   theta_linear = L_0/(L_0 - L_1),   w = L_2/L_1 - 1, within 0 to 1
/// ```
///
/// A level that vanishes at theta and falls at least linearly has w = 1. A level that is flat outside
/// (w = 0) jumps between the cells, and linear interpolation would move the border by up to half a cell.
fn distance(closed: f64, open: f64, beyond: f64) -> f64 {
    let linear = closed / (closed - open);
    let slope = if open < 0.0 { beyond / open - 1.0 } else { 1.0 };
    HALF + (linear - HALF) * slope.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::{Lattice, Region, Side};

    /// Distances of both borders of a line of levels.
    fn borders(level: &[f64]) -> Vec<f64> {
        let region = Region::from_levels(Lattice::line(level.len(), 1.0), level);
        let border = |side: &Side| match side {
            Side::Border(theta) => Some(*theta),
            Side::Closed(_) | Side::Sealed => None,
        };
        region.sides.iter().flatten().filter_map(border).collect()
    }

    #[test]
    fn a_border_lies_where_the_level_vanishes_or_jumps() {
        // A level that vanishes 2.3 cells from the middle of cell 4.
        let slope: Vec<f64> = (0..9_i32)
            .map(|i| 2.3 - (f64::from(i) - 4.0).abs())
            .collect();
        assert!(
            borders(&slope)
                .iter()
                .all(|theta| (theta - 0.3).abs() < 1e-12)
        );
        // A flat pad, whose edges are steps of any height.
        for outside in [-1e-3, -1.0, -1e3] {
            let pad: Vec<f64> = (0..9)
                .map(|i| if (2..7).contains(&i) { 1.0 } else { outside })
                .collect();
            assert_eq!(borders(&pad), [0.5, 0.5]);
        }
    }
}
