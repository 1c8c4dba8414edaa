//! Errors of the cells in the numbers of a run: the same path in few increments, on the grid and on
//! a finer one.
//!
//! The position of a rim within the cells makes random errors of either sign. It is the same on the
//! same grid whatever the increments, so that the difference from a finer grid is the error with
//! its sign. The path is solved on the path grid of the scene, whose errors hardly depend on the increments
//! either: the energies of the branches come from there.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::numbers::{NUMBERS, numbers};
use crate::error::Error;
use crate::march::{BranchSummary, March, summarise};
use crate::scene::{Grid, PathGrid, SaveFields, Scene};

/// Most increments of a branch.
const INCREMENTS: usize = 24;
/// Refinement factors of the finer grid in order of preference: the first with which it has no more
/// cells than [`MOST_CELLS`].
const TIMES: [usize; 2] = [3, 2];
const MOST_CELLS: usize = 512 * 512;
/// Least tolerance of the solver: the errors of the cells are larger.
const TOLERANCE: f64 = 1e-5;

/// The errors of the grid in the numbers of each branch.
pub(crate) struct Finer {
    /// Refinement factor of the finer grid.
    pub(crate) ratio: f64,
    /// The numbers minus the numbers on the finer grid, each in its unit.
    pub(crate) differences: Vec<[f64; NUMBERS]>,
    /// Tolerance of both runs.
    pub(crate) tolerance: f64,
}

impl Finer {
    /// Solves the path in few increments on this grid, with its path grid, and on a finer one, and keeps the
    /// differences of the numbers at the end of each branch. The increments must be chosen. `branches` are the
    /// results on this grid: if the path has few increments, it is not solved there again. None if a finer grid
    /// is too large, if bodies yield (their volume grid has at most as many cells), or if a run fails. Fails
    /// only if `stop` is raised.
    pub(crate) fn solve(
        scene: &Scene,
        branches: &[BranchSummary],
        stop: &Arc<AtomicBool>,
    ) -> Result<Option<Self>, Error> {
        let Some(fine) = finest(scene).filter(|_| !scene.yields()) else {
            return Ok(None);
        };
        let mut coarse_scene = Scene {
            grid: scene.grid,
            body1: scene.body1.clone(),
            body2: scene.body2.clone(),
            ..fine.clone()
        };
        coarse_scene.settings.solver.path_grid = scene.settings.solver.path_grid;
        let solved = |scene: &Scene| -> Result<_, Error> {
            let increments = March::until(scene, stop)?.run(Vec::new(), &mut ())?;
            Ok(summarise(&increments)
                .iter()
                .map(numbers)
                .collect::<Vec<_>>())
        };
        let has_few_increments = scene.path_grid().is_none()
            && scene
                .path
                .branches
                .iter()
                .all(|branch| branch.count() <= INCREMENTS);
        let ours = if has_few_increments {
            Ok(branches.iter().map(numbers).collect())
        } else {
            solved(&coarse_scene)
        };
        match ours.and_then(|ours| Ok((ours, solved(&fine)?))) {
            Err(error @ Error::Interrupted { .. }) => Err(error),
            Err(_) => Ok(None),
            Ok((ours, theirs)) => {
                let pairs = ours.iter().zip(&theirs);
                let differences = pairs.map(|(f, g)| std::array::from_fn(|n| f[n] - g[n]));
                Ok(Some(Self {
                    ratio: scene.grid.dx / fine.grid.dx,
                    differences: differences.collect(),
                    tolerance: fine.tolerance(),
                }))
            }
        }
    }
}

/// The scene in few increments on the finer grid of the error estimate; none where that would be too large.
/// Error bars need its memory besides the memory of the run.
pub fn finest(scene: &Scene) -> Option<Scene> {
    let grids = TIMES.map(|times| refined(&scene.grid, times));
    let grid = grids
        .into_iter()
        .find(|grid| grid.nx * grid.ny <= MOST_CELLS)?;
    let mut fine = Scene {
        grid,
        ..scene.clone()
    };
    fine.refine_maps();
    fine.settings.save = SaveFields::Branches;
    fine.settings.solver.path_grid = PathGrid::Same;
    fine.settings.solver.tolerance = Some(scene.tolerance().max(TOLERANCE));
    for branch in &mut fine.path.branches {
        branch.increments = Some(branch.count().min(INCREMENTS));
    }
    Some(fine)
}

/// The grid of the same extent with `times` as many cells along each side; a strip keeps its one row.
fn refined(grid: &Grid, times: usize) -> Grid {
    let part = 1.0 / times as f64;
    let (ny, dy) = if grid.plane_strain {
        (grid.ny, grid.dy)
    } else {
        (times * grid.ny, part * grid.dy)
    };
    Grid {
        nx: times * grid.nx,
        ny,
        dx: part * grid.dx,
        dy,
        ..*grid
    }
}
