//! How far the cells are off: the same path on a grid of half as many cells each way.
//!
//! An error that falls like the m-th power of the cell leaves a difference f - c of the fine and the
//! coarse grid that is 2^m - 1 times the error of the fine one (Richardson).

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use super::{BranchSummary, Increment, March, estimate_path_error, summarise};
use crate::error::Error;
use crate::scene::{Grid, SaveFields, Scene};

/// Order m of numbers that follow from the rim or the border of a zone.
const RIM: f64 = 1.0;
/// Order m of all others.
const SMOOTH: f64 = 1.5;

/// Estimated errors of the numbers at the end of a branch, >= 0: those that the cells leave, and that
/// of the shear that the increments leave.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorBars {
    /// Branch, from 0.
    pub branch: usize,
    /// Of the contact radius \[m\].
    pub contact_radius: f64,
    /// Of the stick area over the contact area.
    pub stick_ratio: f64,
    /// Of the largest pressure \[Pa\].
    pub p_max: f64,
    /// Of the approach \[m\].
    pub delta_z: f64,
    /// Of the shift along x \[m\].
    pub delta_x: f64,
    /// Of the shift along y \[m\].
    pub delta_y: f64,
    /// Of the rotation \[rad\].
    pub phi_z: f64,
    /// Of the energy dissipated in the branch \[J\].
    pub dissipated: f64,
    /// Of the shear, from the increments alone: L2, over the largest shear of the path.
    pub path_error: f64,
}

impl ErrorBars {
    /// From the same branch on both grids.
    fn between(fine: &BranchSummary, coarse: &BranchSummary, path_error: f64) -> Self {
        let bar = |order: f64, f: f64, c: f64| (f - c).abs() / (order.exp2() - 1.0);
        let (m, n) = (&fine.motion, &coarse.motion);
        Self {
            branch: fine.branch,
            contact_radius: bar(RIM, fine.contact_radius, coarse.contact_radius),
            stick_ratio: bar(RIM, fine.stick_ratio, coarse.stick_ratio),
            p_max: bar(SMOOTH, fine.p_max, coarse.p_max),
            delta_z: bar(SMOOTH, m.delta_z, n.delta_z),
            delta_x: bar(SMOOTH, m.delta_x, n.delta_x),
            delta_y: bar(SMOOTH, m.delta_y, n.delta_y),
            phi_z: bar(SMOOTH, m.phi_z, n.phi_z),
            dissipated: bar(SMOOTH, fine.dissipated, coarse.dissipated),
            path_error,
        }
    }
}

/// Solves the scene again on a grid of half as many cells each way, at a fourth of the work or less,
/// and gives the errors of the branches of `fine`, its increments on its own grid.
///
/// Increments and solver are the same on both grids: their errors, and what a rough surface says
/// between its cells, are no part of these numbers. What the increments leave is told of the shear,
/// from runs with fewer or more of them. Ends when `stop` is raised.
pub fn error_bars(
    scene: &Scene,
    fine: &[Increment],
    stop: &Arc<AtomicBool>,
) -> Result<Vec<ErrorBars>, Error> {
    let scene = &estimate_path_error(scene, stop)?;
    let coarse = March::until(&coarser(scene)?, stop)?.run(Vec::new(), &mut ())?;
    let of_path = |branch: usize| scene.path.branches[branch].path_error.unwrap_or(0.0);
    Ok(summarise(fine)
        .iter()
        .zip(&summarise(&coarse))
        .map(|(fine, coarse)| ErrorBars::between(fine, coarse, of_path(fine.branch)))
        .collect())
}

/// The scene in half as many cells each way; a strip keeps its one row. Fails on a grid of an odd
/// number of cells.
pub fn coarser(scene: &Scene) -> Result<Scene, Error> {
    let grid = &scene.grid;
    let along_y = if grid.plane_strain { 1 } else { 2 };
    if !grid.nx.is_multiple_of(2) || !grid.ny.is_multiple_of(along_y) {
        return Err(Error::invalid(
            "grid.n",
            format!("[{}, {}]", grid.nx, grid.ny),
            "even numbers of cells, so that half of them tell the error",
        ));
    }
    let mut coarse = scene.clone();
    coarse.settings.save = SaveFields::Branches;
    coarse.grid = Grid {
        nx: grid.nx / 2,
        ny: grid.ny / along_y,
        dx: 2.0 * grid.dx,
        dy: along_y as f64 * grid.dy,
        ..*grid
    };
    Ok(coarse)
}
