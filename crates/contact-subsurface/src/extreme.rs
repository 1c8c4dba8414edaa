//! The largest value of a number below a contact, its place and its error.

use contact_core::digits::place;

use super::{Depth, Line, Zone};

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
    /// The border on which it lies, if any. At the rim of the contact a value depends on the
    /// accuracy of the tractions there; a fatigue criterion should be averaged over a critical
    /// distance.
    pub at: Option<Zone>,
    /// Error of the value.
    pub error: Errors,
}

/// Error of a largest value by source, in the unit of the value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Of the search along x.
    pub x: f64,
    /// Of the search along y.
    pub y: f64,
    /// Of the search along depth.
    pub z: f64,
    /// Of the tractions: change of the value under the tractions on cells twice as large; 2.4 times
    /// that within four cells of a border on a layer thinner than these, 0.55 times on another rim
    /// of a contact. `None` if not computed.
    pub tractions: Option<f64>,
    /// Of the solution: the error of the stress by that of its tractions
    /// ([`Extreme::with_error_bars`]); `None` without error bars.
    pub solution: Option<f64>,
}

impl Errors {
    /// Of a search along a line, across it and along depth: along the axis that the line is nearer
    /// to.
    pub fn along(line: Line, [along, across, z]: [f64; 3]) -> Self {
        let [cos, sin] = line.direction();
        let (x, y) = if cos.abs() >= sin.abs() {
            (along, across)
        } else {
            (across, along)
        };
        Self {
            x,
            y,
            z,
            ..Self::default()
        }
    }

    /// Their sum: of a number that is no linear function of the stress, such as that of a fatigue
    /// criterion, in which they may act together.
    pub fn sum(&self) -> f64 {
        let known = [self.tractions, self.solution].into_iter().flatten();
        self.x + self.y + self.z + known.sum::<f64>()
    }

    /// All of them together: the root of the sum of their squares, since none causes another.
    pub fn total(&self) -> f64 {
        let known = [self.tractions, self.solution].into_iter().flatten();
        let parts = [self.x, self.y, self.z].into_iter().chain(known);
        parts.map(|part| part * part).sum::<f64>().sqrt()
    }
}

impl Extreme {
    /// With the error of the solution, from that of the stress over its size
    /// ([`contact_core::estimate::ErrorBars::stress`]).
    #[must_use]
    pub fn with_error_bars(mut self, stress: f64) -> Self {
        self.error.solution = Some(stress * self.value.abs());
        self
    }

    /// With a place on a grid of this size \[m\] that is zero where it is zero to rounding.
    #[must_use]
    pub fn placed(mut self, size: f64) -> Self {
        (self.x, self.y) = (place(self.x, size), place(self.y, size));
        self
    }

    /// The larger of two.
    #[must_use]
    pub fn or_larger(self, other: Self) -> Self {
        if other.value > self.value {
            other
        } else {
            self
        }
    }

    /// The largest of several; `None` if all are NaN.
    pub fn largest(of: impl IntoIterator<Item = Self>) -> Option<Self> {
        let numbers = of.into_iter().filter(|e| !e.value.is_nan());
        numbers.reduce(Self::or_larger)
    }
}
