//! Tractions along a crack per dislocation.

use ndarray::Array2;
use num_complex::Complex64;

use super::dislocation;
use super::rule::Rule;

/// The traction at every point per unit of the regular density at every dislocation: rows normal,
/// then shear; columns opening, then slip.
pub(crate) fn influence(rule: &Rule) -> Array2<f64> {
    let n = rule.points.len();
    let mut matrix = Array2::zeros((2 * n, 2 * n));
    let i = Complex64::i();
    for (j, from) in rule.dislocations.iter().enumerate() {
        // The kernel counts its direction as exp(i b) = sin(angle) + i cos(angle).
        for (k, to) in rule.points.iter().enumerate() {
            for (column, unit) in [(j, from.along), (n + j, from.along * i)] {
                let t = dislocation::traction(unit, from.at, to.along, to.at);
                matrix[[k, column]] = t.re * from.weight;
                matrix[[n + k, column]] = t.im * from.weight;
            }
        }
    }
    matrix
}
