//! Stage 2: RESPONSE of a body to tractions on its surface.

mod coefficients;

pub use coefficients::{InfluenceCoefficients, Quadrant};
