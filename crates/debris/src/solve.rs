//! The solver that suits a matrix.

use super::conjugate_gradients::{NotConverged, conjugate_gradients};
use super::matrix::Matrix;
use super::tridiagonal::eliminate;

/// Solves for the right-hand side `b` from the guess `x`, until the sum of the residuals is below
/// `tolerance`; exactly in a line.
pub(crate) fn solve(
    matrix: &Matrix,
    b: &[f64],
    x: &mut [f64],
    tolerance: f64,
) -> Result<(), NotConverged> {
    if matrix.is_line {
        eliminate(matrix, b, x);
        return Ok(());
    }
    conjugate_gradients(matrix, b, x, tolerance)
}
