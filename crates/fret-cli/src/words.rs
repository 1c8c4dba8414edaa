//! Names of states and directions for people.

use contact_core::Scene;
use contact_core::march::Status;
use contact_subsurface::Direction;

/// Checks that a contact transmits no shear: it neither sticks nor slips, and has no stick ratio.
pub(crate) fn frictionless(scene: &Scene) -> bool {
    scene.friction.mu == 0.0
}

/// The state of the interface in words.
pub(crate) fn state(frictionless: bool, status: Status) -> &'static str {
    match status {
        Status::NoContact => "no contact",
        _ if frictionless => "no friction",
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
