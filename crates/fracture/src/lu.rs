//! Dense linear systems: LU factors with partial pivoting.

use ndarray::{Array1, Array2};

/// Factors of a square matrix with its rows exchanged.
#[derive(Clone, Debug)]
pub(crate) struct Lu {
    /// Unit lower and upper factor in one.
    factors: Array2<f64>,
    /// Row of the matrix that stands in each row of the factors.
    rows: Vec<usize>,
}

impl Lu {
    /// Nothing for a singular matrix.
    pub(crate) fn new(mut factors: Array2<f64>) -> Option<Self> {
        let n = factors.nrows();
        let mut rows: Vec<usize> = (0..n).collect();
        let a = factors.as_slice_mut()?;
        for k in 0..n {
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
                for (x, u) in row[k + 1..].iter_mut().zip(&upper[k + 1..]) {
                    *x -= factor * u;
                }
            }
        }
        Some(Self { factors, rows })
    }

    /// The x of matrix x = right.
    pub(crate) fn solve(&self, right: &Array1<f64>) -> Array1<f64> {
        let n = self.rows.len();
        let mut x: Array1<f64> = self.rows.iter().map(|row| right[*row]).collect();
        for i in 0..n {
            let sum: f64 = (0..i).map(|j| self.factors[[i, j]] * x[j]).sum();
            x[i] -= sum;
        }
        for i in (0..n).rev() {
            let sum: f64 = (i + 1..n).map(|j| self.factors[[i, j]] * x[j]).sum();
            x[i] = (x[i] - sum) / self.factors[[i, i]];
        }
        x
    }

    /// The inverse of the matrix.
    pub(crate) fn inverse(&self) -> Array2<f64> {
        let n = self.rows.len();
        let mut inverse = Array2::zeros((n, n));
        for j in 0..n {
            let unit = Array1::from_shape_fn(n, |i| f64::from(u8::from(i == j)));
            inverse.column_mut(j).assign(&self.solve(&unit));
        }
        inverse
    }
}

/// Largest absolute entry.
pub(crate) fn largest(v: &Array1<f64>) -> f64 {
    v.iter().fold(0.0, |most, x| most.max(x.abs()))
}
