//! The tangent space of the tangential problem: the admissible changes of the shear, cell by cell.

use crate::cells::{product, sweep};

/// A field of two components.
pub(super) type Pair = [Vec<f64>; 2];

/// The tangent space: the projection Pi on it, and the projections of tractions on zero sums and of
/// displacements on the complement of the rigid motions.
///
/// A cell of large curvature D hardly moves, so that a rigid motion subtracted from all cells alike
/// would be far too large for it. It is therefore weighted by w = 1/(1 + D/C_xx(0,0)): tractions t
/// become t - w Pi B m with B^T t = 0, displacements v become v - Pi B m with B^T w v = 0, and the
/// products t.v do not change.
#[derive(Debug)]
pub(super) struct Tangent {
    /// Direction across the shear of slip cells, along which alone it may change; zero in stick
    /// cells.
    pub(super) across: Pair,
    /// Lever arms of the contact cells; empty where the rotation is not free.
    pub(super) arms: Pair,
    /// w
    pub(super) weight: Vec<f64>,
    /// Inverse of B^T w Pi B.
    pub(super) inverse_sum: [[f64; 3]; 3],
}

/// The tangent space of one cell.
#[derive(Clone, Copy)]
pub(super) struct CellTangent {
    pub(super) across: [f64; 2],
    pub(super) arm: [f64; 2],
    pub(super) weight: f64,
}

impl Tangent {
    /// Allocates fields for `cells` cells.
    pub(super) fn new(cells: usize) -> Self {
        let field = || Vec::with_capacity(cells);
        Self {
            across: [field(), field()],
            arms: [field(), field()],
            weight: field(),
            inverse_sum: [[0.0; 3]; 3],
        }
    }

    /// Directions, lever arms, weights. Where the rotation is not free any field does for the arms:
    /// [`Self::inverse_sum`] has no part of it.
    pub(super) fn fields(&self) -> [&[f64]; 5] {
        let [t_x, t_y] = &self.across;
        let [a_x, a_y] = if self.arms[0].is_empty() {
            &self.across
        } else {
            &self.arms
        };
        [t_x, t_y, a_x, a_y, &self.weight]
    }

    /// Sets v = Pi `value(v, from)` in each cell. Returns the motion m to be subtracted, for which the sums of `sums(v)` vanish,
    /// and the sum of v times the second result of `value`.
    pub(super) fn project<const N: usize>(
        &self,
        v: &mut Pair,
        sums: impl Fn(CellTangent, [f64; 2]) -> [f64; 3] + Sync,
        from: [&[f64]; N],
        value: impl Fn([f64; 2], [f64; N]) -> ([f64; 2], [f64; 2]) + Sync,
    ) -> ([f64; 3], f64) {
        let [v_x, v_y] = v;
        let from = (self.fields(), from);
        let [x, y, turn, along] = sweep(from, [v_x, v_y], |_, (of_cell, from), v| {
            let cell = CellTangent::from_fields(of_cell);
            let (v, with) = value(v, from);
            let v = cell.project(v);
            let [x, y, turn] = sums(cell, v);
            (v, [x, y, turn, v[0] * with[0] + v[1] * with[1]])
        });
        (product(&self.inverse_sum, [x, y, turn]), along)
    }
}

impl CellTangent {
    /// The tangent space of one cell, from its values in [`Tangent::fields`].
    pub(super) fn from_fields([t_x, t_y, a_x, a_y, weight]: [f64; 5]) -> Self {
        Self {
            across: [t_x, t_y],
            arm: [a_x, a_y],
            weight,
        }
    }

    /// Pi v, with t_x^2 and not the equal 1 - e_x^2: for shear nearly along an axis that difference
    /// is rounding, which matters where few cells stick and slip cells carry the free motion.
    pub(super) fn project(self, v: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.across;
        let along = x * v[0] + y * v[1];
        let sticks = x == 0.0 && y == 0.0;
        if sticks { v } else { [along * x, along * y] }
    }

    /// B^T v
    pub(super) fn sums(self, [a, b]: [f64; 2]) -> [f64; 3] {
        let [x, y] = self.arm;
        [a, b, x * b - y * a]
    }

    /// The part of this cell in the matrix B^T w Pi B: its entries xx, xy, yy, xr, yr, rr.
    pub(super) fn gram(self) -> [f64; 6] {
        let [x, y] = self.arm;
        let (x_projected, y_projected) = (self.project([1.0, 0.0]), self.project([0.0, 1.0]));
        let rotation = self.project([-y, x]);
        let rotation_sum = x * rotation[1] - y * rotation[0];
        [
            x_projected[0],
            x_projected[1],
            y_projected[1],
            rotation[0],
            rotation[1],
            rotation_sum,
        ]
        .map(|of| self.weight * of)
    }

    /// The part of this cell in B^T w v: the weighted sums of v along x and y and its moment, where B maps a
    /// shift along x and y and a rotation to the displacement of the cell.
    pub(super) fn weighted_sums(self, v: [f64; 2]) -> [f64; 3] {
        self.sums(v).map(|m| self.weight * m)
    }

    /// v - Pi B m
    pub(super) fn subtract_motion(self, m: [f64; 3], v: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.arm;
        let rigid = self.project([m[0] - y * m[2], m[1] + x * m[2]]);
        [v[0] - rigid[0], v[1] - rigid[1]]
    }
}
