//! Rigid motions of body 1 against body 2, each free to balance its load or given.
//!
//! Three lie in the contact plane, three across it. A motion m displaces cell n by B m:
//!
//! ```text
//! in the plane      delta_x, delta_y, phi_z     B m = (m_0 - y m_2, m_1 + x m_2)
//! across it         delta_z, phi_x, phi_y       B m = m_0 + y m_1 - x m_2
//! ```
//!
//! and the sums of B^T times the traction are its forces and moments. Rotations are multiplied by
//! the length that x and y are divided by, so that every m is a length and every sum a traction.

use super::{Fields, sums};
use crate::scene::RigidMotion;

/// Lever arms of the cells.
#[derive(Clone, Debug, Default)]
pub struct Arms {
    /// The length \[m\] that x and y are measured in, and that turns rotations into lengths.
    pub length: f64,
    /// x of each cell over `length`.
    pub x: Vec<f64>,
    /// y of each cell over `length`.
    pub y: Vec<f64>,
    /// Factor of motions and displacements along y, and divisor of forces and tractions along y:
    /// elliptic friction becomes circular. The modes in the plane are (1, 0), (0, 1) and (-y,
    /// stretch x).
    pub axis_ratio: f64,
}

impl Arms {
    /// Factor from the motion k of [`RigidMotion::ALL`] \[m or rad\] to the length \[m\] that the solvers use
    /// for it: the length of the arms for rotations, the ratio of the friction coefficients for the shift along
    /// y, 1 for the others. The load of the motion is divided by it.
    pub(crate) fn motion_unit(&self, k: usize) -> f64 {
        match RigidMotion::ALL[k] {
            motion if motion.is_rotation() => self.length,
            RigidMotion::DeltaY => self.axis_ratio,
            _ => 1.0,
        }
    }

    /// Displacement of cell n along y in a unit rotation: its lever arm along x, over the length of the arms.
    pub(crate) fn turn_arm_x(&self, n: usize) -> f64 {
        self.axis_ratio * self.x[n]
    }

    /// B m in the plane at cell n \[m\].
    pub(crate) fn displacement_in_plane(&self, m: [f64; 3], n: usize) -> [f64; 2] {
        if m[2] == 0.0 {
            return [m[0], m[1]];
        }
        self.displacement_at([self.x[n], self.y[n]], m)
    }

    /// B m in the plane of a cell at these arms \[m\].
    pub(crate) fn displacement_at(&self, [x, y]: [f64; 2], m: [f64; 3]) -> [f64; 2] {
        [m[0] - y * m[2], m[1] + self.axis_ratio * x * m[2]]
    }

    /// x and y of the cells over the length, for sweeps.
    pub(crate) fn fields(&self) -> [&[f64]; 2] {
        [&self.x, &self.y]
    }

    /// B m across the plane at cell n \[m\].
    pub(crate) fn displacement_across(&self, m: [f64; 3], n: usize) -> f64 {
        if m[1] == 0.0 && m[2] == 0.0 {
            return m[0];
        }
        m[0] + self.y[n] * m[1] - self.x[n] * m[2]
    }

    /// B^T q in the plane, of cell n.
    pub(crate) fn loads_in_plane(&self, q: [f64; 2], n: usize) -> [f64; 3] {
        [q[0], q[1], self.turn_arm_x(n) * q[1] - self.y[n] * q[0]]
    }

    /// B^T p across the plane, of cell n.
    pub(crate) fn loads_across(&self, p: f64, n: usize) -> [f64; 3] {
        [p, self.y[n] * p, -self.x[n] * p]
    }

    /// The motion within `free` that fits displacements in the plane best: least weighted squares over the
    /// cells of `fields`. `weighted` returns the weight and the displacement of a cell.
    pub(crate) fn fit_in_plane<F: Fields>(
        &self,
        free: [bool; 3],
        fields: F,
        weighted: impl Fn(usize, F::Cell) -> (f64, [f64; 2]) + Sync,
    ) -> [f64; 3] {
        if !free[2] {
            let [count, a, b] = sums(fields, |n, cell| {
                let (w, [a, b]) = weighted(n, cell);
                [w, w * a, w * b]
            });
            let plane = [[count, 0.0, 0.0], [0.0, count, 0.0], [0.0; 3]];
            return product(&inverse(plane, free), [a, b, 0.0]);
        }
        let fields = (fields, [&self.x[..], &self.y]);
        let [count, x, y, r2, a, b, moment] = sums(fields, |n, (cell, [x, y])| {
            let (w, [a, b]) = weighted(n, cell);
            let (x, a, b) = (self.axis_ratio * x, w * a, w * b);
            [w, w * x, w * y, w * (x * x + y * y), a, b, x * b - y * a]
        });
        let plane = [[count, 0.0, -y], [0.0, count, x], [-y, x, r2]];
        product(&inverse(plane, free), [a, b, moment])
    }

    /// The motion within `free` that fits normal displacements best: least weighted squares over the cells of
    /// `fields`. `weighted` returns the weight and the displacement of a cell.
    pub(crate) fn fit_across<F: Fields>(
        &self,
        free: [bool; 3],
        fields: F,
        weighted: impl Fn(usize, F::Cell) -> (f64, f64) + Sync,
    ) -> [f64; 3] {
        if free == [true, false, false] {
            let [count, v] = sums(fields, |n, cell| {
                let (weight, v) = weighted(n, cell);
                [weight, weight * v]
            });
            let matrix = [[count, 0.0, 0.0], [0.0; 3], [0.0; 3]];
            return product(&inverse(matrix, free), [v, 0.0, 0.0]);
        }
        self.solve_across(free, fields, weighted, None)
    }

    /// The motion m within `free` for which the sums of the weights times B m are those in `required`.
    pub(crate) fn motion_for_sums(
        &self,
        free: [bool; 3],
        weights: &[f64],
        required: [f64; 3],
    ) -> [f64; 3] {
        self.solve_across(free, [weights], |_, [weight]| (weight, 0.0), Some(required))
    }

    /// Solves the normal equations of [`Self::fit_across`] for the motion; `required`, if given, replaces the
    /// weighted sums of the values.
    fn solve_across<F: Fields>(
        &self,
        free: [bool; 3],
        fields: F,
        weighted: impl Fn(usize, F::Cell) -> (f64, f64) + Sync,
        required: Option<[f64; 3]>,
    ) -> [f64; 3] {
        let fields = (fields, [&self.x[..], &self.y]);
        let [w, x, y, xx, xy, yy, v, vx, vy] = sums(fields, |n, (cell, [x, y])| {
            let (w, v) = weighted(n, cell);
            let (wx, wy, v) = (w * x, w * y, w * v);
            [w, wx, wy, wx * x, wx * y, wy * y, v, v * x, v * y]
        });
        let matrix = [[w, y, -x], [y, yy, -xy], [-x, -xy, xx]];
        product(&inverse(matrix, free), required.unwrap_or([v, vy, -vx]))
    }
}

/// The drive of three motions: prescribed, or free under prescribed loads.
#[derive(Clone, Copy, Debug, Default)]
pub struct Drive {
    /// Whether each motion is free to balance its load.
    pub free: [bool; 3],
    /// Sums of the traction that free motions balance \[Pa\]; zero where the motion is prescribed.
    pub sums: [f64; 3],
    /// Prescribed motions \[m\]; zero where they are free.
    pub given: [f64; 3],
}

/// A pivot below this part of its diagonal entry is rounding: the unknown is undetermined.
const PIVOT: f64 = 1e-13;

/// Inverse of a symmetric positive semidefinite matrix, restricted to the unknowns that are `free` and that it
/// determines. Rows and columns of the others are zero.
pub(crate) fn inverse<const N: usize>(matrix: [[f64; N]; N], free: [bool; N]) -> [[f64; N]; N] {
    let mut a = matrix;
    let mut is_kept = [false; N];
    for k in 0..N {
        let pivot = a[k][k];
        if !free[k] || pivot <= PIVOT * matrix[k][k] {
            continue;
        }
        is_kept[k] = true;
        for j in 0..N {
            a[k][j] /= if j == k { pivot * pivot } else { pivot };
        }
        for i in (0..N).filter(|&i| i != k) {
            let factor = a[i][k];
            for j in (0..N).filter(|&j| j != k) {
                a[i][j] -= factor * a[k][j];
            }
            a[i][k] = -factor / pivot;
        }
    }
    for k in 0..N {
        for l in 0..N {
            if !(is_kept[k] && is_kept[l]) {
                a[k][l] = 0.0;
            }
        }
    }
    a
}

/// Matrix times vector.
pub(crate) fn product<const N: usize>(matrix: &[[f64; N]; N], v: [f64; N]) -> [f64; N] {
    std::array::from_fn(|k| (0..N).map(|l| matrix[k][l] * v[l]).sum())
}

/// a + b
pub(crate) fn add_vectors(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + b[k])
}

#[cfg(test)]
mod tests {
    use crate::cells::{Arms, inverse, product};

    #[test]
    fn only_the_free_part_is_inverted() {
        let a = [[4.0, 1.0, 0.5], [1.0, 3.0, -0.2], [0.5, -0.2, 2.0]];
        let b = inverse(a, [true; 3]);
        for v in [[1.0, 2.0, 3.0], [-1.0, 0.5, 0.0]] {
            let back = product(&b, product(&a, v));
            assert!((0..3).all(|k| (back[k] - v[k]).abs() < 1e-14), "{back:?}");
        }
        let b = inverse(a, [true, false, true]);
        let det = 4.0 * 2.0 - 0.25;
        assert!((b[0][0] - 2.0 / det).abs() < 1e-15 && b[1].iter().all(|b| b.abs() <= 0.0));
        assert!((b[0][2] + 0.5 / det).abs() < 1e-15);
        // Twice the same motion: one of the two is left out.
        let b = inverse([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0; 3]], [true; 3]);
        let sizes: Vec<f64> = b
            .iter()
            .map(|row| row.iter().map(|b| b.abs()).sum())
            .collect();
        assert!(
            (sizes[0] - 1.0).abs() < 1e-15 && sizes[1] + sizes[2] <= 0.0,
            "{b:?}"
        );
    }

    #[test]
    fn a_rigid_motion_is_recovered() {
        let arms = Arms {
            length: 1.0,
            x: vec![0.0, 1.0, -1.0, 2.0],
            y: vec![0.5, 0.0, 1.0, -3.0],
            axis_ratio: 0.8,
        };
        let m = [0.3, -0.2, 0.7];
        let plane = arms.fit_in_plane([true; 3], [], |n, []| {
            (1.0, arms.displacement_in_plane(m, n))
        });
        let displacement: Vec<f64> = (0..4).map(|n| arms.displacement_across(m, n)).collect();
        let fitted_across = arms.fit_across([true; 3], [&displacement[..]], |_, [v]| (1.0, v));
        for k in 0..3 {
            assert!((plane[k] - m[k]).abs() < 1e-14 && (fitted_across[k] - m[k]).abs() < 1e-14);
        }
    }
}
