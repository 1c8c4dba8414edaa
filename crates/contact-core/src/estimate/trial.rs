//! A scene on the coarsest sufficient grid, solved repeatedly with different increments.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::two_runs::{PathError, TwoRuns, of_trial};
use crate::error::Error;
use crate::march::March;
use crate::scene::{Branch, Dependence, Grid, LoadPath, PathGrid, Scene, Spacing};

/// Order of the error in the increments: 1.5, between that of cells entering one by one (1) and
/// that of turning slip (2); 1 where friction falls once a cell has slipped, one increment late.
const ORDER: f64 = 1.5;
const LATE_ORDER: f64 = 1.0;
/// The same of a contact that grows: a cell that comes to stick within an increment is taken to have
/// stuck from its start, or from its entry.
const GROWTH_ORDER: f64 = 1.0;
/// The same near full sliding: the shift of unlike bodies at 0.999 mu W in 161 and 400 increments
/// differs by 8 %.
const SLIDING_ORDER: f64 = 1.0;
/// Solver tolerance of these runs over the tolerance of the path: the errors of the increments add
/// up.
const SOLVER_SHARE: f64 = 1e-2;
/// A grid is not halved below CELLS cells.
const CELLS: usize = 32 * 32;
/// Error of the increments on a grid of RESOLVED_CELLS cells or more, over that on coarser ones: coarser
/// grids underestimate it by 20 to 30 % on the paper's scene, since the ring of the last cells is
/// wider there.
const RESOLVED_CELLS: usize = 64 * 64;
const MISSED: f64 = 1.25;
/// Contact cells that a grid must have.
const CONTACT: usize = 300;

/// The same scene twice, for few increments and for many.
pub(crate) struct Trial {
    runs: TwoRuns,
    /// The error on the grid of the scene over that on the grid of the trial.
    missed: f64,
    /// Substeps in which a contact grows, as in the run itself.
    growth_steps: usize,
    /// Order of the error in the increments.
    order: f64,
}

impl Trial {
    /// On the coarsest grid on which the contact has at least [`CONTACT`] cells.
    pub(crate) fn new(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        let mut grids = vec![scene.grid];
        while let Some(coarse) = grids.last().and_then(halved) {
            grids.push(coarse);
        }
        let mut trial = scene.clone();
        let solver = &mut trial.settings.solver;
        solver.tolerance = Some(solver.path_tolerance * SOLVER_SHARE);
        solver.path_grid = PathGrid::Same;
        let rolls = scene.path.branches.iter().any(|b| b.to.rolled != 0.0);
        while let Some(grid) = grids.pop() {
            if rolls && !grids.is_empty() {
                continue;
            }
            trial.grid = grid;
            let mut once = trial.clone();
            // Only the area of the contact is needed.
            once.settings.solver.entering = false;
            once.path
                .branches
                .iter_mut()
                .for_each(|b| b.increments = Some(1));
            if grids.is_empty() || most_contact(&once, stop)? >= CONTACT {
                break;
            }
        }
        let runs = TwoRuns::new(&trial, &trial, stop)?;
        let coarse = trial.grid != scene.grid && trial.grid.nx * trial.grid.ny < RESOLVED_CELLS;
        Ok(Self {
            growth_steps: runs.growth_steps(),
            runs,
            missed: if coarse && !scene.grid.plane_strain {
                MISSED
            } else {
                1.0
            },
            order: if scene.friction.depends_on(Dependence::LastSlip) {
                LATE_ORDER
            } else {
                ORDER
            },
        })
    }

    /// Estimated errors at the end of each branch, from the increments of the `varied` branches.
    pub(crate) fn errors(
        &mut self,
        path: &LoadPath,
        varied: impl Fn(usize) -> bool,
    ) -> Result<Vec<PathError>, Error> {
        let with = |count: fn(usize) -> usize| {
            let mut other = path.clone();
            for (k, branch) in other.branches.iter_mut().enumerate() {
                if varied(k) {
                    branch.set_equal_increments(count(branch.equal_increments()));
                }
            }
            other
        };
        let mut counts = (path.branches.iter().enumerate())
            .filter(|(k, _)| varied(*k))
            .map(|(_, branch)| branch.equal_increments());
        // Where friction falls with slip, half of a few increments is no basis: twice as many are
        // compared.
        let halves = self.order == ORDER && counts.all(|count| count > 1);
        let change = if halves {
            self.runs
                .grow_in([self.growth_steps / 2, self.growth_steps]);
            self.runs.change(&with(|n| n / 2), path)?
        } else {
            self.runs
                .grow_in([self.growth_steps, 2 * self.growth_steps]);
            self.runs.change(path, &with(|n| 2 * n))?
        };
        let (missed, usual) = (self.missed, self.order);
        let of_path = |(branch, change): (&Branch, PathError)| {
            // Shift and energy near sliding are dominated by the last increments: first order.
            let order = if change.is_near_sliding() {
                SLIDING_ORDER
            } else if branch.spacing == Spacing::EqualRadius {
                GROWTH_ORDER
            } else {
                usual
            };
            let part = if halves {
                order.exp2() - 1.0
            } else {
                1.0 - (-order).exp2()
            };
            change.times(missed / part)
        };
        Ok(path.branches.iter().zip(change).map(of_path).collect())
    }
}

/// The largest number of contact cells at the ends of the branches.
fn most_contact(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<usize, Error> {
    let cell_area = scene.grid.cell_area();
    let mut march = March::until(scene, stop)?;
    let mut most = 0.0_f64;
    while let Some(increment) = march.advance() {
        most = most.max(of_trial(increment)?.contact_area);
    }
    Ok((most / cell_area).round() as usize)
}

/// The grid of half as many cells each way, if that is fine enough.
fn halved(grid: &Grid) -> Option<Grid> {
    let Grid { nx, ny, dx, dy, .. } = *grid;
    let line = grid.plane_strain;
    let even = nx.is_multiple_of(2) && (line || ny.is_multiple_of(2));
    let enough = if line {
        nx / 2 >= CONTACT
    } else {
        nx * ny / 4 >= CELLS
    };
    (even && enough).then_some(Grid {
        nx: nx / 2,
        ny: if line { ny } else { ny / 2 },
        dx: 2.0 * dx,
        dy: if line { dy } else { 2.0 * dy },
        ..*grid
    })
}
