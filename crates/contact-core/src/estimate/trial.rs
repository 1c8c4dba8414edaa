//! A scene on the coarsest sufficient grid, solved repeatedly with different increments.
//!
//! The states at the ends of the branches are kept: a path with the same first branches as the last
//! one is continued from there.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ndarray::Array2;

use super::numbers::{NUMBERS, numbers};
use crate::error::Error;
use crate::march::{BranchSummary, Increment, March, Motion, State, Tractions, summarise};
use crate::scene::{Branch, Grid, LoadPath, Scene};

/// Order of the error in the increments: 1.5, between that of cells entering one by one (1) and
/// that of turning slip (2); 1 where friction falls once a cell has slipped, one increment late.
const ORDER: f64 = 1.5;
const KINETIC_ORDER: f64 = 1.0;
/// The same near full sliding: the shift of unlike bodies at 0.999 mu W in 161 and 400 increments
/// differs by 8 %.
const SLIDING_ORDER: f64 = 1.0;
/// Solver tolerance of these runs over the tolerance of the path: the errors of the increments add
/// up.
const SOLVED: f64 = 4e-3;
/// A grid is not halved below CELLS cells.
const CELLS: usize = 32 * 32;
/// Error of the increments on a grid of ENOUGH cells or more, over that on coarser ones: coarser
/// grids underestimate it by 20 to 30 % on the paper's scene, since the ring of the last cells is
/// wider there.
const ENOUGH: usize = 64 * 64;
const MISSED: f64 = 1.25;
/// Contact cells that a grid must have.
const CONTACT: usize = 300;

/// Error of the increments at the end of a branch.
#[derive(Default)]
pub(crate) struct PathError {
    /// In the shear: L2 norm, over the largest of the path.
    pub(crate) q: f64,
    /// In the pressure: L2 norm, over the largest of the path.
    pub(crate) p: f64,
    /// In the numbers of the branch, each in its unit: less those with many increments.
    pub(crate) numbers: [f64; NUMBERS],
    /// The larger of the errors of the shift and of the dissipated energy, each over the largest of
    /// the path.
    pub(crate) motion: f64,
    /// Whether the shift follows from a force.
    pub(crate) driven: bool,
    /// The shear there over the largest of the path (L2).
    pub(crate) reached: f64,
    /// The shear that friction can bear there over the largest of the path (L2).
    pub(crate) bearable: f64,
}

/// Above SLIDING times the limit of friction shift and energy grow without bound while the shear
/// hardly changes; their errors may be RUN_AWAY times that of the shear.
const SLIDING: f64 = 0.99;
const RUN_AWAY: f64 = 3.0;

impl PathError {
    /// Whether a given force is near the limit of friction.
    fn is_near_sliding(&self) -> bool {
        self.driven && self.reached > SLIDING * self.bearable
    }

    /// The error by which increments are chosen: that of the shear, near full sliding also that of
    /// shift and energy.
    pub(crate) fn chosen_by(&self) -> f64 {
        if self.is_near_sliding() {
            self.q.max(self.motion / RUN_AWAY)
        } else {
            self.q
        }
    }

    /// All errors times a factor.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self {
            q: factor * self.q,
            p: factor * self.p,
            motion: factor * self.motion,
            numbers: self.numbers.map(|n| factor * n),
            ..self
        }
    }
}

/// The same scene twice, for few increments and for many.
pub(crate) struct Trial {
    few: Run,
    many: Run,
    /// The error on the grid of the scene over that on the grid of the trial.
    missed: f64,
    /// Substeps in which a contact grows, as in the run itself.
    growth_steps: usize,
    mu: f64,
    /// Order of the error in the increments.
    order: f64,
    /// The largest p and q at the end of a branch so far (L2).
    largest: (f64, f64),
    /// The largest shift and the largest energy dissipated in a branch, so far \[m, J\].
    moved: (f64, f64),
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
        solver.tolerance = Some(solver.path_tolerance * SOLVED);
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
        let many = Run::new(&trial, stop)?;
        let coarse = trial.grid != scene.grid && trial.grid.nx * trial.grid.ny < ENOUGH;
        Ok(Self {
            few: Run::new(&trial, stop)?,
            growth_steps: many.growth_steps,
            many,
            missed: if coarse && !scene.grid.plane_strain {
                MISSED
            } else {
                1.0
            },
            mu: scene.friction.mu,
            order: scene.friction.kinetic.map_or(ORDER, |_| KINETIC_ORDER),
            largest: (f64::MIN_POSITIVE, f64::MIN_POSITIVE),
            moved: (f64::MIN_POSITIVE, f64::MIN_POSITIVE),
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
            self.grow_in([self.growth_steps / 2, self.growth_steps]);
            self.change(&with(|n| n / 2), path)?
        } else {
            self.grow_in([self.growth_steps, 2 * self.growth_steps]);
            self.change(path, &with(|n| 2 * n))?
        };
        let (missed, usual) = (self.missed, self.order);
        let of_path = |change: PathError| {
            // Shift and energy near sliding are dominated by the last increments: first order.
            let order = if change.is_near_sliding() {
                SLIDING_ORDER
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
        Ok(change.into_iter().map(of_path).collect())
    }

    /// Sets the substeps of growing contacts of both runs.
    fn grow_in(&mut self, [few, many]: [usize; 2]) {
        self.few.grow_in(few);
        self.many.grow_in(many);
    }

    /// The change at the end of each branch from few increments to many, side by side.
    fn change(&mut self, few: &LoadPath, many: &LoadPath) -> Result<Vec<PathError>, Error> {
        let (few, many) = rayon::join(|| self.few.along(few), || self.many.along(many));
        let (few, many) = (few?, many?);
        for end in many {
            let (p, q) = self.largest;
            self.largest = (p.max(end.p()), q.max(end.q()));
            let (shift, energy) = self.moved;
            let Motion {
                delta_x, delta_y, ..
            } = end.summary.motion;
            self.moved = (
                shift.max(delta_x.hypot(delta_y)),
                energy.max(end.summary.dissipated),
            );
        }
        let ((p, q), (shift, energy)) = (self.largest, self.moved);
        let pairs = few.iter().zip(many);
        Ok(pairs
            .map(|(few, many)| {
                let (f, m) = (numbers(&few.summary), numbers(&many.summary));
                let off = |k: usize| norm(&(&few.tractions[k] - &many.tractions[k]));
                let (one, other) = (few.summary.motion, many.summary.motion);
                let given = many.summary.loads.given;
                let shifts = (one.delta_x - other.delta_x).hypot(one.delta_y - other.delta_y);
                let energies = (few.summary.dissipated - many.summary.dissipated).abs();
                PathError {
                    motion: (shifts / shift).max(energies / energy),
                    q: off(1).hypot(off(2)) / q,
                    p: off(0) / p,
                    numbers: std::array::from_fn(|n| f[n] - m[n]),
                    driven: given.delta_x.is_none() && given.delta_y.is_none(),
                    reached: many.q() / q,
                    bearable: self.mu * many.p() / q,
                }
            })
            .collect())
    }
}

/// A run, and the ends of its branches so far.
struct Run {
    march: March,
    growth_steps: usize,
    ends: Vec<End>,
}

/// The end of a branch.
struct End {
    branch: Branch,
    state: State,
    summary: BranchSummary,
    tractions: Tractions,
}

impl Run {
    fn new(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        let march = March::until(scene, stop)?;
        Ok(Self {
            growth_steps: march.plan().methods.growth_steps,
            march,
            ends: Vec::new(),
        })
    }

    /// Sets the substeps of growing contacts; another number discards the known ends.
    fn grow_in(&mut self, steps: usize) {
        if self.growth_steps != steps {
            self.growth_steps = steps;
            self.march.grow_in(steps);
            self.ends.clear();
        }
    }

    /// Solves the path; returns the ends of its branches.
    fn along(&mut self, path: &LoadPath) -> Result<&[End], Error> {
        let known = self.ends.iter().zip(&path.branches);
        let known = known.take_while(|(end, branch)| end.branch == unjudged(branch));
        self.ends.truncate(known.count());
        let state = self.ends.last().map(|end| end.state.clone());
        self.march.go_along(path, state);
        let mut increments = Vec::new();
        while let Some(increment) = self.march.advance() {
            let increment = of_trial(increment)?;
            increments.push(increment);
            if increment.point.ends_branch {
                let tractions = self.march.tractions();
                self.ends
                    .extend(summarise(&increments).pop().map(|summary| End {
                        branch: unjudged(&path.branches[increment.point.branch]),
                        state: self.march.state().clone(),
                        summary,
                        tractions,
                    }));
                increments.clear();
            }
        }
        Ok(&self.ends)
    }
}

/// The branch without its error.
fn unjudged(branch: &Branch) -> Branch {
    Branch {
        path_error: None,
        ..*branch
    }
}

impl End {
    fn p(&self) -> f64 {
        norm(&self.tractions[0])
    }

    fn q(&self) -> f64 {
        norm(&self.tractions[1]).hypot(norm(&self.tractions[2]))
    }
}

fn norm(f: &Array2<f64>) -> f64 {
    f.iter().map(|f| f * f).sum::<f64>().sqrt()
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

/// An increment of a trial; an interruption counts as one before the first increment of the run.
fn of_trial(increment: Result<Increment, Error>) -> Result<Increment, Error> {
    increment.map_err(|error| match error {
        Error::Interrupted { .. } => Error::Interrupted { increment: 0 },
        error => error,
    })
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
