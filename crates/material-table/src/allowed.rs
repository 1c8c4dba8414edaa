//! The range of a number.

/// The range of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Allowed {
    /// A stress \[Pa\], positive.
    Stress,
    /// A weight, 0 or more.
    Weight,
    /// Poisson's ratio.
    Poisson,
    /// Positive, of any unit.
    Positive,
    /// Negative: the exponent of a falling curve.
    Negative,
}

impl Allowed {
    /// Whether a value is allowed.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Stress | Self::Positive => value > 0.0,
                Self::Weight => value >= 0.0,
                Self::Poisson => value > -1.0 && value <= 0.5,
                Self::Negative => value < 0.0,
            }
    }

    /// The requirement in words.
    pub fn wanted(self) -> &'static str {
        match self {
            Self::Stress => "a positive stress in Pa",
            Self::Weight => "a weight, 0 or more",
            Self::Poisson => "-1 < nu <= 0.5",
            Self::Positive => "positive",
            Self::Negative => "negative",
        }
    }
}
