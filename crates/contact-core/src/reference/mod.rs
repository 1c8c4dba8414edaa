//! Closed forms: the truths the numerical solution is measured against.

mod hertz;

pub use hertz::{Hertz, hertz};
