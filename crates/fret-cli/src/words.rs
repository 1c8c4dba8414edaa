//! Words for states and directions.

use contact_core::march::Status;
use contact_subsurface::Direction;

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
