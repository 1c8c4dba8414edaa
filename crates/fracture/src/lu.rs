//! Dense linear systems: LU factors with partial pivoting, in blocks of columns.

use ndarray::linalg::general_mat_mul;
use ndarray::{Array1, Array2, Axis, s};

/// Columns that are eliminated together.
const BLOCK: usize = 48;

/// Factors of a square matrix with its rows exchanged.
#[derive(Clone, Debug)]
pub(crate) struct Lu {
    /// Unit lower and upper factor in one.
    factors: Array2<f64>,
    /// Row of the matrix that stands in each row of the factors.
    rows: Vec<usize>,
}

impl Lu {
    /// Factorises a matrix in place, with pivots; `None` for a singular one.
    pub(crate) fn new(mut factors: Array2<f64>) -> Option<Self> {
        let n = factors.nrows();
        let mut rows: Vec<usize> = (0..n).collect();
        for first in (0..n).step_by(BLOCK) {
            let last = (first + BLOCK).min(n);
            eliminate(factors.as_slice_mut()?, &mut rows, first, last)?;
            if last == n {
                break;
            }
            finish_rows(factors.as_slice_mut()?, n, first, last);
            let (above, mut below) = factors.view_mut().split_at(Axis(0), last);
            let left = below.slice(s![.., first..last]).to_owned();
            general_mat_mul(
                -1.0,
                &left,
                &above.slice(s![first.., last..]),
                1.0,
                &mut below.slice_mut(s![.., last..]),
            );
        }
        Some(Self { factors, rows })
    }

    /// Solves matrix x = right.
    pub(crate) fn solve(&self, right: &Array1<f64>) -> Array1<f64> {
        let n = self.rows.len();
        let mut x: Array1<f64> = self.rows.iter().map(|row| right[*row]).collect();
        for i in 0..n {
            let sum = self.factors.slice(s![i, ..i]).dot(&x.slice(s![..i]));
            x[i] -= sum;
        }
        for i in (0..n).rev() {
            let (row, known) = (self.factors.slice(s![i, i + 1..]), x.slice(s![i + 1..]));
            x[i] = (x[i] - row.dot(&known)) / self.factors[[i, i]];
        }
        x
    }
}

/// Eliminates the columns `first..last` of the rows from `first` on of a square matrix, within these
/// columns. Nothing for a singular matrix.
fn eliminate(a: &mut [f64], rows: &mut [usize], first: usize, last: usize) -> Option<()> {
    let n = rows.len();
    for k in first..last {
        let size = |i: &usize| a[i * n + k].abs();
        let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        let largest = size(&pivot);
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        if pivot != k {
            for j in 0..n {
                a.swap(k * n + j, pivot * n + j);
            }
            rows.swap(k, pivot);
        }
        let (above, below) = a.split_at_mut((k + 1) * n);
        let upper = &above[k * n..];
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / upper[k];
            row[k] = factor;
            for (x, u) in row[k + 1..last].iter_mut().zip(&upper[k + 1..last]) {
                *x -= factor * u;
            }
        }
    }
    Some(())
}

/// Takes the multiples of the rows `first..last` off each other beyond the column `last`.
fn finish_rows(a: &mut [f64], n: usize, first: usize, last: usize) {
    for i in first + 1..last {
        let (above, row) = a.split_at_mut(i * n);
        let (factors, row) = row[..n].split_at_mut(last);
        for k in first..i {
            let upper = &above[k * n + last..(k + 1) * n];
            for (x, u) in row.iter_mut().zip(upper) {
                *x -= factors[k] * u;
            }
        }
    }
}

/// Largest absolute entry.
pub(crate) fn largest(v: &Array1<f64>) -> f64 {
    v.iter().fold(0.0, |most, x| most.max(x.abs()))
}
