//! The cells around a cell of the kept rows, mirror images included.

use crate::convolution::Mirror;
use crate::scene::Grid;
use crate::solvers::size;

/// Where the kept cells are, and the ways to the cells around one.
pub(super) struct Neighbours {
    /// Whether the cells are strips of plane strain.
    pub(super) flat: bool,
    columns: isize,
    rows: isize,
    mirror: Mirror,
    /// Nearer ones first.
    ways: Vec<Way>,
}

/// A way to a cell.
struct Way {
    columns: isize,
    rows: isize,
    /// What it adds to the number of a cell, mirror images apart.
    step: isize,
    off: [f64; 2],
    direction: [f64; 2],
    weight: f64,
}

impl Way {
    fn square(&self) -> isize {
        self.columns * self.columns + self.rows * self.rows
    }

    fn is_within(&self, reach: isize) -> bool {
        self.square() <= reach * reach + reach
    }
}

/// A cell near another one.
#[derive(Clone, Copy)]
pub(super) struct Neighbour {
    pub(super) cell: usize,
    /// The way to it, in lengths of a cell.
    pub(super) off: [f64; 2],
    /// Its square, in columns and rows.
    pub(super) square: isize,
    /// The direction of the way.
    pub(super) direction: [f64; 2],
    /// How much it counts in a [`View`](super::view::View).
    pub(super) weight: f64,
    /// What its components along y count as: it may be a mirror image.
    pub(super) sign: f64,
}

impl Neighbour {
    /// The way back.
    pub(super) fn back(&self) -> Self {
        let back = |[x, y]: [f64; 2]| [-x, -y * self.sign];
        Self {
            off: back(self.off),
            direction: back(self.direction),
            ..*self
        }
    }

    /// One, and falling to nothing beyond the reach.
    pub(super) fn nearness(&self, reach: isize) -> f64 {
        1.0 - self.square as f64 / (reach as f64 + 0.5).powi(2)
    }
}

impl Neighbours {
    /// Those of the kept cells of a grid, as far as `reach` cells and a half.
    pub(super) fn new(grid: &Grid, mirror: Mirror, reach: isize) -> Self {
        let unit = if grid.plane_strain {
            grid.dx
        } else {
            grid.cell_area().sqrt()
        };
        let kept_rows = mirror.rows(grid.ny) as isize;
        let square = (-reach..=reach).flat_map(|x| (-reach..=reach).map(move |y| (x, y)));
        let way = |(columns, rows): (isize, isize)| {
            let off = [
                columns as f64 * grid.dx / unit,
                rows as f64 * grid.dy / unit,
            ];
            let r = size(off).max(f64::MIN_POSITIVE);
            Way {
                columns,
                rows,
                step: columns * kept_rows + rows,
                off,
                direction: off.map(|off| off / r),
                weight: match (columns, rows) {
                    (0, 0) => 0.0,
                    _ if grid.plane_strain => r.powf(-1.25),
                    _ => r.powf(-2.25),
                },
            }
        };
        let mut ways: Vec<Way> = square.map(way).filter(|way| way.is_within(reach)).collect();
        ways.sort_by_key(Way::square);
        Self {
            flat: grid.plane_strain,
            columns: grid.nx as isize,
            rows: kept_rows,
            mirror,
            ways,
        }
    }

    /// Cell n and those not further from it than `reach` cells and a half.
    pub(super) fn of(&self, n: usize, reach: isize) -> impl Iterator<Item = Neighbour> {
        let (i, j) = (n as isize / self.rows, n as isize % self.rows);
        let clear = |k: isize, of: isize| (reach..of - reach).contains(&k);
        let clear = clear(i, self.columns) && clear(j, self.rows);
        let near = self.ways.iter().take_while(move |way| way.is_within(reach));
        near.filter_map(move |way| {
            let (cell, sign) = if clear {
                ((n as isize + way.step) as usize, 1.0)
            } else {
                self.kept(i + way.columns, j + way.rows)?
            };
            Some(Neighbour {
                cell,
                off: way.off,
                square: way.square(),
                direction: way.direction,
                weight: way.weight,
                sign,
            })
        })
    }

    /// The kept cell in a column and row, or that it is the image of, and the sign of its components
    /// along y.
    fn kept(&self, column: isize, row: isize) -> Option<(usize, f64)> {
        let (row, sign) = match self.mirror {
            Mirror::Y if row < 0 => (-1 - row, -1.0),
            _ => (row, 1.0),
        };
        let inside = (0..self.columns).contains(&column) && (0..self.rows).contains(&row);
        inside.then_some(((column * self.rows + row) as usize, sign))
    }
}
