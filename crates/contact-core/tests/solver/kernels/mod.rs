//! Influence coefficients, frequency responses and stress below a loaded cell: against tables made
//! with multi-precision arithmetic, in their limits, and against each other.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod bonds;
mod frf;
mod graded;
mod influence;
mod limits;
mod methods;
mod stress;
