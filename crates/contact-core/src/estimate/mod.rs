//! HOW WRONG: the error of a run, and the increments for a tolerance. Runs load paths.

mod bar;
mod branch_ends;
mod choice;
mod coarser;
mod error_bars;
mod finer;
mod first_yield;
mod least_errors;
mod neighbour;
mod numbers;
mod path_error;
mod path_grid;
mod repeats;
mod trial;
mod two_runs;

pub use bar::Bar;
pub use branch_ends::BranchEnds;
pub use choice::{choose_increments, estimate_path_error};
pub use coarser::{coarsest, means};
pub use error_bars::{ErrorBars, ErrorMethod, error_bars};
pub use finer::finest;
pub use first_yield::first_yield;
pub use neighbour::choose_increments_like;
