//! The largest value of a number below a contact, its place and its error.

use contact_core::digits::place;

use super::{Depth, Line, Zone};

/// The largest value of a number below a contact, at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremum {
    /// Value \[Pa or m\].
    pub value: f64,
    /// Place \[m\].
    pub x: f64,
    /// Place \[m\].
    pub y: f64,
    /// Depth and layer; at an interface the layer on the side of the value.
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
    /// Error of the search along x.
    pub x: f64,
    /// Error of the search along y.
    pub y: f64,
    /// Error of the search along depth.
    pub z: f64,
    /// Error of the tractions: change of the value under the tractions on cells twice as large,
    /// times a factor. The factor is 2.4 within four cells of a border on a layer thinner than
    /// these, 0.55 on another rim of a contact, else 1. `None` if not computed.
    pub tractions: Option<f64>,
    /// Error of the solution: the error of the stress by the error of its tractions
    /// ([`Extremum::with_error_bars`]). `None` without error bars.
    pub solution: Option<f64>,
}

impl Errors {
    /// Collects the errors that a search found along its line, across it and in depth; the axis nearer to the
    /// line gets the first.
    pub fn from_search(line: Line, [along, across, z]: [f64; 3]) -> Self {
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

    /// The sum of the errors, for a number that is no linear function of the stress. The errors of
    /// a fatigue criterion may act together.
    pub fn sum(&self) -> f64 {
        let optional = [self.tractions, self.solution].into_iter().flatten();
        self.x + self.y + self.z + optional.sum::<f64>()
    }

    /// The root of the sum of the squares of the errors, since none causes another.
    pub fn total(&self) -> f64 {
        let optional = [self.tractions, self.solution].into_iter().flatten();
        let parts = [self.x, self.y, self.z].into_iter().chain(optional);
        parts.map(|part| part * part).sum::<f64>().sqrt()
    }
}

impl Extremum {
    /// Adds the error of the solution, from the relative error of the stress
    /// ([`contact_core::estimate::ErrorBars::stress`]).
    #[must_use]
    pub fn with_error_bars(mut self, stress: f64) -> Self {
        self.error.solution = Some(stress * self.value.abs());
        self
    }

    /// Sets coordinates that are zero to rounding to zero; `size` \[m\] is the size of the grid.
    #[must_use]
    pub fn snapped_to_zero(mut self, size: f64) -> Self {
        (self.x, self.y) = (place(self.x, size), place(self.y, size));
        self
    }

    /// The one of two extrema with the larger value.
    #[must_use]
    pub fn or_larger(self, other: Self) -> Self {
        if other.value > self.value {
            other
        } else {
            self
        }
    }

    /// The extremum with the largest value; `None` if all values are NaN.
    pub fn largest(values: impl IntoIterator<Item = Self>) -> Option<Self> {
        let numbers = values.into_iter().filter(|e| !e.value.is_nan());
        numbers.reduce(Self::or_larger)
    }
}
