//! The closed forms and series of `tests/data/rows.json`: an own collection of truths for this project, each
//! with the formula that it comes from.
#![allow(clippy::unwrap_used)] // a test may fail

mod air;
mod bed;
mod rows;
