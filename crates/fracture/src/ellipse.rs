//! Estimate for a crack with a curved front.

use super::Error;

/// Factor from the plane value of K to the deepest point of a semi-elliptic surface crack of depth
/// a and half-length c, `aspect` = a/c in 0 < a/c <= 1; an estimate.
///
/// Ratio of Newman and Raju's K under uniform tension, (1.13 - 0.09 a/c)/sqrt(Q), Q = 1 + 1.464
/// (a/c)^1.65 (thick body), to the K of the straight front, 1.12152. The gradient along the depth is
/// in the plane value; that along the front is left out (too high where the stress falls sideways).
/// The fit itself holds to some 5 %.
///
/// J. C. Newman, I. S. Raju, NASA TM 85793 (1984).
pub fn ellipse_factor(aspect: f64) -> Result<f64, Error> {
    if !(aspect > 0.0 && aspect <= 1.0) {
        return Err(Error::invalid(
            "aspect a/c of the crack",
            aspect,
            "above 0 and up to 1",
        ));
    }
    let Q = 1.0 + 1.464 * aspect.powf(1.65);
    Ok((1.13 - 0.09 * aspect) / Q.sqrt() / STRAIGHT)
}

/// F of a normal edge crack under uniform tension (Koiter 1956).
pub(crate) const STRAIGHT: f64 = 1.121_522_255_231;
