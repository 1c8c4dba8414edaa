//! The grid that the path is solved on, and the error that it leaves at the ends of the branches.
//!
//! The path on 32 cells carried to a grid of 64 is compared with the same path on all of the 64,
//! both with half of the increments and of the substeps of growth: the shear differs by e(32, 64).
//! The error falls with the cells N of the path grid, and a path carried over k halvings has the
//! error of each:
//!
//! ```text
//! e(N, 2^k N) = e(32, 64) (32/N)^m (1 + 2^-m + ... + 2^-(k - 1) m),   m = 3/2
//! ```
//!
//! A path grid of fewer than 32 cells, which has to be given, is itself compared with twice as many.
//!
//! On the paper's scene at 256 cells with a path on 64 (E1/E2 = 0.5, 2, 4) this gives 2.0e-3, 2.5e-3
//! and 2.5e-3; the true errors are 1.6e-3, 2.3e-3 and 2.4e-3. Where the path is round, spots are in
//! contact or the coupling is strong they are ten times as large.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::numbers::DISSIPATED;
use super::repeats::Repeats;
use super::two_runs::{PathError, TwoRuns};
use crate::error::Error;
use crate::march::is_remembered;
use crate::plan::Plan;
use crate::scene::{Grid, PathGrid, SaveFields, Scene};

/// Cells of the shorter side of the path grid that is tried, at most.
const TRIAL_CELLS: usize = 32;
/// Fewest cells of the shorter side of a grid on which a coarser path pays.
const FEWEST_CELLS: usize = 192;
/// Fewest cells of the shorter side of a path grid.
const FEWEST_PATH_CELLS: usize = 64;
/// Coarsening factors of the path grids, the coarsest first.
const RATIOS: [usize; 2] = [4, 2];
/// Order m of the error in the cells of the path grid.
const ORDER: f64 = 1.5;
/// Fewest increments that the path grid can take over, as a part of all.
const TAKEN_OVER: f64 = 0.5;
/// Least energy of a branch whose error is typical, over the largest of the path.
const MUCH: f64 = 0.1;

/// Chooses the path grid of a scene whose increments have just been chosen: the coarsest with which
/// the errors of the increments and of the path grid, which are independent, stay within
/// `path_tolerance` together. Adds its errors to the errors of the branches; the errors of a path grid that is
/// given, too.
pub(super) fn choose_path_grid(scene: &mut Scene, stop: &Arc<AtomicBool>) -> Result<(), Error> {
    let (nx, shorter) = (scene.grid.nx, scene.grid.nx.min(scene.grid.ny));
    let setting = scene.settings.solver.path_grid;
    let ratios: Vec<usize> = match setting {
        PathGrid::Same => return Ok(()),
        PathGrid::Cells(_) if scene.path_grid().is_none() => return Ok(()),
        PathGrid::Cells(cells) => vec![nx / cells],
        PathGrid::Auto => {
            scene.settings.solver.path_grid = PathGrid::Same;
            let possible = |ratio: &usize| {
                let coarser = on_path_grid(scene, nx / ratio);
                let allowed =
                    coarser.check_path_grid().is_ok() && coarser.is_resolved_on_path_grid();
                allowed && shorter >= FEWEST_PATH_CELLS * ratio
            };
            let ratios: Vec<usize> = RATIOS.into_iter().filter(possible).collect();
            let hard = scene.hardness() < f64::INFINITY;
            if shorter < FEWEST_CELLS || ratios.is_empty() || hard || !pays(scene) {
                return Ok(());
            }
            ratios
        }
    };
    // Cycles repeat the ends of their branches.
    let branches = Repeats::of_ends(&scene.path.branches).last() + 1;
    let tried = ratios.iter().map(|ratio| shorter / ratio);
    let tried = tried.fold(TRIAL_CELLS, usize::min);
    let errors = match (errors_of_trial(scene, tried, branches, stop), setting) {
        (Ok(errors), _) => errors,
        (Err(error @ Error::Interrupted { .. }), _) => return Err(error),
        (Err(error), PathGrid::Cells(cells)) => return Err(without_estimate(cells, &error)),
        // A coarse grid may be too coarse for the scene.
        (Err(_), _) => return Ok(()),
    };
    let remembered = is_remembered(scene, &Plan::new(scene));
    let worst = errors.iter().map(|error| error.q).fold(0.0, f64::max);
    for ratio in ratios {
        let of_grid = worst * extrapolation(tried, shorter / ratio, ratio);
        let mut branches = scene.path.branches.clone();
        for (k, branch) in branches.iter_mut().enumerate() {
            // Branches that are solved on both grids, as the contact grows, have no such error.
            if errors.get(k).is_none_or(|error| error.q > 0.0) {
                branch.path_error = branch.path_error.map(|error| error.hypot(of_grid));
            }
        }
        // The increments of an indentation whose stick zone is fitted were judged when they were chosen,
        // by a shear with the scatter that the fit takes off.
        let judged = branches.iter().skip(usize::from(remembered));
        let largest = judged.filter_map(|of| of.path_error);
        let allowed = largest.fold(of_grid, f64::max) <= scene.settings.solver.path_tolerance;
        if allowed || setting != PathGrid::Auto {
            scene.settings.solver.path_grid = PathGrid::Cells(nx / ratio);
            scene.path.branches = branches;
            break;
        }
    }
    Ok(())
}

/// Refuses a path grid whose error cannot be estimated.
fn without_estimate(cells: usize, why: &Error) -> Error {
    let allowed =
        format!("\"auto\" or \"same\": the error that it leaves cannot be estimated ({why})");
    Error::invalid("solver.path_grid", cells, allowed)
}

/// Errors of the path grid of a scene at the ends of its branches; empty if that is the grid
/// itself.
pub(super) fn path_grid_errors(
    scene: &Scene,
    stop: &Arc<AtomicBool>,
) -> Result<Vec<PathError>, Error> {
    let Some(Grid { nx: cells, .. }) = scene.path_grid() else {
        return Ok(Vec::new());
    };
    let ratio = scene.grid.nx / cells;
    let shorter = scene.grid.nx.min(scene.grid.ny) / ratio;
    let tried = shorter.min(TRIAL_CELLS);
    let factor = extrapolation(tried, shorter, ratio);
    let errors = match errors_of_trial(scene, tried, scene.path.branches.len(), stop) {
        Ok(errors) => errors.into_iter(),
        Err(error @ Error::Interrupted { .. }) => return Err(error),
        Err(error) => return Err(without_estimate(cells, &error)),
    };
    let mut errors: Vec<PathError> = errors.map(|error| error.times(factor)).collect();
    spread_energies(&mut errors);
    Ok(errors)
}

/// Gives each branch the largest error of the energy, over the energy, among the branches that dissipate
/// much.
///
/// The energy is a number of the coarser grid, and its difference from cells half as large vanishes by chance
/// in a branch: of three branches of a ball under T = 0.8 mu W to and fro (128 cells, path on 64) the trial gives
/// 0.25, 0.08 and 0.005 %, where the energies are off by 0.19, 0.13 and 0.09 %.
fn spread_energies(errors: &mut [PathError]) {
    let highest = errors.iter().map(|of| of.dissipated).fold(0.0, f64::max);
    let large = errors.iter().filter(|of| of.dissipated > MUCH * highest);
    let relative = large.map(|of| of.numbers[DISSIPATED].abs() / of.dissipated);
    let largest = relative.fold(0.0, f64::max);
    for of in errors {
        let error = &mut of.numbers[DISSIPATED];
        // Branches that are solved on both grids have the energy of the finer one.
        if *error != 0.0 {
            *error = error.abs().max(largest * of.dissipated);
        }
    }
}

/// Whether a path grid saves work: whether enough increments can be solved on it alone, those that do not end a
/// branch and change no normal force or tilting moment.
fn pays(scene: &Scene) -> bool {
    let branches = &scene.path.branches;
    let across = |k: usize| (branches[k].to.forces(), branches[k].to.given.motions());
    let steady = |k: usize| {
        let ((f, m), (g, n)) = (across(k), across(k - 1));
        f[..3] == g[..3] && m[..3] == n[..3]
    };
    let taken_over = (1..branches.len()).filter(|&k| steady(k));
    let remembered = is_remembered(scene, &Plan::new(scene)).then_some(0);
    let taken_over = taken_over.chain(remembered);
    let taken_over: usize = taken_over.map(|k| branches[k].count() - 1).sum();
    scene.settings.save != SaveFields::All
        && taken_over as f64 >= TAKEN_OVER * scene.path.increments() as f64
}

/// Ratio of the errors e(N, ratio N)/e(T, 2 T) by which the error of a path grid of `cells` N follows from the
/// trial on T = `tried` cells.
fn extrapolation(tried: usize, cells: usize, ratio: usize) -> f64 {
    let halvings = (0..ratio.ilog2()).map(|k| (-ORDER * f64::from(k)).exp2());
    (tried as f64 / cells as f64).powf(ORDER) * halvings.sum::<f64>()
}

/// The errors e(T, 2 T) of the `tried` cells T at the ends of the first branches.
fn errors_of_trial(
    scene: &Scene,
    tried: usize,
    branches: usize,
    stop: &Arc<AtomicBool>,
) -> Result<Vec<PathError>, Error> {
    let Grid { nx, ny, .. } = scene.grid;
    let (length, width) = scene.grid.extent();
    let shorter = nx.min(ny) as f64;
    let cells = |n: usize| 4 * ((n * tried) as f64 / (2.0 * shorter)).round() as usize;
    let mut trial = scene.clone();
    trial.path.branches.truncate(branches);
    for branch in &mut trial.path.branches {
        branch.set_equal_increments(branch.equal_increments().div_ceil(2));
    }
    trial.settings.save = SaveFields::Branches;
    trial.settings.solver.tolerance = Some(scene.tolerance());
    trial.settings.solver.path_grid = PathGrid::Same;
    trial.grid = Grid {
        nx: cells(nx),
        ny: cells(ny),
        dx: length / cells(nx) as f64,
        dy: width / cells(ny) as f64,
        ..scene.grid
    };
    let carried = on_path_grid(&trial, trial.grid.nx / 2);
    let mut runs = TwoRuns::new(&carried, &trial, stop)?;
    let substeps = runs.growth_steps() / 2;
    runs.grow_in([substeps; 2]);
    if !runs.remember() {
        // While the contact grows, both are solved on the finer grid.
        runs.share(&trial.path, 1)?;
    }
    runs.change(&trial.path, &trial.path)
}

/// The scene with its path on so many cells along x.
fn on_path_grid(scene: &Scene, cells: usize) -> Scene {
    let mut scene = scene.clone();
    scene.settings.solver.path_grid = PathGrid::Cells(cells);
    scene
}
