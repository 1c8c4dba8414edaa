//! Magnitudes that double precision carries through a solution.
//!
//! Numbers of a scene meet in products of up to four (an area times a modulus, a square of a length
//! over a radius), squared again where sums of squares are taken; between 1e-75 and 1e75 none of
//! them leaves the range of a double, 1e-308 to 1e308, unless they conspire, and the approach that
//! they result in is looked at too.

use crate::error::Error;

/// The smallest size of a number that counts.
pub const SMALLEST: f64 = 1e-75;
/// The largest.
pub const LARGEST: f64 = 1e75;

/// Fails at a size that is neither zero nor infinite nor within the range of the arithmetic.
pub(crate) fn check_range(smallest: f64, key: &str, value: f64) -> Result<(), Error> {
    let size = value.abs();
    if size == 0.0 || size == f64::INFINITY || (smallest..=LARGEST).contains(&size) {
        return Ok(());
    }
    let value = format!("{value:e}");
    let allowed = format!("0 or of a size from {smallest:e} to {LARGEST:e}");
    Err(Error::invalid(key, value, allowed))
}
