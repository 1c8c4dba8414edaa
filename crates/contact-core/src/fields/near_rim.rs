//! What the tractions within the cells add to the stress near the surface of a contact.
//!
//! Beside the rim, and beside the border of the stick zone, the stress of constant tractions is off by
//! the root of the cell. There the cells around a sample are cut into parts, the nearer to the
//! sample the smaller, and what the continued tractions are more than constant on each is added. The
//! parts' responses depend on offsets and depth alone: all samples of a depth share them.

use std::f64::consts::TAU;
use std::ops::Range;

use super::loads::{Plane, snapped};
use super::{Depth, Side};
use crate::convolution::Tractions;
use crate::kernels::{Cell, DepthKernel, Quantity, Stress};
use crate::scene::Grid;
use crate::zones::Continued;

/// Deepest samples, in cells.
const DEEPEST: f64 = 6.0;
/// Farthest cells from the border that count in full for samples below the surface, in cells along or across: farther in
/// constant tractions are right to second order there, and those interpolated between the middles of the cells, with
/// a kink in each, are not (4e-4 of p_H on the axis of a contact of 28 cells across).
const FARTHEST_CUT: u8 = 3;
/// Farthest samples from the border, near the surface, where constant tractions are off by their slope as well, and
/// below, where no cell farther away counts.
const FARTHEST_AT_SURFACE: u8 = 24;
const FARTHEST: u8 = FARTHEST_CUT + REACH as u8;
/// Depth in cells down to which the slope counts: what varies from cell to cell falls like exp(-2 pi z).
const AT_SURFACE: f64 = 1.0;
/// Cells on each side of a sample that are cut.
const REACH: usize = 3;
/// A part is smaller than its distance from the sample over this, or of the smallest size, a cell
/// cut by three so many times.
const GRADING: f64 = 2.0;
const CUTS: u32 = 4;
/// Row of s_zz.
const S_ZZ: usize = 2;

/// The tractions of the states around some cells.
pub(super) struct NearRim {
    plane: Plane,
    side: Side,
    states: Vec<Continued>,
}

/// Parts of the cells around a sample.
pub(super) struct Parts {
    /// By cell: columns and rows from the sample's, and its parts.
    cells: Vec<((isize, isize), Vec<Part>)>,
    /// Whether the sample is on the surface, where s_zz, s_xz, s_yz are the tractions themselves.
    on_surface: bool,
    /// How much those count that are farther from the border than [`FARTHEST_CUT`].
    far: f64,
}

/// The middle of a part from that of its cell, in cells, and the stress at the sample under unit
/// q_x, q_y, p on it.
type Part = ((f64, f64), [[f64; 3]; 6]);

impl NearRim {
    /// For samples in the cells of these columns and rows.
    pub(super) fn new(
        grid: &Grid,
        side: Side,
        states: &[Tractions<'_>],
        stick: &[&[bool]],
        (columns, rows): (Range<usize>, Range<usize>),
    ) -> Self {
        // One cell more on each side for what lies between, one for samples on a border.
        let wider = |cells: Range<usize>, count: usize| {
            cells.start.saturating_sub(REACH + 2)..(cells.end + REACH + 2).min(count)
        };
        let window = (wider(columns, grid.nx), wider(rows, grid.ny));
        let of_state = |(n, tractions): (usize, &Tractions<'_>)| {
            Continued::new(grid, tractions, stick.get(n).copied(), &window)
        };
        Self {
            plane: Plane::new(grid, false),
            side,
            states: states.iter().enumerate().map(of_state).collect(),
        }
    }

    /// The nearest cell to a place, and the place from its middle in cells.
    pub(super) fn locate(grid: &Grid, x: f64, y: f64) -> ((usize, usize), (f64, f64)) {
        let Plane { n, d, .. } = Plane::new(grid, false);
        let along = |v: f64, n: usize, d: f64| {
            let place = v / d + (n - 1) as f64 / 2.0;
            let cell = place.round().clamp(0.0, (n - 1) as f64);
            (cell as usize, snapped(place - cell))
        };
        let ((i, s), (j, t)) = (along(x, n.0, d.0), along(y, n.1, d.1));
        ((i, j), (s, t))
    }

    /// The parts around samples at a depth that lie so many cells from the middle of their cell;
    /// none where they are too deep.
    pub(super) fn parts(
        &self,
        kernel: &DepthKernel<Stress, 10, 6>,
        depth: Depth,
        offset: (f64, f64),
    ) -> Option<Parts> {
        let Plane { n, d, .. } = self.plane;
        let flat = n.1 == 1;
        let z = self.depth_in_cells(depth);
        if z >= DEEPEST {
            return None;
        }
        let reach = REACH as f64;
        let within = |f: f64, n: usize| {
            let most = if n == 1 { 0 } else { REACH as isize + 1 };
            (-most..=most).filter(move |k| (*k as f64 - f).abs() <= reach + 0.5)
        };
        let cells = within(offset.0, n.0).flat_map(|k| within(offset.1, n.1).map(move |l| (k, l)));
        let cut = |(k, l): (isize, isize)| {
            let sample = (offset.0 - k as f64, offset.1 - l as f64);
            let cut = Cut {
                kernel,
                side: self.side,
                d,
                flat,
                sample,
                z,
            };
            let mut parts = Vec::new();
            cut.thirds(&mut parts, (0.0, 0.0), 1.0, 1);
            ((k, l), parts)
        };
        let cells = cells.map(cut).collect();
        Some(Parts {
            cells,
            on_surface: depth.z <= 0.0,
            far: if z < AT_SURFACE {
                (-TAU * z).exp()
            } else {
                0.0
            },
        })
    }

    /// Whether stress is added at samples in a cell at a depth.
    pub(super) fn is_near(&self, state: usize, depth: Depth, cell: (usize, usize)) -> bool {
        let at_surface = self.depth_in_cells(depth) < AT_SURFACE;
        let farthest = if at_surface {
            FARTHEST_AT_SURFACE
        } else {
            FARTHEST
        };
        self.states[state].distance(cell) <= farthest
    }

    fn depth_in_cells(&self, depth: Depth) -> f64 {
        let Plane { n, d, .. } = self.plane;
        depth.z / if n.1 == 1 { d.0 } else { d.0.max(d.1) }
    }

    /// What is added to the stress of a state at a sample in a cell \[Pa\].
    pub(super) fn stress(&self, parts: &Parts, state: usize, (i, j): (usize, usize)) -> [f64; 6] {
        let state = &self.states[state];
        let mut stress = [0.0; 6];
        for ((columns, rows), cut) in &parts.cells {
            let cell = i
                .checked_add_signed(*columns)
                .zip(j.checked_add_signed(*rows));
            let Some(cell) = cell else { continue };
            let counts = if state.distance(cell) > FARTHEST_CUT {
                parts.far
            } else {
                1.0
            };
            if counts == 0.0 {
                continue;
            }
            state.each_excess(cell, cut, |q, response| {
                for (stress, row) in stress.iter_mut().zip(response) {
                    *stress += counts * (row[0] * q[0] + row[1] * q[1] + row[2] * q[2]);
                }
            });
        }
        if parts.on_surface {
            let of_tractions = |row: usize| row == S_ZZ || Stress::has_one_z(row);
            for row in (0..6).filter(|&row| of_tractions(row)) {
                stress[row] = 0.0;
            }
        }
        stress
    }
}

/// How a cell is cut for a sample.
struct Cut<'a> {
    kernel: &'a DepthKernel<Stress, 10, 6>,
    side: Side,
    d: (f64, f64),
    flat: bool,
    /// From the middle of the cell, in cells.
    sample: (f64, f64),
    /// Depth in cells.
    z: f64,
}

impl Cut<'_> {
    /// The thirds along each side of a part, `times` being how often they have been cut from the
    /// cell, and where one is too large its own thirds.
    fn thirds(&self, parts: &mut Vec<Part>, middle: (f64, f64), whole: f64, times: u32) {
        const THIRDS: [f64; 3] = [0.0, -1.0 / 3.0, 1.0 / 3.0];
        let size = whole / 3.0;
        for s in THIRDS {
            for t in &THIRDS[..if self.flat { 1 } else { 3 }] {
                let middle = (middle.0 + s * whole, middle.1 + t * whole);
                let from = |sample: f64, middle: f64| snapped((sample - middle) / size);
                let x = from(self.sample.0, middle.0);
                let y = if self.flat {
                    0.0
                } else {
                    from(self.sample.1, middle.1)
                };
                let distance = x.abs().max(y.abs()).max(self.z / size);
                if times < CUTS && distance < GRADING {
                    self.thirds(parts, middle, size, times + 1);
                } else {
                    parts.push((middle, self.response(x, y, size)));
                }
            }
        }
    }

    /// The stress under a part of a size at an offset in its own lengths.
    fn response(&self, x: f64, y: f64, size: f64) -> [[f64; 3]; 6] {
        let d_x = size * self.d.0;
        let d_y = if self.flat { self.d.1 } else { size * self.d.1 };
        let cell = Cell {
            x: x * d_x,
            y: y * d_y,
            half_x: 0.5 * d_x,
            half_y: 0.5 * d_y,
        };
        let mut response = self.kernel.under(&cell);
        // In the body's own frame the shear and the components with one z have its sign.
        for (row, response) in response.iter_mut().enumerate() {
            for (column, v) in response.iter_mut().enumerate() {
                if Stress::has_one_z(row) != (column < 2) {
                    *v *= self.side.sign();
                }
            }
        }
        response
    }
}
