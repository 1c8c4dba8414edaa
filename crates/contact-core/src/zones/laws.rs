//! Laws of a traction at the border of a zone, where it vanishes: a power of it is linear in the
//! distance.

/// The power of a value that vanishes linearly at the border: the level.
#[derive(Clone, Copy, Debug)]
pub enum Power {
    One,
    Two,
    TwoThirds,
    Other(f64),
}

impl Power {
    /// The level of a value >= 0: the value to this power.
    pub(crate) fn level_of(self, value: f64) -> f64 {
        let value = value.max(0.0);
        match self {
            Self::One => value,
            Self::Two => value * value,
            Self::TwoThirds => value.cbrt().powi(2),
            Self::Other(power) => value.powf(power),
        }
    }
}

/// The laws of a stick zone's border, by the power of mu p - q . t that vanishes linearly.
pub const STICK: [Power; 2] = [Power::Two, Power::TwoThirds];
/// Index of the law of a zone that shrinks; the other law belongs to a zone that grows.
pub const SHRINKING: usize = 0;
