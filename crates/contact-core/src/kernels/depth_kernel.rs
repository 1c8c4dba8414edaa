//! The response at one depth as a function of the offset from a loaded cell.
//!
//! In the outermost layer it is the response of a half-space of its material, in closed form, plus a
//! remainder that decays like exp(-k (2h - z)); below it all of the response decays like exp(-k z). The
//! decaying part is tabulated over the radius and integrated over the cell.

use std::f64::consts::TAU;
use std::marker::PhantomData;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ndarray::Array2;
use rayon::prelude::*;

use super::Quadrant;
use super::cell::Cell;
use super::depth_frf::DepthPoint;
use super::depth_tables::{self, Smooth};
use super::layered_frf::{HalfSpace, Stack};
use super::quantity::Quantity;
use crate::error::Error;
use crate::stop::unless;

/// Relative error of a cell's Gauss rule, against the response under the load.
const CUBATURE: f64 = 1e-13;

/// A quantity at a depth.
pub struct DepthKernel<Q, const N: usize, const R: usize> {
    pub(crate) place: DepthPoint,
    /// The outermost material where its closed form takes part.
    closed: Option<HalfSpace>,
    /// The tabulated part and its smallest scale \[m\].
    smooth: Option<Arc<Smooth<N>>>,
    /// Distance along x and along y that a point on the edge of a cell is taken to have from it
    /// \[m\].
    edge: (f64, f64),
    quantity: PhantomData<Q>,
}

impl<Q: Quantity<N, R>, const N: usize, const R: usize> DepthKernel<Q, N, R> {
    /// Builds the kernel for offsets up to `r_max` \[m\] from loads on cells of the sides `d` \[m\].
    ///
    /// A step of the traction at an edge between cells has infinite stress on the edge. The stress of a
    /// traction that changes evenly from cell to cell is finite there, and equals the stress of the steps at
    /// the distance e = d/(2 pi) from the edge. Steps g d at k d from the point make
    /// 1/s into g d [ln(d/e) + 2 sum (k + 1/2) ln((k + 1)/k)]; the
    /// traction g s gives g d [2 + 2 sum 1]. Both are equal for ln(d/e) = 2 - 2 (1 - ln(2 pi)/2) = ln(2 pi)
    /// by Stirling's formula.
    pub fn new(stack: &Stack, place: DepthPoint, r_max: f64, d: (f64, f64)) -> Result<Self, Error> {
        let outermost = place.layer == 0;
        let smooth = if stack.layers.is_empty() {
            None
        } else {
            Some(depth_tables::table::<Q, N, R>(stack, place, r_max)?)
        };
        Ok(Self {
            place,
            closed: outermost.then(|| stack.outermost()),
            smooth,
            edge: (d.0 / TAU, d.1 / TAU),
            quantity: PhantomData,
        })
    }

    /// Tabulates the kernels at several depths for [`Self::new`] with the same distance. One recursion
    /// over the layers serves many depths.
    pub fn prepare(stack: &Stack, places: &[DepthPoint], r_max: f64) -> Result<(), Error> {
        if stack.layers.is_empty() {
            return Ok(());
        }
        depth_tables::prepare::<Q, N, R>(stack, places, r_max).map(drop)
    }

    /// Adds the tabulated part of the response at the origin to unit traction on the cell, integrated over the
    /// cell, to `sum`.
    fn add_smooth(&self, sum: &mut [[f64; 3]; R], cell: &Cell) {
        let Some(smooth) = &self.smooth else { return };
        let Smooth { table, zeta } = &**smooth;
        cell.nodes_of_parts(*zeta, CUBATURE, &mut |x, y, w| {
            Q::add(sum, x, y, table.evaluate(x * x + y * y).map(|g| w * g));
        });
    }

    /// The response at the offset of the cell's middle to unit traction on the cell.
    pub fn response_to_cell(&self, cell: &Cell) -> [[f64; 3]; R] {
        let mut sum = [[0.0; 3]; R];
        if let Some(material) = &self.closed {
            let (x0, x1) = (cell.x - cell.half_x, cell.x + cell.half_x);
            let (y0, y1) = (cell.y - cell.half_y, cell.y + cell.half_y);
            let corner = |x, y| Q::corner(material, (x, y, self.place.z), self.edge);
            sum = corner_difference(
                &corner(x1, y1),
                &corner(x0, y1),
                &corner(x1, y0),
                &corner(x0, y0),
            );
        }
        self.add_smooth(&mut sum, cell);
        sum
    }

    /// The responses to unit traction on cells of the sides `d` at an offset y and at offsets along
    /// x, in cells and a cell apart, each with its index. `corners` keeps the corners of the row before.
    pub fn responses_to_cells(
        &self,
        cells: impl Iterator<Item = (usize, f64)>,
        y: f64,
        d: (f64, f64),
        corners: &mut SharedCorners<R>,
        mut put: impl FnMut(usize, [[f64; 3]; R]),
    ) {
        corners.start_row(y, d.1);
        for (i, x) in cells {
            let mut sum = match self.closed {
                Some(material) => corners.difference(x, |x, y| {
                    Q::corner(&material, (x * d.0, y, self.place.z), self.edge)
                }),
                None => [[0.0; 3]; R],
            };
            let cell = Cell {
                x: x * d.0,
                y,
                half_x: d.0 / 2.0,
                half_y: d.1 / 2.0,
            };
            self.add_smooth(&mut sum, &cell);
            put(i, sum);
        }
    }

    /// The response at the offset (x, y) from unit forces; not on the surface.
    pub fn response_to_point(&self, x: f64, y: f64) -> [[f64; 3]; R] {
        let s = x * x + y * y;
        let mut g = match &self.closed {
            Some(material) => Q::radial(material, s, self.place.z),
            None => [0.0; N],
        };
        if let Some(smooth) = &self.smooth {
            for (g, t) in g.iter_mut().zip(smooth.table.evaluate(s)) {
                *g += t;
            }
        }
        let mut sum = [[0.0; 3]; R];
        Q::add(&mut sum, x, y, g);
        sum
    }
}

/// Distance of two edges by rounding alone, over the width of a cell.
const SAME_EDGE: f64 = 1e-9;

/// Values at the corners of a row of cells. Neighbours share them, in the row and in the next one.
pub struct SharedCorners<const R: usize> {
    /// Offset along x of the first corner \[cells\].
    first: f64,
    /// The lower and the upper edge of the row.
    edges: [Edge<R>; 2],
}

/// Corners on a line across the cells; empty where nothing asked for them.
struct Edge<const R: usize> {
    y: f64,
    corners: Vec<Option<[[f64; 3]; R]>>,
}

impl<const R: usize> SharedCorners<R> {
    /// For so many cells, of which the first has this offset along x \[cells\], and no other a smaller
    /// one.
    pub fn new(first: f64, cells: usize) -> Self {
        let edge = || Edge {
            y: f64::NAN,
            corners: vec![None; cells + 1],
        };
        Self {
            first: first - 0.5,
            edges: [edge(), edge()],
        }
    }

    /// Begins a row at the offset y of cells with the width d_y; an edge of the row before is kept.
    fn start_row(&mut self, y: f64, d_y: f64) {
        let edges = [y - d_y / 2.0, y + d_y / 2.0];
        // Rows on both sides of a place, folded onto one, may have edges close to each other.
        let is_at = |edge: &Edge<R>, y: f64| (edge.y - y).abs() < SAME_EDGE * d_y;
        let [low, high] = &self.edges;
        if is_at(low, edges[1]) || is_at(high, edges[0]) {
            self.edges.swap(0, 1);
        }
        for (edge, y) in self.edges.iter_mut().zip(edges) {
            if !is_at(edge, y) {
                edge.corners.fill(None);
                edge.y = y;
            }
        }
    }

    /// The difference of the four corners of the cell at an offset x \[cells\]. `corner` has the value
    /// at x in cells and y in m.
    fn difference(&mut self, x: f64, corner: impl Fn(f64, f64) -> [[f64; 3]; R]) -> [[f64; 3]; R] {
        let first = (x - 0.5 - self.first).round() as usize;
        let [low, high] = &mut self.edges;
        for edge in [&mut *low, &mut *high] {
            for (k, x) in [(first, x - 0.5), (first + 1, x + 0.5)] {
                edge.corners[k].get_or_insert_with(|| corner(x, edge.y));
            }
        }
        match (
            &high.corners[first..first + 2],
            &low.corners[first..first + 2],
        ) {
            ([Some(low_x), Some(both)], [Some(opposite), Some(low_y)]) => {
                corner_difference(both, low_x, low_y, opposite)
            }
            _ => unreachable!("all four have just been inserted"),
        }
    }
}

/// f(x, y) - f(x', y) - f(x, y') + f(x', y'): the integral over a rectangle from the values f at its corners,
/// the last three arguments being those with low x, low y, or both low.
fn corner_difference<const R: usize>(
    both: &[[f64; 3]; R],
    low_x: &[[f64; 3]; R],
    low_y: &[[f64; 3]; R],
    low: &[[f64; 3]; R],
) -> [[f64; 3]; R] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| (both[i][j] - low_x[i][j]) - (low_y[i][j] - low[i][j]))
    })
}

/// The responses to unit traction on cells of the sides `d` at the offsets (i dx, j dy), i and j
/// below `n`. For square cells, exchange of the axes gives one octant from the other. Fails
/// when `stop` is raised.
pub(crate) fn quadrants<Q: Quantity<N, R> + Sync, const N: usize, const R: usize>(
    kernel: &DepthKernel<Q, N, R>,
    n: (usize, usize),
    d: (f64, f64),
    stop: &AtomicBool,
) -> Result<[[Quadrant; 3]; R], Error> {
    let is_square = d.0.to_bits() == d.1.to_bits();
    let square = if is_square { n.0.min(n.1) } else { 0 };
    // Row j holds i >= j of the square and all beyond it.
    let is_mirrored = |i: usize, j: usize| i < j && j < square;
    let rows: Vec<Vec<[[f64; 3]; R]>> = (0..n.1)
        .into_par_iter()
        .map(|j| {
            unless(stop)?;
            let first = if j < square { j } else { 0 };
            let cells = first..n.0;
            let mut row = Vec::with_capacity(cells.len());
            let mut corners = SharedCorners::new(first as f64, cells.len());
            let cells = cells.map(|i| (i, i as f64));
            let y = j as f64 * d.1;
            kernel.responses_to_cells(cells, y, d, &mut corners, |_, s| row.push(s));
            Ok(row)
        })
        .collect::<Result<_, Error>>()?;
    let entry = |row: usize, column: usize| {
        let odd = Q::is_odd(row, column);
        let (transposed_row, transposed_column) = Q::transposed(row, column);
        Array2::from_shape_fn(n, |(i, j)| {
            let vanishes = odd.0 && i == 0 || odd.1 && j == 0;
            if vanishes {
                0.0
            } else if is_mirrored(i, j) {
                rows[i][j - i][transposed_row][transposed_column]
            } else {
                let first = if j < square { j } else { 0 };
                rows[j][i - first][row][column]
            }
        })
    };
    Ok(std::array::from_fn(|row| {
        std::array::from_fn(|column| entry(row, column))
    }))
}
