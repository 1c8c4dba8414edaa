//! Stage 4: ONE INCREMENT, the inner and the intermediate loop (figures 2 and 3 of the paper).
//!
//! - [`inner::solve_normal`]: the pressure for known shear, eq. (5)-(6);
//! - [`inner::solve_tangential`]: the shear for known pressure, eq. (7)-(8);
//! - [`intermediate::solve_increment`]: one after the other until neither changes the other;
//! - [`no_slip`]: the displacement without slip, eq. (7).
//!
//! The solvers use elasticity only through a [`SurfaceOperator`](crate::convolution::SurfaceOperator).
//! Each takes Params and returns Info or an Error with numbers. Lengths are in metres of the scene; a
//! tolerance is a length too, so that it can be compared with displacements.

mod error;
pub mod inner;
mod interface;
pub mod intermediate;
pub mod no_slip;
mod response;

pub use error::SolverError;
pub(crate) use interface::friction_bound;
pub use interface::{Interface, Shear};
pub use response::Response;
