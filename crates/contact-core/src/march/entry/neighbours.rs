//! The cells around a cell of the kept rows, mirror images included.

use crate::cells::Lattice;
use crate::cells::length;
use crate::kernels::Quadrant;
use crate::plan::Mirror;
use crate::scene::Grid;

/// Fewest cells whose neighbours are worth a task of their own.
pub(super) const TASK: usize = 256;

/// Offsets to the cells around a kept one.
pub(super) struct Neighbours {
    lattice: Lattice,
    /// Whether the cells are strips of plane strain.
    pub(super) flat: bool,
    /// Nearer ones first.
    ways: Vec<Way>,
}

/// An offset.
struct Way {
    columns: isize,
    rows: isize,
    /// Difference of the cell numbers, if the neighbour is not a mirror image.
    step: isize,
    off: [f64; 2],
    direction: [f64; 2],
    weight: f64,
    response: f64,
}

impl Way {
    /// Squared distance in cells.
    fn square(&self) -> isize {
        self.columns * self.columns + self.rows * self.rows
    }

    /// Whether the offset lies within `reach` + 1/2 cells.
    fn is_within(&self, reach: isize) -> bool {
        self.square() <= reach * reach + reach
    }
}

/// A cell near another one.
#[derive(Clone, Copy)]
pub(super) struct Neighbour {
    pub(super) cell: usize,
    /// Offset to it, in lengths of a cell.
    pub(super) off: [f64; 2],
    /// Squared offset, in columns and rows.
    pub(super) square: isize,
    /// Unit vector of the offset.
    pub(super) direction: [f64; 2],
    /// Its weight in a [`View`](super::view::View).
    pub(super) weight: f64,
    /// C(r)/C(0): u_z of the one under pressure on the other, over that under its own.
    pub(super) response: f64,
    /// Sign of its components along y: -1 of a mirror image.
    pub(super) sign: f64,
}

impl Neighbour {
    /// The pair seen from the other cell: offset and direction reversed.
    pub(super) fn back(&self) -> Self {
        let back = |[x, y]: [f64; 2]| [-x, -y * self.sign];
        Self {
            off: back(self.off),
            direction: back(self.direction),
            ..*self
        }
    }

    /// Distance of the neighbour from the cell, in sides of a cell.
    pub(super) fn distance(&self) -> f64 {
        length(self.off)
    }

    /// A weight that falls from 1 at the cell itself to 0 at the radius `reach` + 1/2.
    pub(super) fn nearness(&self, reach: isize) -> f64 {
        1.0 - self.square as f64 / (reach as f64 + 0.5).powi(2)
    }
}

impl Neighbours {
    /// Prepares the neighbours within `reach` + 1/2 cells on a grid, with the normal response C_zz = `kernel`
    /// \[m/Pa\].
    pub(super) fn new(grid: &Grid, mirror: Mirror, reach: isize, kernel: &Quadrant) -> Self {
        let unit = if grid.plane_strain {
            grid.dx
        } else {
            grid.cell_area().sqrt()
        };
        let lattice = Lattice::new(grid, mirror);
        let square = (-reach..=reach).flat_map(|x| (-reach..=reach).map(move |y| (x, y)));
        let offset = |(columns, rows): (isize, isize)| {
            let off = [
                columns as f64 * grid.dx / unit,
                rows as f64 * grid.dy / unit,
            ];
            let r = length(off).max(f64::MIN_POSITIVE);
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
        let mut offsets: Vec<Way> = square
            .map(offset)
            .filter(|way| way.is_within(reach))
            .collect();
        offsets.sort_by_key(Way::square);
        Self {
            lattice,
            flat: grid.plane_strain,
            ways: offsets,
        }
    }

    /// Yields cell n itself and its neighbours within `reach` + 1/2 cells, nearest first.
    pub(super) fn neighbours_within(
        &self,
        n: usize,
        reach: isize,
    ) -> impl Iterator<Item = Neighbour> {
        let (i, j) = self.lattice.column_and_row(n);
        let clear = self.lattice.is_clear(n, reach);
        let within = self.ways.partition_point(|way| way.is_within(reach));
        self.ways[..within].iter().filter_map(move |way| {
            let row = j + way.rows;
            let cell = if clear {
                (n as isize + way.step) as usize
            } else {
                self.lattice.stored_cell(i + way.columns, row)?
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
