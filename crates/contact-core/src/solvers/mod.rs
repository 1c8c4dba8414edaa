//! Stage 4: ONE INCREMENT, the inner and the intermediate loop (figures 2 and 3 of the paper).
//!
//! - [`normal`]: the pressure for known shear, eq. (5)-(6);
//! - [`tangential`]: the shear for known pressure, eq. (7)-(8);
//! - [`coupled`]: one after the other until neither changes what the other was solved for.
//!
//! The solvers know no elasticity, only a [`SurfaceOperator`](crate::convolution::SurfaceOperator).
//! Each takes Params and gives Info or an Error with numbers. Lengths are those of the scene; a
//! tolerance is a length too, so that "how wrong" can be read off.

mod admissible;
mod contact_cells;
mod contact_shear;
mod coupled;
mod interface;
mod limit;
mod mixing;
mod newton_step;
mod normal;
mod owed;
mod projected_gradient;
mod response;
mod rigid_motion;
mod shear;
mod shear_gradient;
mod sweep;
mod tangential;
mod vector;

pub(crate) use coupled::friction_bound;
pub use coupled::{
    CoupledInfo, CoupledParams, CoupledWorkspace, IncrementProblem, SlipDatum, coupled,
};
pub use interface::Interface;
pub use normal::{NormalInfo, NormalParams, NormalProblem, NormalWorkspace, normal};
pub use response::Response;
pub use rigid_motion::{Arms, Drive};
pub(crate) use rigid_motion::{inverse, product};
pub use shear::{Shear, TangentialInfo, TangentialMethod, TangentialParams, TangentialProblem};
pub(crate) use sweep::{set, sums, survey, sweep};
pub use tangential::{TangentialWorkspace, tangential};
pub(crate) use vector::{CHUNK, both, size};

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
