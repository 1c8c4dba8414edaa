//! Stress near the surface of a contact: contribution of the variation of the tractions within the
//! cells.
//!
//! Beside the rim, and beside the border of the stick zone, the stress of constant tractions is off
//! by the root of the cell size. There the cells around a sample are divided into parts, smaller
//! near the sample, and the difference of the continued and the constant tractions is added on each
//! part. The parts' responses depend on offsets and depth alone: all samples of a depth share them.

use std::cell::RefCell;
use std::sync::Arc;

use contact_core::convolution::Tractions;
use contact_core::kernels::{DepthKernel, Stress};
use contact_core::scene::{Body, Grid};
use contact_core::zones::Continued;
use rayon::prelude::*;

use super::continuation::{
    Continuation, DIVIDED_CELLS, Window, continue_tractions, locate_cell, widen,
};
use super::divided::{Divided, Division, Fineness, Whole, slopes};
use super::excess::ExcessTables;
use super::loads::Plane;
use super::{Depth, Side};

/// Deepest samples, in cells.
const DEEPEST: f64 = 6.0;
/// Largest distance from a border, in cells along or across, of cells in which the tractions are
/// not linear, and of samples below the surface at which the correction is computed. Near the
/// surface it is computed everywhere: there the slope of the tractions counts.
const FARTHEST: u8 = 3 + DIVIDED_CELLS as u8;
/// Distance of a sample from the borders beyond which the slope at the sample is used for all cells
/// that are not divided.
const SMOOTH: u8 = 12;
/// Depth in cells down to which the slope counts: variations of the period of a cell decay like
/// exp(-2 pi z).
const AT_SURFACE: f64 = 1.0;
/// Rows of s_zz, s_xz, s_yz with the traction whose negative they are on the surface.
const TRACTION_ROWS: [(usize, usize); 3] = [(2, 2), (4, 0), (5, 1)];

/// The tractions of the states around some cells.
pub(super) struct NearRim {
    plane: Plane,
    side: Side,
    states: Vec<Arc<Continued>>,
    /// Difference of continued and constant tractions in the cells near borders, by state.
    excess: Vec<ExcessTables>,
}

/// Parts of the cells around a sample.
pub(super) struct Parts {
    cells: Vec<Divided>,
    /// The stress at the sample under unit slopes of the tractions, along and across, in all cells
    /// outside the divided ones.
    beyond: [[[f64; 3]; 6]; 2],
    /// Offset from the middle of the sample's cell, in cells.
    offset: (f64, f64),
    /// True if the sample is on the surface, where s_zz, s_xz, s_yz are the tractions themselves.
    on_surface: bool,
}

impl NearRim {
    /// Continues the tractions of each state near rims and stick borders, for samples in the cells of a window
    /// of columns and rows. States with `continuations` there use these.
    pub(super) fn new(
        (body, side): (&Body, Side),
        grid: &Grid,
        states: &[Tractions<'_>],
        stick: &[&[bool]],
        continuations: &[Continuation],
        window: &Window,
    ) -> Self {
        let window = widen(window, grid);
        let of_state = |(n, tractions): (usize, &Tractions<'_>)| {
            let continuation = continuations.get(n);
            let continuation = continuation.filter(|state| state.covers(grid, &window));
            continuation.map_or_else(
                || {
                    let stick = stick.get(n).copied();
                    Arc::new(continue_tractions(body, grid, tractions, stick, &window))
                },
                |state| Arc::clone(&state.tractions),
            )
        };
        let states: Vec<_> = states.par_iter().enumerate().map(of_state).collect();
        let flat = grid.ny == 1;
        let tables = states.iter().map(|state| {
            let is_near = |cell: (usize, usize)| state.distance(cell) <= FARTHEST;
            ExcessTables::new(&window, flat, is_near)
        });
        Self {
            plane: Plane::new(grid, false),
            side,
            excess: tables.collect(),
            states,
        }
    }

    /// Divides the cells around a sample at a depth into parts, for all cells and states in common; `offset` is
    /// the sample's offset in cells from the middle of its cell. None where the sample is too deep to need it.
    pub(super) fn parts(
        &self,
        kernel: &DepthKernel<Stress, 10, 6>,
        depth: Depth,
        offset: (f64, f64),
    ) -> Option<Parts> {
        let fineness = Fineness::shared(self.is_flat());
        let every_cell = |_| true;
        let for_all_states = true;
        self.divide(kernel, depth, offset, fineness, &every_cell, for_all_states)
    }

    /// The parts around one point in a cell, which may lie on a border, for some states. Cells in
    /// which the tractions of all these states are constant have none.
    pub(super) fn parts_at_point(
        &self,
        kernel: &DepthKernel<Stress, 10, 6>,
        depth: Depth,
        (cell, offset): ((usize, usize), (f64, f64)),
        states: &[usize],
    ) -> Option<Parts> {
        let states = || states.iter().map(|n| &self.states[*n]);
        let varies = |(k, l): (isize, isize)| {
            let at = cell
                .0
                .checked_add_signed(k)
                .zip(cell.1.checked_add_signed(l));
            at.is_some_and(|at| states().any(|state| state.slopes(at).is_some()))
        };
        let is_smooth = states().any(|state| state.distance(cell) > SMOOTH);
        let fineness = Fineness::single_point(self.is_flat());
        self.divide(kernel, depth, offset, fineness, &varies, is_smooth)
    }

    /// Whether the grid is one row of cells in plane strain.
    fn is_flat(&self) -> bool {
        self.plane.n.1 == 1
    }

    /// Divides the cells around a sample into parts by their distance from it, and computes their responses.
    /// `varies` selects the cells by their offset from the sample's cell; with `beyond` the response to slopes
    /// beyond the divided cells is added. None where the sample is too deep.
    fn divide(
        &self,
        kernel: &DepthKernel<Stress, 10, 6>,
        depth: Depth,
        offset: (f64, f64),
        fineness: Fineness,
        varies: &dyn Fn((isize, isize)) -> bool,
        beyond: bool,
    ) -> Option<Parts> {
        let Plane { n, d, .. } = self.plane;
        let z = self.depth_in_cells(depth);
        if z >= DEEPEST {
            return None;
        }
        let reach = DIVIDED_CELLS as f64;
        let clamp_cells = |f: f64, n: usize| {
            let farthest = if n == 1 {
                0
            } else {
                DIVIDED_CELLS as isize + 1
            };
            (-farthest..=farthest).filter(move |k| (*k as f64 - f).abs() <= reach + 0.5)
        };
        let cells = clamp_cells(offset.0, n.0)
            .flat_map(|k| clamp_cells(offset.1, n.1).map(move |l| (k, l)));
        let cache = RefCell::default();
        let divide_cell = |(k, l): (isize, isize)| {
            let divide_cell = Division {
                kernel,
                side: self.side,
                d,
                flat: self.is_flat(),
                sample: (offset.0 - k as f64, offset.1 - l as f64),
                z,
                fineness,
                cache: &cache,
            };
            let mut parts = Vec::new();
            if varies((k, l)) {
                divide_cell.add_thirds(&mut parts, Whole::CELL);
            }
            Divided {
                from: (k, l),
                slopes: slopes(&parts),
                parts,
            }
        };
        let cells: Vec<Divided> = cells.map(divide_cell).collect();
        Some(Parts {
            beyond: if beyond {
                self.response_beyond(kernel, &cells, offset, fineness, z)
            } else {
                [[[0.0; 3]; 6]; 2]
            },
            cells,
            offset,
            on_surface: depth.z <= 0.0,
        })
    }

    /// The response to unit slopes along and across beyond some cells around a sample. In a row of
    /// cells k with the middles x_k and the length d the slope g adds g (s - x_k)/d to the traction
    /// at s, a dipole of g d^2/12: with the response K to a line of load the cells to the right of
    /// x_R sum up to
    ///
    /// ```text
    /// -g/12 sum_k K'(x - x_k) d^2 = -g/12 K(x - x_R) d,
    /// ```
    ///
    /// the response to -g/12 on one cell in whose middle they begin. The cells to the left sum up
    /// to the response to g/12. Rows without a divided cell add nothing.
    fn response_beyond(
        &self,
        kernel: &DepthKernel<Stress, 10, 6>,
        cells: &[Divided],
        offset: (f64, f64),
        fineness: Fineness,
        z: f64,
    ) -> [[[f64; 3]; 6]; 2] {
        const DIPOLE: f64 = 1.0 / 12.0;
        let mut beyond = [[[0.0; 3]; 6]; 2];
        let axes = if self.is_flat() { 1 } else { 2 };
        let cache = RefCell::default();
        for (axis, sum) in beyond.iter_mut().enumerate().take(axes) {
            let along = |d: &Divided| [d.from.0, d.from.1][axis];
            let ends = [cells.iter().map(along).min(), cells.iter().map(along).max()];
            for (end, sign) in ends.into_iter().flatten().zip([1.0, -1.0]) {
                for Divided { from, .. } in cells.iter().filter(|d| along(d) == end) {
                    let mut middle = [from.0 as f64, from.1 as f64];
                    middle[axis] -= 0.5 * sign;
                    let cut = Division {
                        kernel,
                        side: self.side,
                        d: self.plane.d,
                        flat: self.is_flat(),
                        sample: (offset.0 - middle[0], offset.1 - middle[1]),
                        z,
                        fineness,
                        cache: &cache,
                    };
                    let response = cut.cached_response(cut.sample.0, cut.sample.1, 1.0);
                    for (sum, v) in sum.iter_mut().flatten().zip(response.iter().flatten()) {
                        *sum += sign * DIPOLE * v;
                    }
                }
            }
        }
        beyond
    }

    /// Checks that the correction is computed at samples in a cell at a depth.
    pub(super) fn is_near(&self, state: usize, depth: Depth, cell: (usize, usize)) -> bool {
        self.depth_in_cells(depth) < AT_SURFACE || self.states[state].distance(cell) <= FARTHEST
    }

    /// The depth in lengths of the longer side of a cell.
    fn depth_in_cells(&self, depth: Depth) -> f64 {
        let d = self.plane.d;
        depth.z / if self.is_flat() { d.0 } else { d.0.max(d.1) }
    }

    /// Returns the place itself. Next to a step of constant tractions, where the stress is
    /// infinite, it returns the middle of its cell.
    pub(super) fn away_from_steps(&self, grid: &Grid, x: f64, y: f64) -> (f64, f64) {
        let (cell, (s, t)) = locate_cell(grid, x, y);
        let Plane { d, .. } = self.plane;
        if self.states.iter().any(|state| state.has_steps(cell)) {
            (x - s * d.0, y - t * d.1)
        } else {
            (x, y)
        }
    }

    /// Checks that a place less than a cell deep lies beside an assumed rim in any state.
    pub(super) fn is_unknown(&self, grid: &Grid, depth: Depth, (x, y): (f64, f64)) -> bool {
        let (cell, _) = locate_cell(grid, x, y);
        let is_unknown = |state: &Arc<Continued>| state.rim_is_unknown(cell);
        self.depth_in_cells(depth) < 1.0 && self.states.iter().any(is_unknown)
    }

    /// The continued tractions of a state; none where they are constant in all cells.
    pub(super) fn continued(&self, state: usize) -> Option<&Continued> {
        self.states.get(state).map(Arc::as_ref)
    }

    /// Adds the correction to the stress of a state at a sample in a cell \[Pa\].
    pub(super) fn add_correction(
        &self,
        parts: &Parts,
        state: usize,
        (i, j): (usize, usize),
        stress: &mut [f64; 6],
    ) {
        let (state, tables) = (&self.states[state], &self.excess[state]);
        let mut correction = [0.0; 6];
        let mut add = |response: &[[f64; 3]; 6], q: [f64; 3]| {
            for (stress, row) in correction.iter_mut().zip(response) {
                *stress += row[0] * q[0] + row[1] * q[1] + row[2] * q[2];
            }
        };
        let slopes = |cell| state.slopes(cell).into_iter().flatten();
        if state.distance((i, j)) > SMOOTH {
            let beyond = parts.beyond.iter().zip(slopes((i, j)));
            beyond.for_each(|(response, q)| add(response, q));
        }
        for divided in &parts.cells {
            let (columns, rows) = divided.from;
            let cell = i
                .checked_add_signed(columns)
                .zip(j.checked_add_signed(rows));
            let Some(cell) = cell else { continue };
            if state.distance(cell) > FARTHEST {
                let within = divided.slopes.iter().zip(slopes(cell));
                within.for_each(|(response, q)| add(response, q));
            } else if let Some(table) = tables.fetch(state, cell) {
                for part in &divided.parts {
                    add(&part.response, table.on_part(part));
                }
            }
        }
        let own_cell = state.tractions_within((i, j)).filter(|_| parts.on_surface);
        for (row, (stress, correction)) in stress.iter_mut().zip(correction).enumerate() {
            let traction = TRACTION_ROWS.iter().find(|(of, _)| *of == row);
            match (traction.filter(|_| parts.on_surface), &own_cell) {
                (None, _) => *stress += correction,
                (Some((_, c)), Some(own_cell)) => *stress = -own_cell.evaluate(parts.offset)[*c],
                (Some(_), _) => (),
            }
        }
    }
}
