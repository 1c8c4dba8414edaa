//! Single points, by summation over the loaded cells; all states share the kernel's values.

use std::collections::BTreeMap;

use contact_core::Error;
use contact_core::kernels::{DepthKernel, Displacement, Quantity, SharedCorners};
use contact_core::scene::{Body, Grid};
use contact_core::stop::unless;
use rayon::prelude::*;

use super::continuation::{Window, check_line, line_window, locate_cell};
use super::counters::count_at_points;
use super::loads::{Loads, Patch, Plane, Source, snap_to_half_cells};
use super::states::Loaded;
use super::{Border, Depth, Line, Point, Side, States};

/// Most distance of a point from the middle of the grid, over the reach of the grid.
const FARTHEST: f64 = 1e6;

/// Stress and displacement at single points; each costs one kernel value per cell that is loaded in
/// any state.
pub struct Points {
    loaded: Loaded,
    plane: Plane,
    /// Loads of all states, on cells and as point loads, on the patch that holds them.
    loads: [LoadedCells; 2],
    patches: [Patch; 2],
}

/// Loads of all states cell by cell, so that the sums over the states run through memory in order.
struct LoadedCells {
    /// Place among the loaded cells by cell of the patch, row by row; `None` without a load.
    cells: Vec<Option<usize>>,
    /// q_x, q_y, p of every state in every loaded cell \[Pa\].
    tractions: Vec<[f64; 3]>,
}

impl LoadedCells {
    fn new(loads: &[Loads], patch: Patch) -> Self {
        let mut cells = Vec::with_capacity(patch.columns * patch.rows);
        let mut tractions = Vec::new();
        let mut count = 0;
        for j in 0..patch.rows {
            let rows = loads.iter().map(|load| [0, 1, 2].map(|c| load.row(c, j)));
            let rows: Vec<_> = rows.collect();
            for i in 0..patch.columns {
                let is_loaded = rows.iter().flatten().any(|row| row[i] != 0.0);
                cells.push(is_loaded.then_some(count));
                if is_loaded {
                    count += 1;
                    tractions.extend(rows.iter().map(|rows| rows.map(|row| row[i])));
                }
            }
        }
        Self { cells, tractions }
    }
}

impl Points {
    /// Sets up the body `side` under each of the `states`.
    pub fn new<'a>(
        body: &Body,
        side: Side,
        grid: &Grid,
        states: impl Into<States<'a>>,
    ) -> Result<Self, Error> {
        let window = (0..grid.nx, 0..grid.ny);
        Self::in_window((body, side), grid, &states.into(), window)
    }

    /// Sets up the body `side` under each of the `states` for points below a line. Points beside it have the
    /// stress of tractions that are constant in each cell.
    pub fn new_below<'a>(
        line: Line,
        (body, side): (&Body, Side),
        grid: &Grid,
        states: impl Into<States<'a>>,
    ) -> Result<Self, Error> {
        check_line(grid, line)?;
        Self::in_window((body, side), grid, &states.into(), line_window(line, grid))
    }

    /// Sets up a body for points in a window of columns and rows.
    fn in_window(
        (body, side): (&Body, Side),
        grid: &Grid,
        states: &States<'_>,
        window: Window,
    ) -> Result<Self, Error> {
        let loaded = Loaded::new(body, side, grid, states, || Ok(window))?;
        let plane = Plane::new(grid, false);
        let patches = Source::ALL.map(|source| plane.loaded_patch(states.tractions, source));
        let loads = Source::ALL.map(|source| {
            let patch = patches[source.index()];
            let of_states = states.tractions.iter();
            let of_states: Vec<_> = of_states
                .map(|state| plane.loads(state, side, source, patch))
                .collect();
            LoadedCells::new(&of_states, patch)
        });
        Ok(Self {
            loaded,
            plane,
            loads,
            patches,
        })
    }

    /// Stress of each state at each point \[Pa\]: xx, yy, zz, xy, xz, yz.
    ///
    /// Under the tractions of contacts ([`States::stick`]) it is continuous, except for s_xx, s_yy,
    /// s_xy across interfaces, and near an assumed rim on a layer as thin as the cells, where it is
    /// taken in the middle of the cell. Under constant tractions it jumps on the surface at the
    /// border of a cell: there it is the mean of both sides, and infinite terms are evaluated 1/(2
    /// pi) of a cell beside the border.
    pub fn stress(&self, points: &[Point]) -> Result<Vec<Vec<[f64; 6]>>, Error> {
        self.stress_or_both(points, false)
    }

    /// The stress of each state, and the stress of tractions that are constant in each cell. The
    /// difference is the effect of the tractions within the cells. Without [`States::stick`] both
    /// are the same.
    pub fn stress_with_constant(&self, points: &[Point]) -> Result<[Vec<Vec<[f64; 6]>>; 2], Error> {
        let mut stresses = self.stress_or_both(points, true)?;
        let constant = stresses.split_off(self.loaded.states);
        Ok([stresses, constant])
    }

    /// The stress of each state, then, if `constant_too`, the stress of constant tractions.
    fn stress_or_both(
        &self,
        points: &[Point],
        constant_too: bool,
    ) -> Result<Vec<Vec<[f64; 6]>>, Error> {
        let states = self.loaded.states;
        count_at_points(points.len(), states);
        let away_from_steps = |&(x, y, depth): &Point| {
            let rim = self
                .loaded
                .rim
                .as_ref()
                .filter(|_| x.is_finite() && y.is_finite());
            let (x, y) = rim.map_or((x, y), |rim| rim.away_from_steps(&self.loaded.grid, x, y));
            (x, y, depth)
        };
        let points: Vec<Point> = points.iter().map(away_from_steps).collect();
        let points = points.as_slice();
        let mut values_by_state =
            self.gather(points, |kernel, depth, n, values: &mut Vec<[f64; 6]>| {
                if constant_too {
                    values.extend_from_within(..);
                }
                let Some(rim) = &self.loaded.rim else { return };
                let (cell, offset) = locate_cell(&self.loaded.grid, points[n].0, points[n].1);
                let is_near = |state: &usize| rim.is_near(*state, depth, cell);
                let near: Vec<usize> = (0..states).filter(is_near).collect();
                if near.is_empty() {
                    return;
                }
                let Some(parts) = rim.parts_at_point(kernel, depth, (cell, offset), &near) else {
                    return;
                };
                for state in near {
                    rim.add_correction(&parts, state, cell, &mut values[state]);
                }
            })?;
        for (state, stresses) in values_by_state.iter_mut().enumerate() {
            for (stress, (x, y, depth)) in stresses.iter_mut().zip(points) {
                let uniform = self.loaded.uniform(state % states, *depth);
                for (s, uniform) in stress.iter_mut().zip(uniform) {
                    *s += uniform;
                }
                let residual = self.loaded.eigenstress_at(state % states, (*x, *y), *depth);
                for (s, residual) in stress.iter_mut().zip(residual.into_iter().flatten()) {
                    *s += residual;
                }
            }
        }
        Ok(values_by_state)
    }

    /// Memory of the loads \[bytes\].
    pub fn bytes(&self) -> usize {
        let numbers = self.loads.iter().map(|loads| loads.tractions.len());
        3 * size_of::<f64>() * numbers.sum::<usize>()
    }

    /// Displacement of each state at each point relative to infinity \[m\].
    pub fn displacement(&self, points: &[Point]) -> Result<Vec<Vec<[f64; 3]>>, Error> {
        self.gather(points, |_: &DepthKernel<Displacement, 5, 3>, _, _, _| {})
    }

    /// Checks that a point lies on the surface beside an assumed rim.
    pub fn rim_is_unknown(&self, (x, y, depth): Point) -> bool {
        let rim = self.loaded.rim.as_ref();
        rim.is_some_and(|rim| rim.is_unknown(&self.loaded.grid, depth, (x, y)))
    }

    /// The crossings of `line` with the rim of the contact and the border of the stick zone in a
    /// state. Without a line, all lines through the middles of rows and columns of cells are
    /// crossed. Empty under constant tractions.
    pub fn borders(&self, state: usize, line: Option<Line>) -> Vec<Border> {
        let rim = self.loaded.rim.as_ref();
        let continued = rim.and_then(|rim| rim.continued(state));
        continued.map_or_else(Vec::new, |continued| {
            super::borders::find_borders(continued, &self.loaded.grid, line)
        })
    }

    /// Crossings on the lines along x and along y through a place on the grid \[m\]. A place
    /// between the middles of rows lies on the rim where it crosses them.
    pub(super) fn borders_near(&self, x: f64, y: f64) -> Vec<Border> {
        let (length, width) = self.loaded.grid.extent();
        if x.abs() > 0.5 * length || y.abs() > 0.5 * width {
            return Vec::new();
        }
        let mut borders = self.borders(0, Some(Line::AlongX(y)));
        if self.loaded.grid.ny > 1 {
            borders.extend(self.borders(0, Some(Line::AlongY(x))));
        }
        borders
    }

    /// Computes a quantity of each state at all points, depth by depth. `more` adds what is no response to
    /// constant tractions.
    fn gather<Q: Quantity<N, R> + Sync, const N: usize, const R: usize>(
        &self,
        points: &[Point],
        more: impl Fn(&DepthKernel<Q, N, R>, Depth, usize, &mut Vec<[f64; R]>) + Sync,
    ) -> Result<Vec<Vec<[f64; R]>>, Error> {
        let farthest = FARTHEST * self.plane.reach();
        // Points at one depth share its kernel.
        let mut by_depth: BTreeMap<(u64, usize), Vec<usize>> = BTreeMap::new();
        for (n, (x, y, depth)) in points.iter().enumerate() {
            for (key, v) in [("x", *x), ("y", *y), ("z", depth.z)] {
                if !(v.abs() <= farthest) {
                    let allowed = format!("a place in m, at most {farthest:.3e} from the middle");
                    return Err(Error::invalid(key, v, allowed));
                }
            }
            let key = (depth.z.to_bits(), depth.layer);
            by_depth.entry(key).or_default().push(n);
        }
        let distances = points.iter().map(|(x, y, _)| x.hypot(*y));
        let farthest = distances.fold(0.0, f64::max);
        if by_depth.len() > 1 {
            let depths: Vec<Depth> = by_depth.values().map(|group| points[group[0]].2).collect();
            self.tabulate_kernels::<Q, N, R>(&depths, farthest)?;
        }
        let groups: Vec<_> = by_depth
            .into_values()
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|group| {
                let values = self.values_at_depth((points, farthest), &group, &more)?;
                Ok((group, values))
            })
            .collect::<Result<_, Error>>()?;
        let of_first = groups
            .iter()
            .find_map(|(_, values): &(_, Vec<Vec<_>>)| values.first());
        let states = of_first.map_or(self.loaded.states, Vec::len);
        let mut by_state = vec![vec![[0.0; R]; points.len()]; states];
        for (group, values) in groups {
            for (n, of_states) in group.into_iter().zip(values) {
                for (state, value) in by_state.iter_mut().zip(of_states) {
                    state[n] = value;
                }
            }
        }
        Ok(by_state)
    }

    /// Tabulates the kernels at several depths together, for points up to a distance from the middle of
    /// the grid \[m\].
    pub(super) fn tabulate_kernels<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        depths: &[Depth],
        farthest: f64,
    ) -> Result<(), Error> {
        let reach = self.plane.reach() + farthest;
        self.loaded.tabulate_kernels::<Q, N, R>(depths, reach)
    }

    /// The values of every state at the points of a group, which share their depth; `more` is
    /// added. All points lie within `farthest` of the middle of the grid \[m\].
    fn values_at_depth<Q: Quantity<N, R> + Sync, const N: usize, const R: usize>(
        &self,
        (points, farthest): (&[Point], f64),
        group: &[usize],
        more: &(impl Fn(&DepthKernel<Q, N, R>, Depth, usize, &mut Vec<[f64; R]>) + Sync),
    ) -> Result<Vec<Vec<[f64; R]>>, Error> {
        let depth = points[group[0]].2;
        let reach = self.plane.reach() + farthest;
        let kernel: DepthKernel<Q, N, R> = self.loaded.kernel(depth, reach)?;
        let source = Source::for_depth(depth.z, self.plane.d);
        let values_at = |n: &usize| {
            let (x, y, _) = points[*n];
            let mut values = self.sum_responses(&kernel, source, (x, y))?;
            more(&kernel, depth, *n, &mut values);
            Ok(values)
        };
        group.par_iter().map(values_at).collect()
    }

    /// Sums the responses to the loads of each state at the place x, y \[m\].
    fn sum_responses<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        kernel: &DepthKernel<Q, N, R>,
        source: Source,
        (x, y): (f64, f64),
    ) -> Result<Vec<[f64; R]>, Error> {
        let Plane { n, d, .. } = self.plane;
        let patch = self.patches[source.index()];
        // From the middle of a cell, in cells.
        let offset = |v: f64, i: usize, start: isize, n: usize, d: f64| {
            let middle = (i as isize + start) as f64 - (n - 1) as f64 / 2.0;
            snap_to_half_cells(v / d - middle)
        };
        let from_x = offset(x, 0, patch.start.0, n.0, d.0);
        let loads = &self.loads[source.index()];
        let states = self.loaded.states;
        let mut sums = vec![[0.0; R]; states];
        let first = from_x - (patch.columns - 1) as f64;
        let mut corners = SharedCorners::new(first, patch.columns);
        for j in 0..patch.rows {
            unless(&self.loaded.stop)?;
            let from_y = offset(y, j, patch.start.1, n.1, d.1) * d.1;
            let row = &loads.cells[j * patch.columns..][..patch.columns];
            let offsets = row.iter().enumerate();
            let offsets = offsets.filter_map(|(i, load)| load.map(|_| (i, from_x - i as f64)));
            let mut add = |i: usize, response: [[f64; 3]; R]| {
                let Some(place) = row[i] else { return };
                let of_cell = &loads.tractions[place * states..][..states];
                for (sums, [q_x, q_y, p]) in sums.iter_mut().zip(of_cell) {
                    for (sum, row) in sums.iter_mut().zip(&response) {
                        *sum += row[0] * q_x + row[1] * q_y + row[2] * p;
                    }
                }
            };
            match source {
                Source::Cells => {
                    kernel.responses_to_cells(offsets, from_y, d, &mut corners, add);
                }
                Source::Points => {
                    for (i, from_x) in offsets {
                        let response = kernel.response_to_point(from_x * d.0, from_y);
                        add(i, response.map(|row| row.map(|v| d.0 * d.1 * v)));
                    }
                }
            }
        }
        for (row, sum) in sums.iter_mut().flat_map(|sums| sums.iter_mut().enumerate()) {
            if Q::has_one_z(row) {
                *sum *= self.loaded.side.sign();
            }
        }
        Ok(sums)
    }
}
