//! Validity of the closed forms: checks of their arguments, for those that come from outside.
//!
//! The functions and types beside this file compute whatever they are given; who cannot vouch for
//! the arguments asks here first.

use contact_core::Error;
use contact_core::magnitude::{LARGEST, SMALLEST};
use contact_core::scene::Elastic;

/// Fails unless a number is positive and of a size from 1e-75 to 1e75, which no product of a closed
/// form leaves the range of a double with.
pub fn positive(key: &str, value: f64) -> Result<f64, Error> {
    if (SMALLEST..=LARGEST).contains(&value) {
        return Ok(value);
    }
    let allowed = format!("a positive number, {SMALLEST:e} to {LARGEST:e}");
    Err(Error::invalid(key, value, allowed))
}

/// Checks a number that may be zero.
pub fn not_negative(key: &str, value: f64) -> Result<f64, Error> {
    if value == 0.0 || (SMALLEST..=LARGEST).contains(&value) {
        return Ok(value);
    }
    let allowed = format!("0 or a positive number, {SMALLEST:e} to {LARGEST:e}");
    Err(Error::invalid(key, value, allowed))
}

/// Checks a number of either sign.
pub fn any_sign(key: &str, value: f64) -> Result<f64, Error> {
    not_negative(key, value.abs()).map(|_| value).map_err(|_| {
        Error::invalid(
            key,
            value,
            format!("a number of at most {LARGEST:e} in size"),
        )
    })
}

/// Fails unless a number is from `low` to `high`.
pub fn between(key: &str, value: f64, (low, high): (f64, f64)) -> Result<f64, Error> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(Error::invalid(key, value, format!("{low} to {high}")))
}

/// Fails unless a count is from 1 to `most`.
pub fn count(key: &str, value: usize, most: usize) -> Result<usize, Error> {
    if (1..=most).contains(&value) {
        return Ok(value);
    }
    Err(Error::invalid(key, value, format!("1 to {most}")))
}

/// Fails unless the materials of a pair have moduli of such sizes and one of them is elastic.
pub fn pair(bodies: (Elastic, Elastic)) -> Result<(Elastic, Elastic), Error> {
    for (key, material) in [("body 1", bodies.0), ("body 2", bodies.1)] {
        material.check(key)?;
        if !material.is_rigid() {
            positive(&format!("{key}.E"), material.E)?;
        }
    }
    if bodies.0.is_rigid() && bodies.1.is_rigid() {
        let allowed = "finite for one of the bodies at least";
        return Err(Error::invalid("body 2.E", "inf", allowed));
    }
    Ok(bodies)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_of_a_size_is_refused() {
        for bad in [f64::NAN, f64::INFINITY, -1.0, 1e300, 1e-300] {
            assert!(positive("R", bad).is_err() && not_negative("T", bad).is_err());
        }
        assert!(positive("R", 0.0).is_err() && not_negative("T", 0.0).is_ok());
        assert!(any_sign("T", -1.0).is_ok() && any_sign("T", f64::NEG_INFINITY).is_err());
        assert!(between("beta", 0.5, (-0.5, 0.5)).is_ok());
        assert!(between("beta", f64::NAN, (-0.5, 0.5)).is_err());
        assert!(count("n", 0, 9).is_err() && count("n", 10, 9).is_err());
        assert!(pair((Elastic::RIGID, Elastic::RIGID)).is_err());
    }
}
