//! Failures of the solvers.

/// A solver that stopped before its tolerance.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the {solver} solver stopped at {residual:.2e} m (tolerance {tolerance:.2e} m) after {iterations} iterations"
)]
pub struct SolverError {
    /// Name of the solver.
    pub solver: &'static str,
    /// Residual reached \[m\].
    pub residual: f64,
    /// Requested residual \[m\].
    pub tolerance: f64,
    /// Iterations done.
    pub iterations: usize,
}
