//! Errors, with the numbers that explain them.

use std::fmt::Display;

/// Every failure of this crate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A value is out of its range.
    #[error("{key} = {value}: must be {allowed}")]
    Invalid {
        /// The wrong value.
        key: String,
        /// The value found.
        value: String,
        /// Allowed values.
        allowed: String,
    },
    /// The faces of a crack found no state of opening, stick and slip.
    #[error(
        "the crack has the length {length:.4e} m, the coefficient of friction {friction} and kinks of up \
         to {:.0} degrees. Its faces found no state of opening, stick and slip in {passes} passes, the load cut into \
         halves. {at_fault} of {points} points change from pass to pass. Kinks below 30 degrees settle{}",
        kink.to_degrees(),
        if *friction > 0.0 { ", or a smaller coefficient of friction" } else { "" }
    )]
    Faces {
        /// Length of the crack \[m\].
        length: f64,
        /// Coefficient of friction between the faces.
        friction: f64,
        /// The largest change of the crack's direction at a kink \[rad\].
        kink: f64,
        /// Linear systems solved.
        passes: usize,
        /// Points that broke their inequality after the last pass.
        at_fault: usize,
        /// Points of the crack.
        points: usize,
    },
    /// The system of the dislocations has no solution.
    #[error("the dislocations of the crack of length {length:.4e} m have no solution: {why}")]
    Singular {
        /// Length of the crack \[m\].
        length: f64,
        /// Remedy.
        why: String,
    },
}

impl Error {
    /// A value that must be something else.
    pub fn invalid(key: impl Display, value: impl Display, allowed: impl Display) -> Self {
        Self::Invalid {
            key: key.to_string(),
            value: value.to_string(),
            allowed: allowed.to_string(),
        }
    }
}
