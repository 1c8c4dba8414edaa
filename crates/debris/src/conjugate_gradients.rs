//! Conjugate gradients with the modified incomplete Cholesky factor of the five-point scheme
//! (I. Gustafsson, BIT 18 (1978) 142-156).

use std::fmt;

use super::matrix::Matrix;

/// Part of the neglected fill-in that is added to the diagonal, and the least pivot over it.
const MODIFIED: f64 = 0.97;
const LEAST_PIVOT: f64 = 0.25;
/// Most iterations.
const MOST: usize = 20_000;

/// Conjugate gradients that do not reach their tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotConverged {
    /// Sum of the residuals.
    pub residual: f64,
    /// The largest allowed sum.
    pub tolerance: f64,
    /// Iterations done.
    pub iterations: usize,
}

impl fmt::Display for NotConverged {
    /// The message with the residual.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "conjugate gradients leave a residual of {:.1e}, above {:.1e}, after {} iterations",
            self.residual, self.tolerance, self.iterations
        )
    }
}

impl std::error::Error for NotConverged {}

/// Solves from the guess `x` until the sum of the residuals is below `tolerance`.
pub(crate) fn conjugate_gradients(
    matrix: &Matrix,
    b: &[f64],
    x: &mut [f64],
    tolerance: f64,
) -> Result<(), NotConverged> {
    let factor = Factor::new(matrix);
    let count = b.len();
    let [mut r, mut z, mut q] = [(); 3].map(|()| vec![0.0; count]);
    matrix.apply(x, &mut r);
    r.iter_mut().zip(b).for_each(|(r, b)| *r = b - *r);
    factor.solve(&r, &mut z);
    let mut d = z.clone();
    let mut square = dot(&r, &z);
    for iteration in 0..=MOST {
        let residual: f64 = r.iter().map(|r| r.abs()).sum();
        if residual <= tolerance {
            return Ok(());
        }
        if iteration == MOST || !(square > 0.0) {
            return Err(NotConverged {
                residual,
                tolerance,
                iterations: iteration,
            });
        }
        matrix.apply(&d, &mut q);
        let step = square / dot(&d, &q);
        for c in 0..count {
            x[c] += step * d[c];
            r[c] -= step * q[c];
        }
        factor.solve(&r, &mut z);
        let new_square = dot(&r, &z);
        let turn = new_square / square;
        square = new_square;
        d.iter_mut().zip(&z).for_each(|(d, z)| *d = z + turn * *d);
    }
    unreachable!("the last iteration returns")
}

/// The factor L of L L^T.
struct Factor<'a> {
    matrix: &'a Matrix,
    /// Inverse of its diagonal.
    inverse: Vec<f64>,
}

impl<'a> Factor<'a> {
    /// Factorises the matrix incompletely (zero fill-in), as the preconditioner.
    fn new(matrix: &'a Matrix) -> Self {
        let count = matrix.diagonal.len();
        // Entries towards +x and +y.
        let (mut east, mut north) = (vec![0.0; count], vec![0.0; count]);
        for c in 0..count {
            let ((west, w), (south, s)) = (matrix.west[c], matrix.south[c]);
            if west != 0.0 {
                east[w] = west;
            }
            if south != 0.0 {
                north[s] = south;
            }
        }
        let mut inverse = vec![0.0; count];
        for c in 0..count {
            let ((west, w), (south, s)) = (matrix.west[c], matrix.south[c]);
            let squares = [inverse[w] * inverse[w], inverse[s] * inverse[s]];
            let pivot = matrix.diagonal[c]
                - west * west * squares[0]
                - south * south * squares[1]
                - MODIFIED * (west * north[w] * squares[0] + south * east[s] * squares[1]);
            let pivot = if pivot < LEAST_PIVOT * matrix.diagonal[c] {
                matrix.diagonal[c]
            } else {
                pivot
            };
            inverse[c] = 1.0 / pivot.sqrt();
        }
        Self { matrix, inverse }
    }

    /// Applies the preconditioner: solves L L^T z = r.
    fn solve(&self, r: &[f64], z: &mut [f64]) {
        let Matrix { west, south, .. } = self.matrix;
        for c in 0..r.len() {
            let ((west, w), (south, s)) = (west[c], south[c]);
            let t = r[c] - west * self.inverse[w] * z[w] - south * self.inverse[s] * z[s];
            z[c] = t * self.inverse[c];
        }
        // Each cell passes its value on to the cells behind it.
        for c in (0..r.len()).rev() {
            let ((west, w), (south, s)) = (west[c], south[c]);
            z[c] *= self.inverse[c];
            let value = z[c];
            if west != 0.0 {
                z[w] -= west * self.inverse[w] * value;
            }
            if south != 0.0 {
                z[s] -= south * self.inverse[s] * value;
            }
        }
    }
}

/// Dot product.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
