//! Least squares of a few terms.

use crate::cells::{inverse, product};

/// Relative ridge of all terms but the first, which a few values may not determine.
pub(super) const RIDGE: f64 = 1e-6;

/// Normal equations of N terms for V right-hand sides; the first term has no ridge.
pub(in crate::march) struct LeastSquares<const N: usize, const V: usize> {
    gram: [[f64; N]; N],
    right: [[f64; N]; V],
}

impl<const N: usize, const V: usize> LeastSquares<N, V> {
    /// Sums without any place.
    pub(in crate::march) fn new() -> Self {
        Self {
            gram: [[0.0; N]; N],
            right: [[0.0; N]; V],
        }
    }

    /// Adds a place: its weight, the N terms there, and the V values that the fits should have.
    pub(in crate::march) fn add(&mut self, weight: f64, terms: [f64; N], values: [f64; V]) {
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

    /// Solves for the coefficients of the terms, for each of the V values.
    pub(in crate::march) fn factors(&self) -> [[f64; N]; V] {
        let mut ridged = self.gram;
        for (k, row) in ridged.iter_mut().enumerate().skip(1) {
            row[k] *= 1.0 + RIDGE;
        }
        let inverse = inverse(ridged, [true; N]);
        self.right.map(|right| product(&inverse, right))
    }

    /// The inner product sum fit(x) v(x) over all places x: of the fit with these factors, and of the values v
    /// of number `kind`.
    pub(in crate::march) fn fitted(&self, factors: &[f64; N], kind: usize) -> f64 {
        let terms = factors.iter().zip(self.right[kind]);
        terms.map(|(factor, right)| factor * right).sum()
    }
}
