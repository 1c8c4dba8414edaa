//! A scene on the coarsest sufficient grid, solved repeatedly with different increments.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::numbers::Q_MAX;
use super::two_runs::{PathError, TwoRuns, increment_of_trial};
use crate::error::Error;
use crate::march::March;
use crate::scene::{Branch, Dependence, Grid, LoadPath, PathGrid, Scene, Spacing};

/// Order of the error in the increments: 1.5, between the order of cells entering one by one (1) and
/// the order of turning slip (2); 1 where friction falls once a cell has slipped, one increment late.
const ORDER: f64 = 1.5;
const LATE_ORDER: f64 = 1.0;
/// Order for a contact that grows: a cell that comes to stick within an increment is taken to have
/// stuck from its start, or from its entry.
const GROWTH_ORDER: f64 = 1.0;
/// Factor near full sliding: the shift of unlike bodies at 0.999 mu W in 161 and 400 increments
/// differs by 8 %.
const SLIDING_ORDER: f64 = 1.0;
/// Solver tolerance of these runs over the tolerance of the path: the errors of the increments add
/// up.
const SOLVER_SHARE: f64 = 1e-2;
/// Factor for runs of half of the increments, whose errors are three times as large.
const HALF_SHARE: f64 = 3e-2;
/// A grid is not halved below CELLS cells.
const CELLS: usize = 32 * 32;
/// Error of the increments on a grid of RESOLVED_CELLS cells or more, over that on coarser ones: coarser
/// grids underestimate it by 20 to 30 % on the paper's scene, since the ring of the last cells is
/// wider there.
const RESOLVED_CELLS: usize = 64 * 64;
const MISSED: f64 = 1.25;
/// Cells across a ring of slip on which the error of the increments is the same as on finer grids. On
/// fewer it is smaller by the number of cells over this one: of bare spheres of unlike metals (7 increments to 0.3,
/// 0.6 and 0.9 mu W and back, rings of 1.4, 3.2 and 6.6 cells on 32 x 32) it is 5.0, 2.1 and 1.1 times
/// as large on the finest grid (256, 128, 128), 2.0, 1.9 and 1.1 times on 64 x 64.
const RING: f64 = 6.6;
/// Cells of the shorter side of the grid on which the increments of a neighbouring scene are checked.
const FEW: usize = 32;
/// Contact cells that a grid must have.
const CONTACT: usize = 300;

/// Runs of one scene twice, for few increments and for many.
pub(crate) struct Trial {
    runs: TwoRuns,
    cells: (usize, usize),
    /// Length of a cell \[m\], and its ratio to one of the scene.
    cell: f64,
    ratio: f64,
    /// The error on the grid of the scene over that on the grid of the trial.
    missed: f64,
    /// Substeps in which a contact grows, as in the run itself.
    growth_steps: usize,
    /// Order of the error in the increments.
    order: f64,
}

impl Trial {
    /// Sets up the runs on the coarsest grid of halvings on which the contact has at least [`CONTACT`] cells.
    pub(crate) fn new(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        Self::on_coarsest_sufficient(halved_grids(scene), scene, SOLVER_SHARE, stop)
    }

    /// Sets up runs with half of the substeps of growth, for a comparison of halved increments, on a grid of
    /// `cells` along x and y. By default that is the coarsest of the halvings with enough contact cells; for
    /// smooth bodies also a grid of [`FEW`] cells along the shorter side.
    pub(crate) fn for_halved_increments(
        scene: &Scene,
        cells: Option<(usize, usize)>,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let mut grids = halved_grids(scene);
        match cells {
            Some(cells) => grids = vec![with_cells(&scene.grid, cells)],
            None => grids.extend(grids.last().and_then(|grid| grid_of_few_cells(scene, grid))),
        }
        let mut trial = Self::on_coarsest_sufficient(grids, scene, HALF_SHARE, stop)?;
        trial.growth_steps /= 2;
        Ok(trial)
    }

    /// Cells along x and along y.
    pub(crate) fn cells(&self) -> (usize, usize) {
        self.cells
    }

    /// Sets up the runs on the coarsest of the `grids` (finest first) on which the contact has enough cells,
    /// the finest if none has, with the tolerance `share` times the tolerance of the path.
    fn on_coarsest_sufficient(
        mut grids: Vec<Grid>,
        scene: &Scene,
        share: f64,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let mut trial = scene.clone();
        let solver = &mut trial.settings.solver;
        solver.tolerance = Some(solver.path_tolerance * share);
        solver.path_grid = PathGrid::Same;
        let rolls = scene.path.branches.iter().any(|b| b.to.rolled != 0.0);
        while let Some(grid) = grids.pop() {
            if rolls && !grids.is_empty() {
                continue;
            }
            trial.grid = grid;
            let mut once = trial.clone();
            // Only the area of the contact is needed.
            once.settings.solver.cell_entry_correction = false;
            once.path
                .branches
                .iter_mut()
                .for_each(|b| b.increments = Some(1));
            if grids.is_empty() || max_contact_cells(&once, stop)? >= CONTACT {
                break;
            }
        }
        let runs = TwoRuns::new(&trial, &trial, stop)?;
        let coarse = trial.grid != scene.grid && trial.grid.nx * trial.grid.ny < RESOLVED_CELLS;
        Ok(Self {
            growth_steps: runs.growth_steps(),
            cells: (trial.grid.nx, trial.grid.ny),
            cell: trial.grid.dx,
            ratio: trial.grid.dx / scene.grid.dx,
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

    /// Estimated errors at the end of each branch, from the change when the increments of the `varied` branches
    /// are halved (or doubled, where there are too few to halve).
    pub(crate) fn errors(
        &mut self,
        path: &LoadPath,
        varied: impl Fn(usize) -> bool,
    ) -> Result<Vec<PathError>, Error> {
        let with = |count: fn(usize) -> usize| {
            let mut changed_path = path.clone();
            for (k, branch) in changed_path.branches.iter_mut().enumerate() {
                if varied(k) {
                    branch.set_equal_increments(count(branch.equal_increments()));
                }
            }
            changed_path
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
        // The change that a growth of contact has left in the shear.
        let mut grown = 0.0;
        let of_path = |(k, (branch, change)): (usize, (&Branch, PathError))| {
            let grows = k == 0 || branch.spacing == Spacing::EqualRadius;
            if grows {
                grown = change.q;
            }
            let whole = self.change_on_scene_grid(&change, grown);
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
            let mut error = PathError { q: whole, ..change }.times(missed / part);
            if grows {
                let unconfirmed = error.unconfirmed[usize::from(halves)];
                error.numbers[Q_MAX] = unconfirmed.max(error.numbers[Q_MAX].abs());
            }
            error
        };
        let branches = path.branches.iter().zip(change);
        Ok(branches.enumerate().map(of_path).collect())
    }

    /// The `change` of the shear as it would be on the grid of the scene. Where the ring of slip has fewer than
    /// [`RING`] cells of the trial grid, the trial shows too little of it. The part `grown`, left from the
    /// growth of the contact, does not depend on the grid.
    fn change_on_scene_grid(&self, change: &PathError, grown: f64) -> f64 {
        let cells = (change.ring / self.cell).max(1.0);
        let unseen = (RING / cells).min(self.ratio);
        if unseen <= 1.0 {
            return change.q;
        }
        let inherited = grown.min(change.q);
        let not_inherited = (change.q.powi(2) - inherited.powi(2)).sqrt();
        inherited.hypot(unseen * not_inherited)
    }
}

/// The largest number of contact cells at the ends of the branches.
fn max_contact_cells(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<usize, Error> {
    let cell_area = scene.grid.cell_area();
    let mut march = March::until(scene, stop)?;
    let mut largest_area = 0.0_f64;
    while let Some(increment) = march.advance() {
        largest_area = largest_area.max(increment_of_trial(increment)?.contact_area);
    }
    Ok((largest_area / cell_area).round() as usize)
}

/// The grid of a scene and the coarser ones that it can be halved to.
fn halved_grids(scene: &Scene) -> Vec<Grid> {
    let mut grids = vec![scene.grid];
    while let Some(coarse) = grids.last().and_then(halved) {
        grids.push(coarse);
    }
    grids
}

/// A grid of [`FEW`] cells along its shorter side. None where the grid is no finer, in plane strain, or if the
/// bodies are not smooth.
fn grid_of_few_cells(scene: &Scene, grid: &Grid) -> Option<Grid> {
    let Grid { nx, ny, .. } = *grid;
    let shorter = nx.min(ny);
    if shorter <= FEW || grid.plane_strain || !scene.is_sum_of_paraboloids() {
        return None;
    }
    let cells = |n: usize| 2 * ((n * FEW) as f64 / (2 * shorter) as f64).round() as usize;
    Some(with_cells(grid, (cells(nx), cells(ny))))
}

/// The grid of the same extent with these numbers of cells along x and y.
fn with_cells(grid: &Grid, (nx, ny): (usize, usize)) -> Grid {
    let (length, width) = grid.extent();
    Grid {
        nx,
        ny,
        dx: length / nx as f64,
        dy: if ny == grid.ny {
            grid.dy
        } else {
            width / ny as f64
        },
        ..*grid
    }
}

/// The grid of the same extent with half as many cells along each side; none where the number is odd, or too
/// few cells would be left.
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
