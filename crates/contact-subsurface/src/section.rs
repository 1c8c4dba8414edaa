//! Lines at any depths below a straight line on the surface.

use contact_core::Error;
use contact_core::kernels::{DepthKernel, Displacement, Quantity, Stress};
use contact_core::scene::{Body, Grid};
use ndarray::{Array2, Array3, ArrayView1};
use rayon::prelude::*;

use super::continuation::{check_line, line_window, locate_cell};
use super::counters::count_on_grids;
use super::line_transform::LineTransform;
use super::loads::{Plane, Source};
use super::states::Loaded;
use super::{Depth, Line, Point, Points, Side, States};

/// Stress and displacement below a line, at its places on the grid ([`Line::places`]).
pub struct Section {
    method: Method,
    states: usize,
    places: usize,
}

/// Method of computation of the lines.
enum Method {
    /// Along rows or columns of cells, by transforms.
    Rows(Box<Rows>),
    /// Point by point, in any direction: the points x, y \[m\].
    Points(Box<Points>, Vec<(f64, f64)>),
}

/// Lines along an axis.
struct Rows {
    loaded: Loaded,
    line: Line,
    /// x, y of the places along it \[m\].
    places: Vec<(f64, f64)>,
    plane: Plane,
    /// For loads on cells and for point loads; the latter may serve all depths asked for.
    rows: [LineTransform; 2],
}

impl Section {
    /// Prepares the stress on the section below `line`, in the body `side`, under each of the `states`.
    pub fn new<'a>(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Line,
        states: impl Into<States<'a>>,
    ) -> Result<Self, Error> {
        let states = states.into();
        let (count, places) = (states.tractions.len(), line.places(grid));
        let method = match line {
            Line::Through { .. } => {
                check_line(grid, line)?;
                let points = Points::new(body, side, grid, states)?;
                Method::Points(
                    Box::new(points),
                    places.iter().map(|s| line.place(*s)).collect(),
                )
            }
            _ => Method::Rows(Box::new(Rows::new(body, side, grid, line, &states)?)),
        };
        Ok(Self {
            method,
            states: count,
            places: places.len(),
        })
    }

    /// Stress of each state \[Pa\], shape (6, depths, cells along the line): xx, yy, zz, xy, xz,
    /// yz.
    pub fn stress(&self, depths: &[Depth]) -> Result<Vec<Array3<f64>>, Error> {
        self.tabulate_kernels::<Stress, 10, 6>(depths)?;
        self.gather::<6>(depths, |depth| self.stress_at(depth))
    }

    /// Displacement of each state relative to infinity \[m\], shape (3, depths, cells along the
    /// line).
    pub fn displacement(&self, depths: &[Depth]) -> Result<Vec<Array3<f64>>, Error> {
        self.tabulate_kernels::<Displacement, 5, 3>(depths)?;
        self.gather::<3>(depths, |depth| match &self.method {
            Method::Rows(rows) => rows.displacement_at(depth),
            Method::Points(points, places) => points
                .displacement(&points_at_depth(places, depth))
                .map(to_arrays),
        })
    }

    /// Hands the stresses of all states on each line, of shape (6, cells along the line), to `f`
    /// as soon as they are known, with the accumulator of that depth; depths in parallel.
    pub fn pass_stress<T: Send>(
        &self,
        depths: &[Depth],
        kept: &mut [T],
        f: impl Fn(&mut T, Depth, &[Array2<f64>]) + Sync,
    ) -> Result<(), Error> {
        self.tabulate_kernels::<Stress, 10, 6>(depths)?;
        depths.par_iter().zip(kept).try_for_each(|(depth, kept)| {
            f(kept, *depth, &self.stress_at(*depth)?);
            Ok(())
        })
    }

    /// Tabulates, in one go, the kernels that the line needs at all these depths.
    fn tabulate_kernels<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        depths: &[Depth],
    ) -> Result<(), Error> {
        match &self.method {
            Method::Rows(rows) => {
                let reach = rows.plane.reach();
                rows.loaded.tabulate_kernels::<Q, N, R>(depths, reach)
            }
            Method::Points(points, places) => {
                let farthest = places.iter().map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
                points.tabulate_kernels::<Q, N, R>(depths, farthest)
            }
        }
    }

    /// The lines at all depths, by state.
    fn gather<const R: usize>(
        &self,
        depths: &[Depth],
        lines: impl Fn(Depth) -> Result<Vec<Array2<f64>>, Error> + Sync,
    ) -> Result<Vec<Array3<f64>>, Error> {
        let lines: Vec<_> = depths
            .par_iter()
            .map(|depth| lines(*depth))
            .collect::<Result<_, _>>()?;
        let of_state = |state: usize| {
            Array3::from_shape_fn((R, depths.len(), self.places), |(r, depth, i)| {
                lines[depth][state][(r, i)]
            })
        };
        Ok((0..self.states).map(of_state).collect())
    }

    /// The stress of all states at one depth, each of shape (6, places along the line).
    fn stress_at(&self, depth: Depth) -> Result<Vec<Array2<f64>>, Error> {
        match &self.method {
            Method::Rows(rows) => rows.stress_at(depth),
            Method::Points(points, places) => points
                .stress(&points_at_depth(places, depth))
                .map(to_arrays),
        }
    }
}

/// Points at a depth.
fn points_at_depth(places: &[(f64, f64)], depth: Depth) -> Vec<Point> {
    places.iter().map(|&(x, y)| (x, y, depth)).collect()
}

/// Converts values at points, for each state, to arrays of shape (R, points).
fn to_arrays<const R: usize>(of_states: Vec<Vec<[f64; R]>>) -> Vec<Array2<f64>> {
    let line =
        |values: Vec<[f64; R]>| Array2::from_shape_fn((R, values.len()), |(row, n)| values[n][row]);
    of_states.into_iter().map(line).collect()
}

impl Rows {
    /// Prepares a section below a line along an axis: transforms of the loads for cells and for points, and the
    /// tractions near rims.
    fn new(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Line,
        states: &States<'_>,
    ) -> Result<Self, Error> {
        check_line(grid, line)?;
        let (x, y) = line.place(0.0);
        let distance = match line {
            Line::AlongY(_) => x,
            _ => y,
        };
        let window = || Ok(line_window(line, grid));
        let loaded = Loaded::new(body, side, grid, states, window)?;
        let plane = Plane::new(grid, matches!(line, Line::AlongY(_)));
        let [cells, points] = Source::ALL.map(|source| {
            LineTransform::new(
                &plane,
                side,
                distance,
                states.tractions,
                source,
                &states.stop,
            )
        });
        let along = line.places(grid).into_iter();
        Ok(Self {
            loaded,
            places: along.map(|s| line.place(s)).collect(),
            line,
            plane,
            rows: [cells?, points?],
        })
    }

    /// The displacement of all states at one depth, each of shape (3, cells along the line).
    fn displacement_at(&self, depth: Depth) -> Result<Vec<Array2<f64>>, Error> {
        let kernel = self
            .loaded
            .kernel::<Displacement, 5, 3>(depth, self.plane.reach())?;
        self.lines_at(&kernel, depth)
    }

    /// The stress of all states at one depth, each of shape (6, cells along the line).
    fn stress_at(&self, depth: Depth) -> Result<Vec<Array2<f64>>, Error> {
        let kernel = self
            .loaded
            .kernel::<Stress, 10, 6>(depth, self.plane.reach())?;
        let mut lines = self.lines_at(&kernel, depth)?;
        count_on_grids(self.places.len(), lines.len());
        self.add_rim(&kernel, depth, &mut lines);
        for (state, line) in lines.iter_mut().enumerate() {
            let uniform = self.loaded.uniform(state, depth);
            for (mut row, uniform) in line.rows_mut().into_iter().zip(uniform) {
                row += uniform;
            }
            for (at, mut stress) in self.places.iter().zip(line.columns_mut()) {
                let Some(residual) = self.loaded.eigenstress_at(state, *at, depth) else {
                    break;
                };
                stress += &ArrayView1::from(&residual);
            }
        }
        Ok(lines)
    }

    /// Adds the correction of [`NearRim`] to the stress of all states at a depth.
    fn add_rim(
        &self,
        kernel: &DepthKernel<Stress, 10, 6>,
        depth: Depth,
        lines: &mut [Array2<f64>],
    ) {
        let Some(rim) = &self.loaded.rim else { return };
        let grid = &self.loaded.grid;
        let (x, y) = self.line.place(match self.line {
            Line::AlongY(_) => grid.y(0),
            _ => grid.x(0),
        });
        let (first, offset) = locate_cell(grid, x, y);
        let Some(parts) = rim.parts(kernel, depth, offset) else {
            return;
        };
        for (state, line) in lines.iter_mut().enumerate() {
            for (n, mut stress) in line.columns_mut().into_iter().enumerate() {
                let cell = match self.line {
                    Line::AlongY(_) => (first.0, n),
                    _ => (n, first.1),
                };
                if rim.is_near(state, depth, cell) {
                    let mut with_rim = std::array::from_fn(|c| stress[c]);
                    rim.add_correction(&parts, state, cell, &mut with_rim);
                    stress.assign(&ArrayView1::from(&with_rim));
                }
            }
        }
    }

    /// The lines of all states at one depth, each of shape (R, cells along the line).
    fn lines_at<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        kernel: &DepthKernel<Q, N, R>,
        depth: Depth,
    ) -> Result<Vec<Array2<f64>>, Error> {
        let source = Source::for_depth(depth.z, self.plane.d);
        let rows = &self.rows[source.index()];
        let shape = (self.loaded.states, self.plane.n.0);
        let in_body_frame = rows.convolve(kernel, self.plane.d, shape, &self.loaded.stop)?;
        let exchanged = matches!(self.line, Line::AlongY(_));
        let to_scene_axes = |in_body_frame: Array2<f64>| {
            Array2::from_shape_fn(in_body_frame.dim(), |(row, i)| {
                let row_of = if exchanged {
                    Q::transposed(row, 0).0
                } else {
                    row
                };
                // A component with one index z changes its sign between the bodies.
                let sign = if Q::has_one_z(row) {
                    self.loaded.side.sign()
                } else {
                    1.0
                };
                sign * in_body_frame[(row_of, i)]
            })
        };
        Ok(in_body_frame.into_iter().map(to_scene_axes).collect())
    }
}
