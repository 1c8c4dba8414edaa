//! Elimination in the tridiagonal matrix of a line contact.

use super::matrix::Matrix;

/// Solves the system of a line contact without pivots. The matrix is diagonally dominant, and all of its
/// entries off the diagonal have the same sign, so that no digit of a small result is lost.
pub(crate) fn eliminate(matrix: &Matrix, b: &[f64], x: &mut [f64]) {
    let count = b.len();
    let mut pivot = matrix.diagonal.clone();
    x.copy_from_slice(b);
    for c in 1..count {
        let factor = matrix.west[c].0 / pivot[c - 1];
        pivot[c] -= factor * matrix.west[c].0;
        x[c] -= factor * x[c - 1];
    }
    for c in (0..count).rev() {
        let behind = if c + 1 < count {
            matrix.west[c + 1].0 * x[c + 1]
        } else {
            0.0
        };
        x[c] = (x[c] - behind) / pivot[c];
    }
}
