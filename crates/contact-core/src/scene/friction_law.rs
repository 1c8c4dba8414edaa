//! Friction laws written by the user.

use std::fmt::Debug;
use std::sync::Arc;

use crate::error::{Error, LawError, Raised};

/// Cells with their pressure and history.
#[derive(Clone, Copy, Debug)]
pub struct CellHistory<'a> {
    /// Coordinates of their centres along x \[m\].
    pub x: &'a [f64],
    /// Coordinates of their centres along y \[m\].
    pub y: &'a [f64],
    /// Pressure \[Pa\].
    pub p: &'a [f64],
    /// Distance slipped \[m\].
    pub slip: &'a [f64],
    /// Energy dissipated per area \[J/m^2\].
    pub dissipated: &'a [f64],
    /// Depth worn off body 1 and body 2 \[m\]; zero but in runs of wear.
    pub worn: [&'a [f64]; 2],
    /// Layer of body 1 and body 2 that wear has exposed, from 0 for the outermost.
    pub layer: [&'a [f64]; 2],
    /// Debris per area \[m\].
    pub bed: &'a [f64],
    /// Share of the cell that oxygen reaches; 1 without a model of the air.
    pub aerated: &'a [f64],
}

/// A friction coefficient as a function of position, pressure and history.
///
/// The coefficient at the end of an increment belongs to the pressure and the history there: the
/// increment is solved again until it no longer changes. In a run of wear the law also sees the surface that
/// is there: [`CellHistory`] has the worn depths, the exposed layers, the debris bed and the aerated share.
/// They are constant within a cycle.
pub trait FrictionLaw: Debug + Send + Sync {
    /// Writes the coefficient, finite and >= 0, of each cell. Where nothing is pressed (p = 0) it
    /// is ignored, and the friction's `mu` taken.
    fn coefficients(&self, cells: &CellHistory<'_>, mu: &mut [f64]) -> Result<(), LawError>;

    /// A number that two laws share only if they are the same.
    fn identity(&self) -> usize {
        std::ptr::from_ref(self).cast::<()>() as usize
    }

    /// Returns the law itself for a downcast to its type.
    fn as_any(&self) -> Option<&dyn std::any::Any> {
        None
    }

    /// Whether the law itself is missing: a store keeps only the fact that there was one.
    fn is_unavailable(&self) -> bool {
        false
    }
}

/// A user's law, as part of a scene.
#[derive(Clone, Debug)]
pub struct UserFriction(pub Arc<dyn FrictionLaw>);

impl PartialEq for UserFriction {
    fn eq(&self, other: &Self) -> bool {
        self.0.identity() == other.0.identity()
    }
}

impl UserFriction {
    /// A law.
    pub fn new(law: impl FrictionLaw + 'static) -> Self {
        Self(Arc::new(law))
    }

    /// Stands for the law of a store or of a scene file, where the function itself is not kept.
    pub fn unavailable() -> Self {
        Self::new(UnavailableLaw)
    }

    /// Writes the coefficients of cells, `nominal` where the pressure is zero.
    pub fn coefficients(
        &self,
        cells: &CellHistory<'_>,
        nominal: f64,
        mu: &mut [f64],
    ) -> Result<(), Error> {
        if self.0.is_unavailable() {
            return Err(missing_law_error());
        }
        let result = self.0.coefficients(cells, mu);
        result.map_err(|raised| Error::FrictionLaw {
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

/// The error for a run with a user's law whose function is not there, since a store or file keeps its name
/// only.
pub fn missing_law_error() -> Error {
    Error::invalid(
        "friction.law",
        "own",
        "given again: a law of your own is in no file. pyfret.resume(store, friction_law=...) goes on with a store, \
         pyfret.wear.resume(store, friction_law=...) with a run of wear. scene.replace(friction=Friction(mu, law=...)) \
         gives it to a scene",
    )
}

#[derive(Debug)]
struct UnavailableLaw;

impl FrictionLaw for UnavailableLaw {
    fn coefficients(&self, _: &CellHistory<'_>, _: &mut [f64]) -> Result<(), LawError> {
        Err(Arc::new(missing_law_error()))
    }

    fn identity(&self) -> usize {
        0
    }

    fn is_unavailable(&self) -> bool {
        true
    }
}
