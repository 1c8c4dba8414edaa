//! The work of an operator in convolutions: a measure that does not jitter as times do.

use std::ops::{Add, AddAssign, Sub};

/// Work in convolutions of three tractions to three displacements.
///
/// A component of either counts as a sixth, and sixths are added as whole numbers: sums and
/// differences are exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Convolutions(usize);

/// Components of the tractions and of the displacements.
const COMPONENTS: usize = 6;

impl Convolutions {
    /// Larger than the work of any run.
    pub const MAX: Self = Self(usize::MAX);

    /// Work of convolving this number of components of tractions and displacements.
    pub fn from_components(components: usize) -> Self {
        Self(components)
    }

    /// Work of this number of convolutions of three tractions to three displacements.
    pub fn from_convolutions(convolutions: usize) -> Self {
        Self(COMPONENTS * convolutions)
    }

    /// Number of convolutions of three tractions to three displacements.
    #[allow(clippy::cast_precision_loss)] // a run comes to fewer than 2^53
    pub fn count(self) -> f64 {
        self.0 as f64 / COMPONENTS as f64
    }

    /// Returns what is left of this work once the work `done` is done, not below zero.
    #[must_use]
    pub fn remaining_after(self, done: Self) -> Self {
        Self(self.0.saturating_sub(done.0))
    }
}

impl Add for Convolutions {
    type Output = Self;

    fn add(self, addend: Self) -> Self {
        Self(self.0 + addend.0)
    }
}

impl AddAssign for Convolutions {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Convolutions {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}
