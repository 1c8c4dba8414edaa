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

    /// The region of positive `level`, whose border lies where the level, linear between two
    /// centres, vanishes.
    pub fn from_levels(lattice: Lattice, level: &[f64]) -> Self {
        let cells: Vec<usize> = (0..lattice.cells()).filter(|&n| level[n] > 0.0).collect();
        let mut index = vec![usize::MAX; lattice.cells()];
        for (k, &n) in cells.iter().enumerate() {
            index[n] = k;
        }
        let Lattice { columns, rows, .. } = lattice;
        let side = |n: usize, next: Option<usize>, sealed: bool| match next {
            Some(m) if index[m] != usize::MAX => Side::Closed(index[m]),
            Some(m) => Side::Border((level[n] / (level[n] - level[m])).clamp(NEAREST, 1.0)),
            None if sealed => Side::Sealed,
            None => Side::Border(HALF),
        };
        let sides = cells.iter().map(|&n| {
            let (i, j) = (n / rows, n % rows);
            [
                side(n, (i > 0).then(|| n - rows), false),
                side(n, (i + 1 < columns).then(|| n + rows), false),
                side(n, (j > 0).then(|| n - 1), lattice.sealed[0]),
                side(n, (j + 1 < rows).then(|| n + 1), lattice.sealed[1]),
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
