//! Numbers of the command line that may have their unit: `20e-6`, `"20 um"`.

use contact_core::scene::quantity;

/// A length in m.
pub(crate) fn length(text: &str) -> Result<f64, String> {
    number("length", text)
}

/// A stress in Pa.
pub(crate) fn stress(text: &str) -> Result<f64, String> {
    number("residual", text)
}

/// Reads a number, alone or with a unit, by the key of its quantity.
fn number(key: &str, text: &str) -> Result<f64, String> {
    let plain = text.trim().parse();
    plain.or_else(|_| quantity(key, text).map_err(|allowed| format!("must be {allowed}")))
}
