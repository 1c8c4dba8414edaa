//! The intermediate loop (figure 2 of the paper): pressure and shear in turn.

mod alternation;
mod anderson;
mod known_pressure;
mod lifted;
mod precision;
mod problem;

pub use precision::solve_increment;
pub use problem::{AlternationInfo, AlternationParams, AlternationWorkspace, IncrementProblem};
