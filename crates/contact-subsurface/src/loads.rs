//! Tractions as loads on the surface of one body.

use std::sync::LazyLock;

use contact_core::convolution::Tractions;
use contact_core::kernels::{DepthKernel, Quantity, SharedCorners};
use contact_core::scene::Grid;

use super::Side;

/// Depth in cells from which on point loads replace the uniform load of a cell. The error decays
/// like exp(-pi z/dx): 1e-11 of the stress of a cell, itself a hundredth of the traction.
pub(super) const DEEP: f64 = 8.0;
/// Neighbours on each side that share a cell's load.
const SHARING_CELLS: usize = 6;

/// How the load of a cell is applied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// Uniform on the cell.
    Cells,
    /// Point loads on the cell and its neighbours.
    Points,
}

impl Source {
    pub(super) const ALL: [Self; 2] = [Self::Cells, Self::Points];

    /// Place in [`Self::ALL`].
    pub(super) fn index(self) -> usize {
        usize::from(self == Self::Points)
    }

    /// Whether cells near the depth z act as cells or as points: the source to use there; `d` are the sides of
    /// the cells.
    pub(super) fn for_depth(z: f64, d: (f64, f64)) -> Self {
        if z < DEEP * d.0.max(d.1) {
            Self::Cells
        } else {
            Self::Points
        }
    }

    /// The responses to a unit source at the offsets (i dx, y), i < `cells`; `put` takes them with i. `corners`
    /// has the corners of the row before.
    pub(super) fn row<Q: Quantity<N, R>, const N: usize, const R: usize>(
        self,
        kernel: &DepthKernel<Q, N, R>,
        cells: usize,
        y: f64,
        d: (f64, f64),
        corners: &mut SharedCorners<R>,
        mut put: impl FnMut(usize, [[f64; 3]; R]),
    ) {
        match self {
            Self::Cells => {
                let offsets = (0..cells).map(|i| (i, i as f64));
                kernel.responses_to_cells(offsets, y, d, corners, put);
            }
            Self::Points => {
                let area = d.0 * d.1;
                for i in 0..cells {
                    let point = kernel.response_to_point(i as f64 * d.0, y);
                    put(i, point.map(|row| row.map(|v| area * v)));
                }
            }
        }
    }
}

/// A distance in cells, rounded to a whole number of half cells if within rounding errors of it, so
/// that a point on the border of a cell is recognised.
pub(super) fn snap_to_half_cells(cells: f64) -> f64 {
    let halves = (2.0 * cells).round() / 2.0;
    if (cells - halves).abs() < 1e-9 {
        halves
    } else {
        cells
    }
}

/// The weights of the point loads at -SHARING_CELLS to SHARING_CELLS cells.
///
/// A wave exp(i k x) averaged over a cell is sinc(k dx/2) times its middle value; with
/// s = sin(k dx/2) that is s/asin(s), a power series in s^2 = -delta^2/4, delta^2 being the second
/// difference (derived).
static WEIGHTS: LazyLock<[f64; 2 * SHARING_CELLS + 1]> = LazyLock::new(|| {
    // asin(s)/s = sum b_n s^2n, and a its inverse.
    let (mut a, mut b) = ([0.0; SHARING_CELLS + 1], [0.0; SHARING_CELLS + 1]);
    let mut central = 1.0;
    for n in 0..=SHARING_CELLS {
        let m = n as f64;
        b[n] = central / (2.0 * m + 1.0);
        central *= (2.0 * m + 1.0) / (2.0 * m + 2.0);
    }
    a[0] = 1.0;
    for n in 1..=SHARING_CELLS {
        a[n] = -(1..=n).map(|m| b[m] * a[n - m]).sum::<f64>();
    }
    let mut weights = [0.0; 2 * SHARING_CELLS + 1];
    let mut difference = [0.0; 2 * SHARING_CELLS + 1];
    difference[SHARING_CELLS] = 1.0;
    for (n, a) in a.iter().enumerate() {
        let scale = a * (-0.25_f64).powi(n as i32);
        for (w, d) in weights.iter_mut().zip(difference) {
            *w += scale * d;
        }
        let at = |i: Option<usize>| i.and_then(|i| difference.get(i)).copied().unwrap_or(0.0);
        difference =
            std::array::from_fn(|i| at(i.checked_sub(1)) - 2.0 * at(Some(i)) + at(Some(i + 1)));
    }
    weights
});

/// Length along y of a row of cells in plane strain, in lengths of the grid; the error of its
/// finite length is 1/STRIP of the stress.
const STRIP: f64 = 1e7;

/// Loaded columns and rows of a grid, the columns in the middle of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Patch {
    /// First column and row; may lie outside the grid.
    pub(super) start: (isize, isize),
    pub(super) columns: usize,
    pub(super) rows: usize,
}

/// Loads on a patch, q_x, q_y, p on a body in its own frame \[Pa\].
pub(super) struct Loads {
    pub(super) patch: Patch,
    /// (component, row, column)
    q: [Vec<f64>; 3],
}

/// The contact plane, with its axes exchanged or not.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    /// Cells along the lines and across them.
    pub(super) n: (usize, usize),
    pub(super) d: (f64, f64),
    exchanged: bool,
}

impl Plane {
    /// The grid as seen along its lines, which go along x, or along y if `exchanged`.
    pub(super) fn new(grid: &Grid, exchanged: bool) -> Self {
        let Grid { nx, ny, dx, .. } = *grid;
        let dy = if grid.plane_strain {
            STRIP * grid.extent().0
        } else {
            grid.dy
        };
        if exchanged {
            Self {
                n: (ny, nx),
                d: (dy, dx),
                exchanged,
            }
        } else {
            Self {
                n: (nx, ny),
                d: (dx, dy),
                exchanged,
            }
        }
    }

    /// Half of the extent across the lines \[m\].
    pub(super) fn half_width(&self) -> f64 {
        self.n.1 as f64 * self.d.1 / 2.0
    }

    /// Largest distance of a point above the grid from a load \[m\].
    pub(super) fn reach(&self) -> f64 {
        let length = |n: usize, d: f64| (n + 2 * SHARING_CELLS + 1) as f64 * d;
        length(self.n.0, self.d.0).hypot(length(self.n.1, self.d.1))
    }

    /// The tractions of a component (0 along the lines, 1 across, 2 normal).
    fn component<'a>(&self, tractions: &Tractions<'a>, component: usize) -> Option<&'a [f64]> {
        match (component, self.exchanged) {
            (0, false) | (1, true) => tractions.q_x,
            (0, true) | (1, false) => tractions.q_y,
            _ => tractions.p,
        }
    }

    /// Index of the cell in column i and row j in a field of shape (nx, ny).
    fn index(&self, i: usize, j: usize) -> usize {
        if self.exchanged {
            j * self.n.0 + i
        } else {
            i * self.n.1 + j
        }
    }

    /// The range of columns (symmetric to the middle) and rows that hold a load in any of the states.
    pub(super) fn loaded_patch(&self, states: &[Tractions<'_>], source: Source) -> Patch {
        let (columns, rows) = self.n;
        let (mut i0, mut i1, mut j0, mut j1) = (columns, 0, rows, 0);
        for state in states {
            for field in (0..3).filter_map(|c| self.component(state, c)) {
                for j in 0..rows {
                    for i in 0..columns {
                        if field[self.index(i, j)] != 0.0 {
                            (i0, i1) = (i0.min(i), i1.max(i + 1));
                            (j0, j1) = (j0.min(j), j1.max(j + 1));
                        }
                    }
                }
            }
        }
        if i0 >= i1 {
            // No load: one idle cell.
            (i0, i1, j0, j1) = (0, columns, 0, 1);
        }
        let margin = i0.min(columns - i1);
        let grow = if source == Source::Points {
            SHARING_CELLS
        } else {
            0
        };
        let widened = |start: usize| start as isize - grow as isize;
        Patch {
            start: (widened(margin), widened(j0)),
            columns: columns - 2 * margin + 2 * grow,
            rows: j1 - j0 + 2 * grow,
        }
    }

    /// Loads of one state on the body: tractions of cells, or forces at points shared with the neighbours, as
    /// the source needs.
    pub(super) fn loads(
        &self,
        tractions: &Tractions<'_>,
        side: Side,
        source: Source,
        patch: Patch,
    ) -> Loads {
        let q = std::array::from_fn(|component| {
            let mut q = vec![0.0; patch.columns * patch.rows];
            let Some(field) = self.component(tractions, component) else {
                return q;
            };
            let sign = if component < 2 { side.sign() } else { 1.0 };
            for (j, row) in q.chunks_mut(patch.columns).enumerate() {
                let j = j as isize + patch.start.1;
                if !(0..self.n.1 as isize).contains(&j) {
                    continue;
                }
                for (i, q) in row.iter_mut().enumerate() {
                    let i = i as isize + patch.start.0;
                    if (0..self.n.0 as isize).contains(&i) {
                        *q = sign * field[self.index(i as usize, j as usize)];
                    }
                }
            }
            if source == Source::Points {
                share_with_neighbours(&mut q, patch.columns);
            }
            q
        });
        Loads { patch, q }
    }
}

impl Loads {
    /// The loads of a component in a row.
    pub(super) fn row(&self, component: usize, j: usize) -> &[f64] {
        &self.q[component][j * self.patch.columns..][..self.patch.columns]
    }
}

/// Shares each cell's load with its neighbours along both axes; the patch has cells for them.
fn share_with_neighbours(q: &mut [f64], columns: usize) {
    let rows = q.len() / columns;
    let mut line = vec![0.0; columns.max(rows)];
    let weighted = |line: &[f64], i: usize| -> f64 {
        let from = i.saturating_sub(SHARING_CELLS);
        let to = (i + SHARING_CELLS + 1).min(line.len());
        let weights = &WEIGHTS[from + SHARING_CELLS - i..];
        line[from..to].iter().zip(weights).map(|(q, w)| q * w).sum()
    };
    for row in q.chunks_mut(columns) {
        line[..columns].copy_from_slice(row);
        for (i, q) in row.iter_mut().enumerate() {
            *q = weighted(&line[..columns], i);
        }
    }
    for i in 0..columns {
        for j in 0..rows {
            line[j] = q[j * columns + i];
        }
        for j in 0..rows {
            q[j * columns + i] = weighted(&line[..rows], j);
        }
    }
}
