//! A cell divided into parts for a sample of the stress near it, and the response to each part.

use std::cell::RefCell;
use std::collections::HashMap;

use contact_core::kernels::{Cell, DepthKernel, Quantity, Stress};

use super::Side;
use super::loads::snap_to_half_cells;

/// Division of the cells: a part is smaller than its distance from the sample over `grading`, or of
/// the smallest size, 3^-`cuts` cells.
#[derive(Clone, Copy)]
pub(super) struct Fineness {
    pub(super) grading: f64,
    pub(super) cuts: u32,
}

impl Fineness {
    /// Fineness for samples that share their parts; none lies on a border.
    pub(super) fn shared(flat: bool) -> Self {
        let (grading, cuts) = if flat { (8.0, 5) } else { (2.0, 4) };
        Self { grading, cuts }
    }

    /// Fineness for a point, which may lie on a border. The error of the root within the smallest
    /// part is at most 2 (2 d_x/a 3^-10)^(1/2) p_H.
    pub(super) fn single_point(flat: bool) -> Self {
        let (grading, cuts) = if flat { (8.0, 12) } else { (3.0, 10) };
        Self { grading, cuts }
    }
}

/// A cell near the sample.
pub(super) struct Divided {
    /// Columns and rows from the sample's.
    pub(super) from: (isize, isize),
    pub(super) parts: Vec<Part>,
    /// The stress at the sample under tractions that grow by one over the length and over the width
    /// of the cell and are zero in its middle.
    pub(super) slopes: [[[f64; 3]; 6]; 2],
}

/// A part of a cell.
pub(super) struct Part {
    /// Place at which its tractions are evaluated, from the middle of the cell, in cells: its own
    /// middle, or the sample if the part contains it, so that the traction has no step there.
    pub(super) at: (f64, f64),
    /// The stress at the sample under unit q_x, q_y, p on it.
    pub(super) response: [[f64; 3]; 6],
}

/// The response to a unit slope along and across, from the parts of a cell.
pub(super) fn slopes(parts: &[Part]) -> [[[f64; 3]; 6]; 2] {
    let mut slopes = [[[0.0; 3]; 6]; 2];
    for Part { at, response } in parts {
        for (slope, at) in slopes.iter_mut().zip([at.0, at.1]) {
            for (sum, v) in slope.iter_mut().flatten().zip(response.iter().flatten()) {
                *sum += at * v;
            }
        }
    }
    slopes
}

/// The division of a cell for a sample.
pub(super) struct Division<'a> {
    pub(super) kernel: &'a DepthKernel<Stress, 10, 6>,
    pub(super) side: Side,
    pub(super) d: (f64, f64),
    pub(super) flat: bool,
    /// Offset from the middle of the cell, in cells.
    pub(super) sample: (f64, f64),
    /// Depth in cells.
    pub(super) z: f64,
    pub(super) fineness: Fineness,
    pub(super) cache: &'a RefCell<ResponseCache>,
}

/// Responses by distance along and across and by size.
pub(super) type ResponseCache = HashMap<[u64; 3], [[f64; 3]; 6]>;

impl Division<'_> {
    /// Adds the nine thirds of a part; `times` is the number of divisions so far. A third that is
    /// too large is divided again.
    pub(super) fn add_thirds(
        &self,
        parts: &mut Vec<Part>,
        middle: (f64, f64),
        whole: f64,
        times: u32,
    ) {
        const THIRDS: [f64; 3] = [0.0, -1.0 / 3.0, 1.0 / 3.0];
        let size = whole / 3.0;
        for s in THIRDS {
            for t in &THIRDS[..if self.flat { 1 } else { 3 }] {
                let middle = (middle.0 + s * whole, middle.1 + t * whole);
                let offset =
                    |sample: f64, middle: f64| snap_to_half_cells((sample - middle) / size);
                let x = offset(self.sample.0, middle.0);
                let y = if self.flat {
                    0.0
                } else {
                    offset(self.sample.1, middle.1)
                };
                let distance = x.abs().max(y.abs());
                let Fineness { grading, cuts } = self.fineness;
                if times < cuts && distance.max(self.z / size) < grading {
                    self.add_thirds(parts, middle, size, times + 1);
                    continue;
                }
                let holds = distance <= 0.5 && self.z < size;
                parts.push(Part {
                    at: if holds { self.sample } else { middle },
                    response: self.cached_response(x, y, size),
                });
            }
        }
    }

    /// The stress under a part of a size at an offset in its own lengths; mirrored parts share it.
    pub(super) fn cached_response(&self, x: f64, y: f64, size: f64) -> [[f64; 3]; 6] {
        let offset = [x.abs(), y.abs()];
        let key = [offset[0], offset[1], size].map(f64::to_bits);
        let mut cache = self.cache.borrow_mut();
        let response = cache
            .entry(key)
            .or_insert_with(|| self.compute_response(offset[0], offset[1], size));
        let mut mirrored = *response;
        for (row, response) in mirrored.iter_mut().enumerate() {
            for (column, v) in response.iter_mut().enumerate() {
                let (odd_x, odd_y) = Stress::is_odd(row, column);
                if (odd_x && x < 0.0) != (odd_y && y < 0.0) {
                    *v = -*v;
                }
            }
        }
        mirrored
    }

    fn compute_response(&self, x: f64, y: f64, size: f64) -> [[f64; 3]; 6] {
        let d_x = size * self.d.0;
        let d_y = if self.flat { self.d.1 } else { size * self.d.1 };
        let cell = Cell {
            x: x * d_x,
            y: y * d_y,
            half_x: 0.5 * d_x,
            half_y: 0.5 * d_y,
        };
        let mut response = self.kernel.response_to_cell(&cell);
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
