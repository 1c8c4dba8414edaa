//! A criterion as a function of two parts on a plane.

use crate::tangent::Tangent;

/// Weight of the second part b in the search for the plane of the largest first part a: a + TIE b
/// is maximised, which decides between planes of equal a. The planes found are then moved to the
/// maximum of a alone.
const TIE: f64 = 1e-7;

/// Planes tie if their values differ by less than this part: more than TIE, and than the error of a
/// maximum before it is refined.
const TIED: f64 = 2e-5;

/// The criterion as a function of its parts a and b.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Combination {
    /// a + w b.
    Sum(f64),
    /// a + w b on the plane where a is largest, and b the larger of equal ones; the search
    /// maximises a + tie b.
    First { weight: f64, tie: f64 },
    /// a b where b > 0.
    Product,
    /// a (1 + w b) where that is positive.
    Raised(f64),
}

impl Combination {
    /// The combination a + w b on the plane where the first part a is largest.
    pub(crate) fn on_largest_first_part(weight: f64) -> Self {
        Self::First { weight, tie: TIE }
    }

    /// Sets the weight of the tie for a history with this ratio of the sizes of a and b.
    pub(crate) fn for_ratio(self, ratio: f64) -> Self {
        match self {
            Self::First { weight, .. } => Self::First {
                weight,
                tie: TIE * ratio,
            },
            other => other,
        }
    }

    /// The function of the two parts that the search maximises.
    pub(crate) fn value(&self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::Sum(weight) => a + weight * b,
            Self::First { tie, .. } => a + tie * b,
            Self::Product => a * b.max(0.0),
            Self::Raised(weight) => a * (1.0 + weight * b).max(0.0),
        }
    }

    /// A [`Tangent`] of the criterion that is exact at these parts.
    pub(crate) fn tangent(&self, parts: [f64; 2]) -> Tangent {
        match *self {
            Self::Sum(weight) => Tangent::sum(weight),
            Self::First { tie, .. } => Tangent::sum(tie),
            Self::Product => Tangent::for_product(0.0, 1.0, parts),
            Self::Raised(weight) => Tangent::for_product(1.0, weight, parts),
        }
    }

    /// Relative difference of first parts below which two planes tie: [`TIED`] if the first part alone decides,
    /// else 0.
    pub(crate) fn tie(&self) -> f64 {
        if matches!(self, Self::First { .. }) {
            TIED
        } else {
            0.0
        }
    }

    /// The criterion on the plane that the search has found.
    pub(crate) fn criterion_value(&self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::First { weight, .. } => a + weight * b,
            _ => self.value([a, b]),
        }
    }

    /// A value that is not small, for tolerances: the criterion for this first part and a normal stress of 1.
    pub(crate) fn yardstick(&self, first: f64) -> f64 {
        match self {
            Self::Sum(weight) => first + weight,
            Self::First { .. } | Self::Product | Self::Raised(_) => first,
        }
    }
}
