//! How much the shear scatters from cell to cell where the bodies stick.
//!
//! Where a contact grows, a cell that comes to stick within an increment is taken to have stuck
//! from its start. The slip that is missing differs from ring to ring of cells, and so does the
//! error of the shear, while the shear itself has a smooth course. The sixth difference of samples
//! along rows and columns of cells leaves the errors alone:
//!
//! ```text
//! s^2 = mean of (D q)^2/924,   D q = q_-3 - 6 q_-2 + 15 q_-1 - 20 q_0 + 15 q_1 - 6 q_2 + q_3
//! ```
//!
//! 924 being the sum of the squares of the coefficients, so that s is the root mean square of errors
//! that are independent of each other. Where the shear has turned, s also contains the bends that
//! earlier borders of the stick zone left in it.

use crate::cells::Lattice;
use crate::march::domain::Geometry;
use crate::plan::{Mirror, Parity};
use crate::solvers::Interface;

/// Coefficients of the sixth difference.
const SIXTH: [f64; 7] = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];
/// Samples of a line that stick, so that the difference is taken from those between: the shear has
/// an infinite slope at the border of the stick zone.
const LINE: usize = SIXTH.len() + 2;
/// Samples across the radius of the contact: rings of errors may be several cells of a fine grid
/// wide, and any sample has its part of them. With 21 samples a shear in any number of increments
/// scatters by up to five times the error of chosen ones.
pub(in crate::march) const SAMPLES: f64 = 32.0;

/// Scatter of the shear from cell to cell \[Pa\], root mean square over the contact. Samples are farther apart
/// where it has many cells across its radius (`cells_per_radius`). `None` where no line has enough sticking
/// samples in a row.
pub(super) fn scatter(
    geometry: &Geometry,
    mirror: Mirror,
    now: &Interface,
    cells_per_radius: f64,
) -> Option<f64> {
    let lattice = Lattice::new(&geometry.grid, mirror);
    let columns = geometry.grid.nx as isize;
    let rows = lattice.rows() as isize;
    let first = if lattice.is_mirrored() { -rows } else { 0 };
    let stick = |n: usize| now.p[n] > 0.0 && !now.slips[n];
    let shear = |(i, j): (isize, isize)| {
        let n = lattice.stored_cell(i, j).filter(|&n| stick(n))?;
        let odd = if j < 0 { Parity::Odd.sign() } else { 1.0 };
        Some([now.q[0][n], odd * now.q[1][n]])
    };
    let stride = ((cells_per_radius / SAMPLES) as usize).max(1);
    let row = |j: isize| -> Vec<_> { (0..columns).map(|i| shear((i, j))).collect() };
    let column = |i: isize| -> Vec<_> { (first..rows).map(|j| shear((i, j))).collect() };
    let along_x = mean((0..rows).map(row), stride);
    let along_y = mean((0..columns).map(column), stride);
    let square = match (along_x, along_y) {
        (Some(x), Some(y)) => 0.5 * (x + y),
        (of_one, None) | (None, of_one) => of_one?,
    };
    let cells = now.p.iter().enumerate().filter(|(_, p)| **p > 0.0);
    let sticking = cells.clone().filter(|(n, _)| stick(*n)).count();
    Some((square * sticking as f64 / cells.count() as f64).sqrt())
}

/// Mean square of the scatter over lines of cells, from the sixth differences of samples `stride` cells apart;
/// none if no line has enough samples.
fn mean(lines: impl Iterator<Item = Vec<Option<[f64; 2]>>>, stride: usize) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    for line in lines {
        for start in 0..line.len().saturating_sub((LINE - 1) * stride) {
            let samples = line[start..].iter().step_by(stride).take(LINE);
            if !samples.clone().all(Option::is_some) {
                continue;
            }
            let mut difference = [0.0; 2];
            for (c, [x, y]) in SIXTH.iter().zip(samples.flatten().skip(1)) {
                difference = [difference[0] + c * x, difference[1] + c * y];
            }
            sum += difference.iter().map(|d| d * d).sum::<f64>();
            count += 1.0;
        }
    }
    let squares: f64 = SIXTH.iter().map(|c| c * c).sum();
    (count > 0.0).then(|| sum / (squares * count))
}
