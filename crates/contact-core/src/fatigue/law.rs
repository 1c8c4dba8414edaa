//! How a criterion follows from two parts on a plane.

use super::tangent::Tangent;

/// Weight of the second quantity where the plane is that of the largest first one: enough to choose
/// between equal planes, and too little to move the plane by more than this.
pub(super) const TIE: f64 = 1e-7;

/// Part of the value from which on planes tie: more than TIE, and than what tops of pieces are off before
/// they are refined.
const TIED: f64 = 2e-5;

/// How the criterion follows from the two parts.
#[derive(Clone, Copy, Debug)]
pub(super) enum Law {
    /// a + w b.
    Sum(f64),
    /// a b where b > 0.
    Product,
    /// a (1 + w b) where that is positive.
    Raised(f64),
}

impl Law {
    pub(super) fn value(&self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::Sum(weight) => a + weight * b,
            Self::Product => a * b.max(0.0),
            Self::Raised(weight) => a * (1.0 + weight * b).max(0.0),
        }
    }

    /// What bounds it, closely where the parts are these.
    pub(super) fn tangent(&self, parts: [f64; 2]) -> Tangent {
        match *self {
            Self::Sum(weight) => Tangent::sum(weight),
            Self::Product => Tangent::of_product(0.0, 1.0, parts),
            Self::Raised(weight) => Tangent::of_product(1.0, weight, parts),
        }
    }

    /// Part of the value from which on planes tie, 0 where the first part alone does not decide.
    pub(super) fn tie(&self) -> f64 {
        if matches!(*self, Self::Sum(weight) if weight == TIE) {
            TIED
        } else {
            0.0
        }
    }
}
