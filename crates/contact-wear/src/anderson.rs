//! Anderson acceleration of a fixed point x = G(x) (D. G. Anderson, J. ACM 12 (1965) 547-560; H. F.
//! Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715-1735).

use std::collections::VecDeque;

use contact_core::linear_system::solve;
use ndarray::Array2;

/// Evaluations that are combined.
const DEPTH: usize = 6;
/// Regularisation of the least squares, over the largest mean square.
const RIDGE: f64 = 1e-10;

/// Differences of the last evaluations.
#[derive(Default)]
pub(crate) struct Anderson {
    last: Option<[Vec<f64>; 2]>,
    /// Changes of G and of the residual G(x) - x.
    changes: VecDeque<[Vec<f64>; 2]>,
}

impl Anderson {
    /// Returns the next x after an evaluation of G at x: the combination of the last values of G whose residual
    /// is least.
    pub(crate) fn accelerate(&mut self, x: &[f64], G: Vec<f64>) -> Vec<f64> {
        let residual: Vec<f64> = difference(&G, x);
        if let Some([last_G, last_residual]) = &self.last {
            let changes = [difference(&G, last_G), difference(&residual, last_residual)];
            self.changes.push_back(changes);
            if self.changes.len() > DEPTH {
                self.changes.pop_front();
            }
        }
        let mut accelerated = G.clone();
        for (weight, [change, _]) in self.weights(&residual).iter().zip(&self.changes) {
            for (value, change) in accelerated.iter_mut().zip(change) {
                *value -= weight * change;
            }
        }
        self.last = Some([G, residual]);
        accelerated
    }

    /// Weights of the last changes that leave the least residual, by least squares.
    fn weights(&self, residual: &[f64]) -> Vec<f64> {
        let count = self.changes.len();
        let product = |i: usize, j: usize| dot(&self.changes[i][1], &self.changes[j][1]);
        let largest = (0..count).fold(0.0, |m: f64, i| m.max(product(i, i)));
        if !(largest > 0.0) {
            return Vec::new();
        }
        let gram = Array2::from_shape_fn((count, count), |(i, j)| {
            product(i, j) + if i == j { RIDGE * largest } else { 0.0 }
        });
        let right = Array2::from_shape_fn((count, 1), |(i, _)| dot(&self.changes[i][1], residual));
        solve(&gram, &right).into_raw_vec_and_offset().0
    }
}

/// a - b
fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Dot product.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::Anderson;

    #[test]
    fn a_slow_linear_iteration_ends_in_a_few_steps() {
        // Four different factors: the fifth evaluation has the fixed point.
        let factors = [0.999, 0.97, 0.5, -0.3, 0.999, 0.5];
        let G = |x: &[f64]| -> Vec<f64> {
            x.iter()
                .zip(factors)
                .map(|(x, factor)| factor * x + 1.0)
                .collect()
        };
        let (mut x, mut anderson) = (vec![0.0; 6], Anderson::default());
        for _ in 0..7 {
            let image = G(&x);
            x = anderson.accelerate(&x, image);
        }
        for (x, factor) in x.iter().zip(factors) {
            assert!((x * (1.0 - factor) - 1.0).abs() < 1e-4, "{x} {factor}");
        }
    }
}
