//! The symmetric matrix of the five-point scheme on the closed cells.
//!
//! A side between two closed cells has the conductance of both halves in series (the harmonic mean).
//! A border at the distance theta cells from a centre has a conductance of its own, without fit the
//! conductance of the cell over theta: symmetric, and of second order (F. Gibou, R. Fedkiw, L.-T. Cheng,
//! M. Kang, J. Comput. Phys. 176 (2002) 205-227).

use super::region::{Region, Side};

/// The matrix `diagonal + reaction - div(conductance grad)`.
pub(crate) struct Matrix {
    pub(crate) diagonal: Vec<f64>,
    /// Entry, and index of the neighbour, towards -x and -y; the entry is zero without one.
    pub(crate) west: Vec<(f64, usize)>,
    pub(crate) south: Vec<(f64, usize)>,
    /// Conductance of all borders of a cell together.
    pub(crate) border: Vec<f64>,
    /// Whether it is tridiagonal.
    pub(crate) is_line: bool,
}

impl Matrix {
    /// Assembles the matrix from the reaction of each closed cell and the `conductance` of a cell along
    /// an axis to a border at a distance \[cells\]; the distance 1 stands for a closed side.
    pub(crate) fn new(
        region: &Region,
        reaction: &[f64],
        conductance: impl Fn(usize, usize, f64) -> f64,
    ) -> Self {
        let count = region.cells.len();
        let mut matrix = Self {
            diagonal: reaction.to_vec(),
            west: vec![(0.0, 0); count],
            south: vec![(0.0, 0); count],
            border: vec![0.0; count],
            is_line: region.lattice.rows == 1,
        };
        for (c, sides) in region.sides.iter().enumerate() {
            for (k, side) in sides.iter().enumerate() {
                let scale = region.inverse_square(k);
                let along = |cell: usize, theta: f64| conductance(cell, k / 2, theta);
                match *side {
                    Side::Closed(n) => {
                        let entry = scale * harmonic_mean(along(c, 1.0), along(n, 1.0));
                        matrix.diagonal[c] += entry;
                        match k {
                            0 => matrix.west[c] = (-entry, n),
                            2 => matrix.south[c] = (-entry, n),
                            _ => {}
                        }
                    }
                    Side::Border(theta) => matrix.border[c] += scale * along(c, theta),
                    Side::Sealed => {}
                }
            }
            matrix.diagonal[c] += matrix.border[c];
        }
        matrix
    }

    /// Computes the product with x.
    pub(crate) fn apply(&self, x: &[f64], y: &mut [f64]) {
        for c in 0..x.len() {
            let ((west, w), (south, s)) = (self.west[c], self.south[c]);
            y[c] = self.diagonal[c] * x[c] + west * x[w] + south * x[s];
            y[w] += west * x[c];
            y[s] += south * x[c];
        }
    }
}

/// Harmonic mean; zero if one of the values is.
fn harmonic_mean(a: f64, b: f64) -> f64 {
    if a > 0.0 && b > 0.0 {
        2.0 * a * (b / (a + b))
    } else {
        0.0
    }
}
