//! Stage 5: THE LOAD PATH, one increment at a time.

mod fields;
mod increment;

pub use fields::Fields;
pub use increment::{Energy, Increment, Motion, Residuals, Status, Work};
