//! Friction laws.

use crate::error::Error;

/// Coulomb's law: `|q| <= mu p`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Friction coefficient mu >= 0.
    pub mu: f64,
}

impl Friction {
    pub(crate) fn check(&self) -> Result<(), Error> {
        if !(self.mu >= 0.0 && self.mu.is_finite()) {
            return Err(Error::invalid(
                "friction.mu",
                self.mu,
                "a finite number >= 0",
            ));
        }
        Ok(())
    }
}
