//! The O(N^2) sum over all pairs of cells: the reference of the fast operators.

use ndarray::Array2;

use super::{Convolutions, Displacements, SurfaceOperator, Tractions};
use crate::kernels::{InfluenceCoefficients, Quadrant};

/// Cell-by-cell summation, eq. (2) of the paper, on the whole grid.
pub struct Direct {
    coefficients: InfluenceCoefficients,
    components: usize,
}

impl Direct {
    /// Builds the operator of a pair of bodies.
    pub fn new(coefficients: InfluenceCoefficients) -> Self {
        Self {
            coefficients,
            components: 0,
        }
    }

    /// u += sign * C * q by the direct sum over all pairs of cells. `c` has the coefficients at the offsets >=
    /// 0, and `odd` is their parity along x and along y.
    fn add(&self, u: &mut [f64], c: &Quadrant, odd: (bool, bool), sign: f64, q: &[f64]) {
        let (nx, ny) = self.shape();
        let coefficient = |i: usize, j: usize, k: usize, l: usize| {
            let changes_sign = (odd.0 && i < k) != (odd.1 && j < l);
            let value = c[(i.abs_diff(k), j.abs_diff(l))];
            if changes_sign { -value } else { value }
        };
        let q = Array2::from_shape_fn((nx, ny), |(k, l)| q[k * ny + l]);
        for (n, u) in u.iter_mut().enumerate() {
            let (i, j) = (n / ny, n % ny);
            *u += sign
                * q.indexed_iter()
                    .map(|((k, l), q)| coefficient(i, j, k, l) * q)
                    .sum::<f64>();
        }
    }
}

impl SurfaceOperator for Direct {
    fn shape(&self) -> (usize, usize) {
        self.coefficients.zz.dim()
    }

    /// Sums all nine kernels over all pairs of cells: the yardstick of the FFT.
    fn apply(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        let c = &self.coefficients;
        let (even, odd) = (false, true);
        let table = [
            [
                (&c.xx, (even, even), 1.0),
                (&c.xy, (odd, odd), 1.0),
                (&c.xz, (odd, even), 1.0),
            ],
            [
                (&c.xy, (odd, odd), 1.0),
                (&c.yy, (even, even), 1.0),
                (&c.yz, (even, odd), 1.0),
            ],
            [
                (&c.xz, (odd, even), -1.0),
                (&c.yz, (even, odd), -1.0),
                (&c.zz, (even, even), 1.0),
            ],
        ];
        let causes = [tractions.q_x, tractions.q_y, tractions.p];
        let effects = [displacements.u_x, displacements.u_y, displacements.u_z];
        self.components += causes.iter().flatten().count() + effects.iter().flatten().count();
        for (u, row) in effects.into_iter().zip(table) {
            let Some(u) = u else { continue };
            u.fill(0.0);
            for (q, (c, parity, sign)) in causes.iter().zip(row) {
                if let Some(q) = q {
                    self.add(u, c, parity, sign, q);
                }
            }
        }
    }

    fn work(&self) -> Convolutions {
        Convolutions::from_components(self.components)
    }

    fn is_coupled(&self) -> bool {
        true
    }

    fn self_coefficients(&self) -> (f64, f64) {
        (self.coefficients.xx[(0, 0)], self.coefficients.zz[(0, 0)])
    }
}
