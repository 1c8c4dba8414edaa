//! The error of the increments along the path.
//!
//! The path is solved with n and with n/2 increments in each branch. The change of the shear at the
//! end of a branch, over the largest shear of the path (L2), is a multiple of the error with n:
//!
//! ```text
//! error(n) = |q_n - q_(n/2)|/(2^order - 1) = error(n/2)/2^order
//! ```
//!
//! Where a branch has a single increment, the path is solved with n and 2 n. The substeps of an
//! increment in which a contact grows are halved or doubled with them.
//!
//! The error along the path hardly depends on the grid: a coarse grid is used, which takes a small
//! part of the time; the contact must cover enough of its cells.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::path_grid::path_grid_errors;
use super::trial::Trial;
use super::two_runs::PathError;
use crate::error::Error;
use crate::scene::Scene;

/// A scene whose increments are all given with the estimated error of the shear at the end of each
/// branch.
pub(super) fn with_path_errors(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Scene, Error> {
    let mut estimated = scene.clone();
    let errors = path_errors(scene, stop)?;
    for (branch, error) in estimated.path.branches.iter_mut().zip(errors) {
        branch.path_error = Some(error.q);
    }
    Ok(estimated)
}

/// Errors at the end of each branch of a path whose increments are all given: of the increments and
/// of the grid that the path is solved on.
fn path_errors(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Vec<PathError>, Error> {
    let [mut errors, of_grid] = path_error_parts(scene, stop)?;
    for (error, of_grid) in errors.iter_mut().zip(&of_grid) {
        error.add_fields(of_grid);
    }
    Ok(errors)
}

/// Errors at the end of each branch of a path whose increments are all given: of the increments, and of the
/// grid that the path is solved on, none where that is the grid itself.
pub(crate) fn path_error_parts(
    scene: &Scene,
    stop: &Arc<AtomicBool>,
) -> Result<[Vec<PathError>; 2], Error> {
    if scene.friction.mu == 0.0 && !scene.yields() {
        // Without friction the pressure of elastic bodies depends on the loads alone, not on the path.
        let branches = scene.path.branches.iter();
        return Ok([branches.map(|_| PathError::default()).collect(), Vec::new()]);
    }
    let errors = Trial::new(scene, stop)?.errors(&scene.path, |_| true)?;
    Ok([errors, path_grid_errors(scene, stop)?])
}
