//! Stage 2: RESPONSE of a body to tractions on its surface.

mod coefficients;
mod half_space;

pub use coefficients::{InfluenceCoefficients, Quadrant};
pub use half_space::influence_coefficients;
