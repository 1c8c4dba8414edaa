//! Stage 4: ONE INCREMENT, the inner and the intermediate loop (figures 2 and 3 of the paper).
//!
//! - [`inner::normal`]: the pressure for known shear, eq. (5)-(6);
//! - [`inner::tangential`]: the shear for known pressure, eq. (7)-(8);
//! - [`intermediate::alternation`]: one after the other until neither changes what the other was solved for;
//! - [`no_slip`]: the displacement that means no slip, eq. (7).
//!
//! The solvers know no elasticity, only a [`SurfaceOperator`](crate::convolution::SurfaceOperator).
//! Each takes Params and gives Info or an Error with numbers. Lengths are those of the scene; a
//! tolerance is a length too, so that "how wrong" can be read off.

pub mod inner;
mod interface;
pub mod intermediate;
pub mod no_slip;
mod response;

pub use interface::Interface;
pub use response::Response;

use self::inner::Shear;

/// Largest shear under the pressure p, mu p \[Pa\].
pub(crate) fn friction_bound(mu: f64, p: f64) -> f64 {
    if p > 0.0 { mu * p } else { 0.0 }
}

/// A solver that stopped before its tolerance.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the {solver} solver stopped at {residual:.2e} m (tolerance {tolerance:.2e} m) after {iterations} iterations"
)]
pub struct SolverError {
    /// Which solver.
    pub solver: &'static str,
    /// Residual reached \[m\].
    pub residual: f64,
    /// Residual asked for \[m\].
    pub tolerance: f64,
    /// Iterations done.
    pub iterations: usize,
}
