//! HOW WRONG: the error of a run, and the increments that a tolerance asks for. Runs load paths.

mod choice;
mod error_bars;
mod finer;
mod numbers;
mod path_error;
mod trial;

pub use choice::choose_increments;
pub use error_bars::{Bar, BranchEnds, ErrorBars, coarsest, error_bars, means};
pub use finer::finest;
pub use path_error::estimate_path_error;
