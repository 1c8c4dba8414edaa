//! The cells around a cell of the kept rows, mirror images included.

use crate::cells::Lattice;
use crate::cells::size;
use crate::kernels::Quadrant;
use crate::plan::Mirror;
use crate::scene::Grid;

/// Fewest cells whose neighbours are worth a task of their own.
pub(super) const TASK: usize = 256;

/// The ways to the cells around a kept one.
pub(super) struct Neighbours {
    lattice: Lattice,
    /// Whether the cells are strips of plane strain.
    pub(super) flat: bool,
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
    response: f64,
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
    /// Its weight in a [`View`](super::view::View).
    pub(super) weight: f64,
    /// The response u_z of one to pressure on the other, over that to its own.
    pub(super) response: f64,
    /// Sign of its components along y: -1 of a mirror image.
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

    /// In lengths of a cell.
    pub(super) fn distance(&self) -> f64 {
        size(self.off)
    }

    /// A weight that falls from one to zero at the radius.
    pub(super) fn nearness(&self, reach: isize) -> f64 {
        1.0 - self.square as f64 / (reach as f64 + 0.5).powi(2)
    }
}

impl Neighbours {
    /// Those of the kept cells of a grid, as far as `reach` cells and a half, where C_zz is `kernel` \[m/Pa\].
    pub(super) fn new(grid: &Grid, mirror: Mirror, reach: isize, kernel: &Quadrant) -> Self {
        let unit = if grid.plane_strain {
            grid.dx
        } else {
            grid.cell_area().sqrt()
        };
        let lattice = Lattice::new(grid, mirror);
        let square = (-reach..=reach).flat_map(|x| (-reach..=reach).map(move |y| (x, y)));
        let way = |(columns, rows): (isize, isize)| {
            let off = [
                columns as f64 * grid.dx / unit,
                rows as f64 * grid.dy / unit,
            ];
            let r = size(off).max(f64::MIN_POSITIVE);
            let quadrant = (columns.unsigned_abs(), rows.unsigned_abs());
            Way {
                columns,
                rows,
                step: lattice.step(columns, rows),
                off,
                direction: off.map(|off| off / r),
                weight: match (columns, rows) {
                    (0, 0) => 0.0,
                    _ if grid.plane_strain => r.powf(-1.25),
                    _ => r.powf(-2.25),
                },
                response: kernel.get(quadrant).map_or(0.0, |c| c / kernel[(0, 0)]),
            }
        };
        let mut ways: Vec<Way> = square.map(way).filter(|way| way.is_within(reach)).collect();
        ways.sort_by_key(Way::square);
        Self {
            lattice,
            flat: grid.plane_strain,
            ways,
        }
    }

    /// Cell n and those not further from it than `reach` cells and a half.
    pub(super) fn of(&self, n: usize, reach: isize) -> impl Iterator<Item = Neighbour> {
        let (i, j) = self.lattice.place(n);
        let clear = self.lattice.is_clear(n, reach);
        let near = self.ways.iter().take_while(move |way| way.is_within(reach));
        near.filter_map(move |way| {
            let row = j + way.rows;
            let cell = if clear {
                (n as isize + way.step) as usize
            } else {
                self.lattice.kept(i + way.columns, row)?
            };
            Some(Neighbour {
                cell,
                off: way.off,
                square: way.square(),
                direction: way.direction,
                weight: way.weight,
                response: way.response,
                sign: if row < 0 { -1.0 } else { 1.0 },
            })
        })
    }
}
