//! The intermediate loop (figure 2 of the paper): pressure and shear in turn.

mod alternation;
mod anderson;
mod known_pressure;
mod precision;

pub use alternation::{AlternationInfo, AlternationParams, AlternationWorkspace, IncrementProblem};
pub use precision::alternation;
