//! The error that the increments leave along the path.
//!
//! The path is run through with n and with n/2 increments in each branch. What the shear at the end of
//! a branch changes by, over the largest shear of the path (L2), is a multiple of the error with n:
//!
//! ```text
//! error(n) = |q_n - q_(n/2)|/(2^order - 1) = error(n/2)/2^order
//! ```
//!
//! Where a branch has one increment only, the path is run through with n and with 2 n. The steps in which a contact grows
//! within an increment are halved and doubled with them.
//!
//! The error along the path hardly depends on the grid, so that a coarse one does, which takes a small
//! part of the time; the contact must span it well.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::choice::choose_increments;
use super::trial::{PathError, Trial};
use crate::error::Error;
use crate::scene::Scene;

/// The scene with the estimated error of the shear at the end of each branch.
///
/// Compared with half of the increments, or with twice as many where a branch has only one. Ends when
/// `stop` is raised.
pub fn estimate_path_error(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Scene, Error> {
    let mut estimated = choose_increments(scene, stop)?;
    if scene.path.is_open() {
        return Ok(estimated);
    }
    let errors = path_errors(scene, stop)?;
    for (branch, error) in estimated.path.branches.iter_mut().zip(errors) {
        branch.path_error = Some(error.q);
    }
    Ok(estimated)
}

/// What the increments of a path that has all of them leave at the end of each branch.
pub(crate) fn path_errors(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Vec<PathError>, Error> {
    if scene.friction.mu == 0.0 {
        // Pressure depends on the loads alone.
        let branches = scene.path.branches.iter();
        return Ok(branches.map(|_| PathError::default()).collect());
    }
    Trial::new(scene, stop)?.errors(&scene.path, |_| true)
}
