//! A fit of few terms to values around.

use crate::cells::{inverse, product};

/// Regularisation of the terms after the first, which few values may not determine.
pub(super) const RIDGE: f64 = 1e-6;

/// Least squares of N terms, of which the first is preferred, to V kinds of values.
pub(super) struct LeastSquares<const N: usize, const V: usize> {
    gram: [[f64; N]; N],
    right: [[f64; N]; V],
}

impl<const N: usize, const V: usize> LeastSquares<N, V> {
    pub(super) fn new() -> Self {
        Self {
            gram: [[0.0; N]; N],
            right: [[0.0; N]; V],
        }
    }

    /// One place more, where the terms and the values are these.
    pub(super) fn add(&mut self, weight: f64, terms: [f64; N], values: [f64; V]) {
        for (row, term) in self.gram.iter_mut().zip(terms) {
            let weighted = weight * term;
            for (entry, other) in row.iter_mut().zip(terms) {
                *entry += weighted * other;
            }
        }
        for (right, value) in self.right.iter_mut().zip(values) {
            let weighted = weight * value;
            for (entry, term) in right.iter_mut().zip(terms) {
                *entry += weighted * term;
            }
        }
    }

    /// The factors of the terms, for each kind of values.
    pub(super) fn factors(&self) -> [[f64; N]; V] {
        let mut ridged = self.gram;
        for (k, row) in ridged.iter_mut().enumerate().skip(1) {
            row[k] *= 1.0 + RIDGE;
        }
        let inverse = inverse(ridged, [true; N]);
        self.right.map(|right| product(&inverse, right))
    }

    /// The sum of the product of the terms with these factors and a kind of values.
    pub(super) fn fitted(&self, factors: &[f64; N], kind: usize) -> f64 {
        let terms = factors.iter().zip(self.right[kind]);
        terms.map(|(factor, right)| factor * right).sum()
    }
}
