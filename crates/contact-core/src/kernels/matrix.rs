//! Two-by-two matrices of the in-plane problem.

use std::ops::{Add, Mul, Neg, Sub};

/// \[\[a, b\], \[c, d\]\] as (a, b, c, d).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Matrix2(
    pub(crate) f64,
    pub(crate) f64,
    pub(crate) f64,
    pub(crate) f64,
);

impl Matrix2 {
    pub(crate) const ONE: Self = Self(1.0, 0.0, 0.0, 1.0);

    /// The inverse, by the determinant.
    pub(crate) fn inverse(self) -> Self {
        let det = self.0 * self.3 - self.1 * self.2;
        Self(self.3 / det, -self.1 / det, -self.2 / det, self.0 / det)
    }

    /// Largest absolute entry.
    pub(crate) fn size(self) -> f64 {
        let Self(a, b, c, d) = self;
        a.abs().max(b.abs()).max(c.abs()).max(d.abs())
    }

    /// The symmetric part, for products that are symmetric up to rounding.
    pub(crate) fn symmetric(self) -> Self {
        let b = f64::midpoint(self.1, self.2);
        Self(self.0, b, b, self.3)
    }
}

impl Add for Matrix2 {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self(self.0 + o.0, self.1 + o.1, self.2 + o.2, self.3 + o.3)
    }
}

impl Sub for Matrix2 {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl Neg for Matrix2 {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Mul<f64> for Matrix2 {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self(self.0 * s, self.1 * s, self.2 * s, self.3 * s)
    }
}

impl Mul for Matrix2 {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self(
            self.0 * o.0 + self.1 * o.2,
            self.0 * o.1 + self.1 * o.3,
            self.2 * o.0 + self.3 * o.2,
            self.2 * o.1 + self.3 * o.3,
        )
    }
}
