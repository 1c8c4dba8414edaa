//! Numbers in the units that engineers read.

use contact_core::digits::short;

/// A length \[m\] in micrometres.
pub(crate) fn um(length: f64) -> String {
    format!("{} um", short(1e6 * length))
}

/// A value in Pa in MPa, in another unit as it is.
pub(crate) fn mega(value: f64, unit: &str) -> String {
    match unit {
        "Pa" => format!("{} MPa", short(1e-6 * value)),
        "1" => short(value),
        _ => format!("{} {unit}", short(value)),
    }
}
