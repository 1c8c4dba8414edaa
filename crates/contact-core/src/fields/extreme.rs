//! The largest value of a number below a contact, where it is, and how well it is known.

use super::{Depth, Zone};

/// The largest value of a number below a contact and where it is: a value at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// Value \[Pa or m\].
    pub value: f64,
    /// Place \[m\].
    pub x: f64,
    /// Place \[m\].
    pub y: f64,
    /// Depth and layer; at an interface that of the side named.
    pub depth: Depth,
    /// The border that it lies on, if any. At the rim of the contact a value depends on how well the
    /// tractions are known there, and a criterion of fatigue wants a mean over a critical distance.
    pub at: Option<Zone>,
    /// What may be wrong with the value.
    pub error: Errors,
}

/// What may be wrong with a largest value, by its sources, in the unit of the value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// What the search along x leaves.
    pub x: f64,
    /// What the search along y leaves.
    pub y: f64,
    /// What the search over the depths leaves.
    pub z: f64,
    /// What the cells leave of the tractions: by how much the value differs under the tractions of cells twice as
    /// large; none where that was not looked at.
    pub tractions: Option<f64>,
}

impl Errors {
    /// All together.
    pub fn sum(&self) -> f64 {
        self.x + self.y + self.z + self.tractions.unwrap_or_default()
    }
}

impl Extreme {
    /// The larger of two.
    #[must_use]
    pub fn or_larger(self, other: Self) -> Self {
        if other.value > self.value {
            other
        } else {
            self
        }
    }

    /// The largest of several; none where there is no number.
    pub fn largest(of: impl IntoIterator<Item = Self>) -> Option<Self> {
        let numbers = of.into_iter().filter(|e| !e.value.is_nan());
        numbers.reduce(Self::or_larger)
    }
}
