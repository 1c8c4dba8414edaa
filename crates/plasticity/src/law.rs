//! The numbers of a material that yields.

use serde::{Deserialize, Serialize};

/// A number that is not allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key} = {value}: allowed is {allowed}")]
pub struct Error {
    /// Where it stands.
    pub key: String,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

/// Yielding after von Mises, with linear isotropic and linear kinematic hardening.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plastic {
    /// Yield stress s_y \[Pa\], positive.
    pub s_y: f64,
    /// Isotropic hardening H: growth of the yield stress per equivalent plastic strain \[Pa\], 0 or
    /// more (default 0).
    #[serde(default)]
    pub hardening: f64,
    /// Kinematic hardening C: back stress 2/3 C e_p \[Pa\], 0 or more (default 0).
    #[serde(default)]
    pub kinematic: f64,
}

impl Plastic {
    /// Fails at a number without meaning; `key` says where it stands.
    pub fn check(&self, key: &str) -> Result<(), Error> {
        let fail = |name: &str, value: f64, allowed: &'static str| {
            let key = format!("{key}.{name}");
            Err(Error {
                key,
                value,
                allowed,
            })
        };
        if !(self.s_y > 0.0 && self.s_y.is_finite()) {
            return fail("s_y", self.s_y, "a positive, finite yield stress in Pa");
        }
        for (name, value) in [("hardening", self.hardening), ("kinematic", self.kinematic)] {
            if !(value >= 0.0 && value.is_finite()) {
                return fail(name, value, "a finite modulus in Pa, 0 (none) or more");
            }
        }
        Ok(())
    }

    /// R(p) = s_y + H p \[Pa\].
    pub fn yield_stress(&self, p: f64) -> f64 {
        self.s_y + self.hardening * p
    }

    /// Whether the yield surface neither grows nor moves.
    pub fn is_perfect(&self) -> bool {
        self.hardening == 0.0 && self.kinematic == 0.0
    }
}
