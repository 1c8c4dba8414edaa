//! Words for states and directions, and numbers in the units that engineers read.

use contact_core::fields::Direction;
use contact_core::march::Status;

use crate::summary::short;

/// A length \[m\] in micrometres.
pub(crate) fn um(length: f64) -> String {
    format!("{} um", short(1e6 * length))
}

/// A value in Pa in MPa, in another unit as it is.
pub(crate) fn mega(value: f64, unit: &str) -> String {
    match unit {
        "Pa" => format!("{} MPa", short(1e-6 * value)),
        _ => format!("{} {unit}", short(value)),
    }
}

/// The state of the interface in words.
pub(crate) fn state(status: Status) -> &'static str {
    match status {
        Status::NoContact => "no contact",
        Status::FullStick => "full stick",
        Status::PartialSlip => "partial slip",
        Status::GrossSlip => "gross slip",
    }
}

/// The word of a direction, as in `pyfret.Result.loops`.
pub(crate) fn word(direction: Direction) -> &'static str {
    match direction {
        Direction::X => "x",
        Direction::Y => "y",
        Direction::Torsion => "torsion",
    }
}
