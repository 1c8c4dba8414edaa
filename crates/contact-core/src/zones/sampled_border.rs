//! A field of levels of a zone and the cells around it.

use ndarray::Array2;

use super::edge::Edge;
use super::laws::Power;
use super::level::{Stencil, agree};
use super::neighbours::cell_and_neighbours;
use crate::cells::Lattice;
use crate::plan::Mirror;
use crate::scene::Grid;

/// Smallest number of neighbours with an extrapolated level from which the level of a cell outside is averaged
/// if it cannot be extrapolated itself.
const FEWEST_NEIGHBOURS: usize = 4;

/// A level sampled at the cells: positive inside a zone, negative outside.
pub(super) struct SampledBorder {
    pub(super) level: Array2<f64>,
    /// Cells at the border with an extrapolated level, and those without.
    pub(super) known: Vec<(usize, usize)>,
    pub(super) unknown: Vec<(usize, usize)>,
}

impl SampledBorder {
    /// The border of the contact, with the level p^2 \[Pa^2\].
    pub(super) fn of_contact(grid: &Grid, p: &Array2<f64>) -> Self {
        let contact: Vec<bool> = p.iter().map(|&p| p > 0.0).collect();
        let level = p.mapv(|p| p.max(0.0).powi(2));
        let edges = Lattice::new(grid, Mirror::None).edges(&contact, [Stencil::ROOT], |_| {
            ([Power::Two], |n: usize| p[(n / grid.ny, n % grid.ny)])
        });
        Self::new(&level, &edges)
    }

    /// Builds the border from the levels `own` of the cells of a zone; cells at the border get the extrapolated level.
    pub(super) fn new(own: &Array2<f64>, edges: &[(usize, Edge)]) -> Self {
        let planes = Planes::new(own, edges);
        let mut level = own.clone();
        let (mut known, mut unknown) = (Vec::new(), Vec::new());
        for (cell, plane) in planes.cells() {
            let (mean, count) = planes.mean_around(cell);
            match plane {
                Some(plane) => level[cell] = plane.middle,
                None if own[cell] <= 0.0 && count >= FEWEST_NEIGHBOURS => level[cell] = mean,
                None => {
                    unknown.push(cell);
                    continue;
                }
            }
            known.push(cell);
        }
        // A cell of the zone whose centre lies outside makes the next one inwards the outermost: its
        // own level is wrong, too.
        for (n, edge) in edges {
            let cell = planes.cell_of(*n);
            let Some(level_at_edge) = edge.level.filter(|found| found.middle < 0.0) else {
                continue;
            };
            let ([columns, rows], next) = level_at_edge.next_inwards();
            let inner = (
                (cell.0 as f64 + columns) as usize,
                (cell.1 as f64 + rows) as usize,
            );
            let is_inner = own.get(inner).is_some_and(|own| *own > 0.0);
            if own[cell] > 0.0 && is_inner && planes.find(inner).is_none() {
                let plane = Plane {
                    middle: next,
                    slope: level_at_edge.gradient,
                };
                if planes.agrees_with_own(inner, plane) {
                    level[inner] = next;
                }
            }
        }
        Self {
            level,
            known,
            unknown,
        }
    }
}

/// A level around a cell, linear.
#[derive(Clone, Copy)]
struct Plane {
    /// Value in the middle of the cell.
    middle: f64,
    /// Its gradient per cell along x and y.
    slope: [f64; 2],
}

/// The levels extrapolated to the cells at a border; dropped where they disagree with `own`.
struct Planes<'a> {
    own: &'a Array2<f64>,
    edges: &'a [(usize, Edge)],
    planes: Vec<Option<Plane>>,
}

impl<'a> Planes<'a> {
    /// The planes of the extrapolated levels, where they agree with the cells' own levels.
    fn new(own: &'a Array2<f64>, edges: &'a [(usize, Edge)]) -> Self {
        let mut planes_without_check = Self {
            own,
            edges,
            planes: Vec::new(),
        };
        let plane = |(n, edge): &(usize, Edge)| {
            let level = edge.level?;
            let plane = Plane {
                middle: level.middle,
                slope: level.gradient,
            };
            planes_without_check
                .agrees_with_own(planes_without_check.cell_of(*n), plane)
                .then_some(plane)
        };
        let planes = edges.iter().map(plane).collect();
        planes_without_check.planes = planes;
        planes_without_check
    }

    /// Column and row of a cell.
    fn cell_of(&self, n: usize) -> (usize, usize) {
        let rows = self.own.ncols();
        (n / rows, n % rows)
    }

    /// The cells at the border.
    fn cells(&self) -> impl Iterator<Item = ((usize, usize), Option<Plane>)> {
        let cells = self.edges.iter().map(|(n, _)| self.cell_of(*n));
        cells.zip(self.planes.iter().copied())
    }

    /// Index of a cell among the border cells.
    fn find(&self, (i, j): (usize, usize)) -> Option<usize> {
        let n = i * self.own.ncols() + j;
        self.edges.binary_search_by_key(&n, |(n, _)| *n).ok()
    }

    /// Whether the level of a plane in a cell agrees with the level that the cell has itself.
    fn agrees_with_own(&self, cell: (usize, usize), plane: Plane) -> bool {
        agree(plane.middle, plane.slope, self.own[cell])
    }

    /// The mean level of a cell by the planes of its neighbours, and their number.
    fn mean_around(&self, cell: (usize, usize)) -> (f64, usize) {
        let levels: Vec<f64> = cell_and_neighbours(cell, self.own.dim())
            .filter_map(|at| {
                let plane = self.planes[self.find(at)?]?;
                let offset = [cell.0 as f64 - at.0 as f64, cell.1 as f64 - at.1 as f64];
                let middle = plane.middle + plane.slope[0] * offset[0] + plane.slope[1] * offset[1];
                self.agrees_with_own(cell, Plane { middle, ..plane })
                    .then_some(middle)
            })
            .collect();
        let mean = levels.iter().sum::<f64>() / levels.len().max(1) as f64;
        (mean, levels.len())
    }
}
