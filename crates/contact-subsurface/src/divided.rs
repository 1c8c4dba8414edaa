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
    /// Fineness for samples in the middle of cells, which share the parts of a cell; none lies on a border.
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
    /// Its index among the parts of its division, where these are shared by samples; `None` of
    /// smaller parts, and of the part that contains the sample.
    pub(super) shared: Option<SharedPart>,
    /// The stress at the sample under unit q_x, q_y, p on it.
    pub(super) response: [[f64; 3]; 6],
}

/// A part that samples at all depths and in all cells around have in common.
#[derive(Clone, Copy)]
pub(super) struct SharedPart {
    /// Number of divisions less one.
    pub(super) division: usize,
    /// Index in [`middles`].
    pub(super) index: usize,
}

/// Divisions whose parts are shared.
pub(super) const SHARED_DIVISIONS: usize = 2;

const THIRDS: [f64; 3] = [0.0, -1.0 / 3.0, 1.0 / 3.0];

/// Yields the offsets of the middles of the thirds of a part, along and across, over the size of the part;
/// `flat` in plane strain.
fn thirds(flat: bool) -> impl Iterator<Item = (f64, f64)> {
    let across = &THIRDS[..if flat { 1 } else { 3 }];
    THIRDS
        .into_iter()
        .flat_map(move |s| across.iter().map(move |t| (s, *t)))
}

/// Middles of the parts of a cell, in cells, after so many divisions into thirds and one more.
pub(super) fn middles(flat: bool, division: usize) -> Vec<(f64, f64)> {
    let mut middles = vec![(0.0, 0.0)];
    let mut whole = 1.0;
    for _ in 0..=division {
        let parts = middles.iter().flat_map(|middle: &(f64, f64)| {
            thirds(flat).map(move |(s, t)| (middle.0 + s * whole, middle.1 + t * whole))
        });
        middles = parts.collect();
        whole /= 3.0;
    }
    middles
}

/// The stress under tractions that rise with unit slope along and across the cell: sums over its parts.
pub(super) fn slopes(parts: &[Part]) -> [[[f64; 3]; 6]; 2] {
    let mut slopes = [[[0.0; 3]; 6]; 2];
    for Part { at, response, .. } in parts {
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

/// A part to be divided: its middle and size in cells, the number of divisions so far, and its
/// place among the parts of the last one.
#[derive(Clone, Copy)]
pub(super) struct Whole {
    middle: (f64, f64),
    size: f64,
    divisions: u32,
    index: usize,
}

impl Whole {
    /// A cell.
    pub(super) const CELL: Self = Self {
        middle: (0.0, 0.0),
        size: 1.0,
        divisions: 0,
        index: 0,
    };
}

/// Responses by distance along and across and by size.
pub(super) type ResponseCache = HashMap<[u64; 3], [[f64; 3]; 6]>;

impl Division<'_> {
    /// Divides a part into nine thirds (three in plane strain) and adds them to `parts`. A third that is too
    /// large for its distance from the sample is divided again.
    pub(super) fn add_thirds(&self, parts: &mut Vec<Part>, whole: Whole) {
        let size = whole.size / 3.0;
        let divisions = whole.divisions + 1;
        let count = if self.flat { 3 } else { 9 };
        for (n, (s, t)) in thirds(self.flat).enumerate() {
            let middle = (
                whole.middle.0 + s * whole.size,
                whole.middle.1 + t * whole.size,
            );
            let offset = |sample: f64, middle: f64| snap_to_half_cells((sample - middle) / size);
            let x = offset(self.sample.0, middle.0);
            let y = if self.flat {
                0.0
            } else {
                offset(self.sample.1, middle.1)
            };
            let index = whole.index * count + n;
            let distance = x.abs().max(y.abs());
            let Fineness { grading, cuts } = self.fineness;
            if divisions < cuts && distance.max(self.z / size) < grading {
                let third = Whole {
                    middle,
                    size,
                    divisions,
                    index,
                };
                self.add_thirds(parts, third);
                continue;
            }
            let holds = distance <= 0.5 && self.z < size;
            let division = divisions as usize - 1;
            let is_shared = !holds && division < SHARED_DIVISIONS;
            parts.push(Part {
                at: if holds { self.sample } else { middle },
                shared: is_shared.then_some(SharedPart { division, index }),
                response: self.cached_response(x, y, size),
            });
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

    /// Computes the stress under a part with unit tractions, in the axes of the body.
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

#[cfg(test)]
mod tests {
    use contact_core::kernels::Stack;
    use contact_core::scene::{Body, Elastic, Shape};

    use super::*;

    /// The parts that are shared lie where the table of a cell has them, for samples at any place.
    #[test]
    fn shared_parts_lie_in_the_middles_of_their_division() {
        let steel = Elastic { E: 2.1e11, nu: 0.3 };
        let stack = Stack::new(&Body::homogeneous(steel, Shape::Flat));
        let d = (1e-5, 1e-5);
        for (flat, z) in [(false, 0.0), (false, 0.4), (true, 0.0), (true, 3.0)] {
            let depth = stack.locate_depth(z * d.0, Some(0)).unwrap();
            let kernel = DepthKernel::new(&stack, depth, 1e-3, d).unwrap();
            for sample in [(0.0, 0.0), (0.5, 0.0), (2.0, -1.0), (-0.21, 0.37)] {
                let division = Division {
                    kernel: &kernel,
                    side: Side::Body2,
                    d,
                    flat,
                    sample,
                    z,
                    fineness: Fineness::single_point(flat),
                    cache: &RefCell::default(),
                };
                let mut parts = Vec::new();
                division.add_thirds(&mut parts, Whole::CELL);
                assert!(parts.iter().any(|part| part.shared.is_some()) || z == 0.0);
                for Part { at, shared, .. } in parts {
                    let Some(SharedPart { division, index }) = shared else {
                        continue;
                    };
                    assert_eq!(at, middles(flat, division)[index]);
                }
            }
        }
    }
}
