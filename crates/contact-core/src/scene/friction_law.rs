//! Friction laws of the user's own.

use std::fmt::Debug;
use std::sync::Arc;

use crate::error::{Error, LawError, Raised};

/// Cells, and what each has been through.
#[derive(Clone, Copy, Debug)]
pub struct CellHistory<'a> {
    /// Places of their centres \[m\].
    pub x: &'a [f64],
    /// See `x`.
    pub y: &'a [f64],
    /// Pressure \[Pa\].
    pub p: &'a [f64],
    /// Length of the way slipped \[m\].
    pub slip: &'a [f64],
    /// Energy dissipated per area \[J/m^2\].
    pub dissipated: &'a [f64],
}

/// A friction coefficient of place, pressure and history. Any type with this trait is one.
///
/// The coefficient at the end of an increment is that of the pressure and the history there: the
/// increment is solved again until it no longer changes.
pub trait FrictionLaw: Debug + Send + Sync {
    /// Writes the coefficient, finite and >= 0, of each cell. Where nothing is pressed (p = 0) it
    /// is ignored, and the friction's `mu` taken.
    fn coefficients(&self, cells: &CellHistory<'_>, mu: &mut [f64]) -> Result<(), LawError>;

    /// A number that two laws share only if they are the same.
    fn identity(&self) -> usize {
        std::ptr::from_ref(self).cast::<()>() as usize
    }

    /// Itself, for who wants to know what it is.
    fn as_any(&self) -> Option<&dyn std::any::Any> {
        None
    }

    /// Whether only its name is known: a store keeps no law of the user's own.
    fn is_elsewhere(&self) -> bool {
        false
    }
}

/// A law of the user's own, as part of a scene.
#[derive(Clone, Debug)]
pub struct OwnFriction(pub Arc<dyn FrictionLaw>);

impl PartialEq for OwnFriction {
    fn eq(&self, other: &Self) -> bool {
        self.0.identity() == other.0.identity()
    }
}

impl OwnFriction {
    /// A law.
    pub fn new(law: impl FrictionLaw + 'static) -> Self {
        Self(Arc::new(law))
    }

    /// The law of a store or of a scene file, which can only say that there is one.
    pub fn elsewhere() -> Self {
        Self::new(Elsewhere)
    }

    /// The coefficients of cells, `nominal` where nothing is pressed.
    pub(crate) fn coefficients(
        &self,
        cells: &CellHistory<'_>,
        nominal: f64,
        mu: &mut [f64],
    ) -> Result<(), Error> {
        if self.0.is_elsewhere() {
            return Err(is_missing());
        }
        let given = self.0.coefficients(cells, mu);
        given.map_err(|raised| Error::FrictionLaw {
            raised: Raised(raised),
        })?;
        for (n, mu) in mu.iter_mut().enumerate() {
            if cells.p[n] <= 0.0 {
                *mu = nominal;
            } else if !(*mu >= 0.0 && mu.is_finite()) {
                return Err(Error::invalid(
                    "friction.law",
                    format!(
                        "{mu} at x = {:.4e} m, y = {:.4e} m, p = {:.4e} Pa",
                        cells.x[n], cells.y[n], cells.p[n]
                    ),
                    "a finite coefficient >= 0 in every cell in contact",
                ));
            }
        }
        Ok(())
    }
}

/// The refusal of a law of which only its name is known.
pub fn is_missing() -> Error {
    Error::invalid(
        "friction.law",
        "own",
        "given again: a law of your own is in no file. pyfret.resume(store, friction_law=...) goes on with a store, \
         pyfret.wear.resume(store, friction_law=...) with a run of wear. scene.replace(friction=Friction(mu, law=...)) \
         gives it to a scene",
    )
}

#[derive(Debug)]
struct Elsewhere;

impl FrictionLaw for Elsewhere {
    fn coefficients(&self, _: &CellHistory<'_>, _: &mut [f64]) -> Result<(), LawError> {
        Err(Arc::new(is_missing()))
    }

    fn identity(&self) -> usize {
        0
    }

    fn is_elsewhere(&self) -> bool {
        true
    }
}
