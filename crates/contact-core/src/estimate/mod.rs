//! HOW WRONG: the error of a run, and the increments that a tolerance asks for. Runs load paths.

mod error_bars;
mod finer;
mod numbers;
mod path_error;
mod trial;

pub use error_bars::{Bar, BranchEnds, ErrorBars, coarsest, error_bars, means};
pub use finer::finest;
pub use path_error::{choose_increments, estimate_path_error};
