//! How a criterion follows from two parts on a plane.

use crate::tangent::Tangent;

/// What the second quantity may add to the first while the plane of the largest first one is looked for, as a
/// part of it: enough to choose between equal planes. The planes found are then moved to the top of the first
/// quantity alone.
const TIE: f64 = 1e-7;

/// Part of the value from which on planes tie: more than TIE, and than what tops of pieces are off before
/// they are refined.
const TIED: f64 = 2e-5;

/// How the criterion follows from the two parts.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Law {
    /// a + w b.
    Sum(f64),
    /// a + w b where a is largest; of equal planes, that with the larger b, for which a + tie b is looked
    /// for.
    First { weight: f64, tie: f64 },
    /// a b where b > 0.
    Product,
    /// a (1 + w b) where that is positive.
    Raised(f64),
}

impl Law {
    /// a + w b where a is largest.
    pub(crate) fn first(weight: f64) -> Self {
        Self::First { weight, tie: TIE }
    }

    /// For a history whose first parts are small against its second ones by this ratio.
    pub(crate) fn for_ratio(self, ratio: f64) -> Self {
        match self {
            Self::First { weight, .. } => Self::First {
                weight,
                tie: TIE * ratio,
            },
            other => other,
        }
    }

    /// What is largest on the plane sought.
    pub(crate) fn value(&self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::Sum(weight) => a + weight * b,
            Self::First { tie, .. } => a + tie * b,
            Self::Product => a * b.max(0.0),
            Self::Raised(weight) => a * (1.0 + weight * b).max(0.0),
        }
    }

    /// What bounds it, closely where the parts are these.
    pub(crate) fn tangent(&self, parts: [f64; 2]) -> Tangent {
        match *self {
            Self::Sum(weight) => Tangent::sum(weight),
            Self::First { tie, .. } => Tangent::sum(tie),
            Self::Product => Tangent::of_product(0.0, 1.0, parts),
            Self::Raised(weight) => Tangent::of_product(1.0, weight, parts),
        }
    }

    /// Part of the value from which on planes tie, 0 where the first part alone does not decide.
    pub(crate) fn tie(&self) -> f64 {
        if matches!(self, Self::First { .. }) {
            TIED
        } else {
            0.0
        }
    }

    /// The criterion on the plane sought.
    pub(crate) fn there(&self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::First { weight, .. } => a + weight * b,
            _ => self.value([a, b]),
        }
    }

    /// A value that is not small: that of a first part and of normal stresses of 1.
    pub(crate) fn yardstick(&self, first: f64) -> f64 {
        match self {
            Self::Sum(weight) => first + weight,
            Self::First { .. } | Self::Product | Self::Raised(_) => first,
        }
    }
}
