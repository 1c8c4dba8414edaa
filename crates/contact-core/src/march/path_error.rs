//! The error that the increments leave along the path, and how many of them a tolerance asks for.
//!
//! The path is run through with n and with n/2 increments in each branch. What the shear at the end of
//! a branch changes by, over the largest shear of the path (L2), is a multiple of the error with n:
//!
//! ```text
//! error(n) = |q_n - q_(n/2)|/(2^order - 1) = error(n/2)/2^order
//! ```
//!
//! Where a branch has one increment only, the path is run through with n and with 2 n.
//!
//! The error along the path hardly depends on the grid, so that a coarse one does, which takes a small
//! part of the time; the contact must span it well.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ndarray::Array2;

use super::error_bars::{Tractions, numbers};
use super::{BranchSummary, Fields, Increment, March, summarise};
use crate::error::Error;
use crate::scene::{Grid, LoadPath, Scene, Spacing};

/// Order of the error in the increments: between that of cells that enter one by one and that of
/// turning slip.
const ORDER: f64 = 1.5;
/// Order by which the next number of increments is found; where it is less, another round follows.
const HOPED: f64 = 2.0;
/// Cells of a grid that is not made coarser.
const CELLS: usize = 64 * 64;
/// Contact cells that a grid must have.
const CONTACT: usize = 300;
/// Increments to begin with: of a branch that begins without contact, and of others.
const FIRST: (usize, usize) = (12, 6);
/// Part of the tolerance that is aimed at.
const AIM: f64 = 0.8;
/// Part of the tolerance that an estimate may come to.
const ACCEPTED: f64 = 0.9;
/// Part of the tolerance that is left to the growth of contact from nothing: what sticks keeps its
/// error, on fine grids a little more than on the coarse one. Where nothing follows, the shear is
/// what dissimilar bodies make of the load alone, and its error is measured against that which
/// friction can bear.
const INHERITED: f64 = 0.36;
/// Most that the number of increments of a branch grows by in a round.
const GROWTH: f64 = 4.0;
/// Solver tolerance of these runs over the tolerance on the path: what each increment misses adds up.
const SOLVED: f64 = 4e-4;
/// Rounds of choosing.
const ROUNDS: usize = 6;
/// Most increments of a path that are chosen.
const MOST: usize = 20_000;

/// The scene with a number of increments for each branch that has none, so many that the error of
/// the shear stays within `solver.path_tolerance`, and with the estimated error of each branch.
///
/// A scene whose increments are given is returned as it is. Ends when `stop` is raised:
/// [`Error::Interrupted`] after increment 0.
pub fn choose_increments(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Scene, Error> {
    if !scene.path.is_open() {
        return Ok(scene.clone());
    }
    scene.check()?;
    let open: Vec<bool> = scene
        .path
        .branches
        .iter()
        .map(|b| b.increments.is_none())
        .collect();
    let mut chosen = scene.clone();
    begin(&mut chosen.path, scene.friction.mu > 0.0);
    if scene.friction.mu == 0.0 {
        // Pressure depends on the loads alone.
        chosen
            .path
            .branches
            .iter_mut()
            .for_each(|b| b.path_error = Some(0.0));
        return Ok(chosen);
    }
    let tolerance = scene.settings.solver.path_tolerance;
    let trial = Trial::new(&chosen, stop)?;
    for _ in 0..ROUNDS {
        let errors = trial.errors(&chosen.path)?;
        let mut more = false;
        let last = errors.len() - 1;
        for (k, branch) in chosen.path.branches.iter_mut().enumerate() {
            let PathError { q, bearable, .. } = errors[k];
            branch.path_error = Some(q);
            let allowed = match branch.spacing {
                Spacing::Uniform => ACCEPTED * tolerance,
                Spacing::EqualRadius if k < last => INHERITED * tolerance,
                Spacing::EqualRadius => tolerance * bearable.max(1.0),
            };
            if open[k] && q > allowed {
                let factor = (q / (AIM * allowed)).powf(1.0 / HOPED).min(GROWTH);
                let count = (branch.count() as f64 * factor).ceil() as usize;
                branch.increments = Some(count.next_multiple_of(2));
                more = true;
            }
        }
        if !more {
            return Ok(chosen);
        }
        if chosen.path.increments() > MOST {
            break;
        }
    }
    let errors = trial.errors(&chosen.path)?;
    for (branch, error) in chosen.path.branches.iter_mut().zip(errors) {
        branch.path_error = Some(error.q);
    }
    Ok(chosen)
}

/// What the increments leave at the end of a branch.
pub(super) struct PathError {
    /// In the shear: L2 norm, over the largest of the path.
    pub(super) q: f64,
    /// In the pressure: L2 norm, over the largest of the path.
    pub(super) p: f64,
    /// In the numbers of the branch, each in its unit.
    pub(super) numbers: [f64; 8],
    /// The shear that friction can bear there over the largest of the path (L2).
    bearable: f64,
}

impl PathError {
    /// So many times as large.
    fn times(self, factor: f64) -> Self {
        Self {
            q: factor * self.q,
            p: factor * self.p,
            numbers: self.numbers.map(|n| factor * n),
            ..self
        }
    }
}

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
pub(super) fn path_errors(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Vec<PathError>, Error> {
    Trial::new(scene, stop)?.errors(&scene.path)
}

/// Gives open branches the increments to begin with; those that begin without contact grow by equal
/// radii.
fn begin(path: &mut LoadPath, friction: bool) {
    let mut touches = false;
    for branch in &mut path.branches {
        if branch.increments.is_none() {
            if !touches {
                branch.spacing = Spacing::EqualRadius;
            }
            branch.increments = Some(match (friction, touches) {
                (false, _) => 1,
                (true, false) => FIRST.0,
                (true, true) => FIRST.1,
            });
        }
        touches = branch.to.W > 0.0 || branch.to.given.delta_z.is_some_and(|d| d > 0.0);
    }
}

/// The scene on a grid that is just fine enough, for runs along its path.
struct Trial {
    scene: Scene,
    stop: Arc<AtomicBool>,
}

impl Trial {
    /// On the coarsest grid on which the contact is not lost.
    fn new(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        let mut grids = vec![scene.grid];
        while let Some(coarse) = grids.last().and_then(halved) {
            grids.push(coarse);
        }
        let mut trial = scene.clone();
        let solver = &mut trial.settings.solver;
        solver.tolerance = solver.path_tolerance * SOLVED;
        let rolls = scene.path.branches.iter().any(|b| b.to.rolled != 0.0);
        while let Some(grid) = grids.pop() {
            if rolls && !grids.is_empty() {
                continue;
            }
            trial.grid = grid;
            let mut once = trial.clone();
            once.path
                .branches
                .iter_mut()
                .for_each(|b| b.increments = Some(1));
            if grids.is_empty() || most_contact(&once, stop)? >= CONTACT {
                break;
            }
        }
        Ok(Self {
            scene: trial,
            stop: stop.clone(),
        })
    }

    /// Estimated errors at the end of each branch.
    fn errors(&self, path: &LoadPath) -> Result<Vec<PathError>, Error> {
        let with = |count: fn(usize) -> usize| {
            let mut other = path.clone();
            for branch in &mut other.branches {
                branch.increments = Some(count(branch.count()));
            }
            other
        };
        let (change, part) = if path.branches.iter().all(|b| b.count() > 1) {
            let half = with(|n| n / 2);
            (self.change(&half, path)?, ORDER.exp2() - 1.0)
        } else {
            let twice = with(|n| 2 * n);
            (self.change(path, &twice)?, 1.0 - (-ORDER).exp2())
        };
        Ok(change.into_iter().map(|c| c.times(1.0 / part)).collect())
    }

    /// The change at the end of each branch from few increments to many, side by side.
    fn change(&self, few: &LoadPath, many: &LoadPath) -> Result<Vec<PathError>, Error> {
        let (few, many) = rayon::join(|| self.ends(few), || self.ends(many));
        let (few, many) = (few?, many?);
        let largest = |of: fn(&End) -> f64| many.iter().map(of).fold(f64::MIN_POSITIVE, f64::max);
        let (p, q) = (largest(End::p), largest(End::q));
        let mu = self.scene.friction.mu;
        Ok(few
            .iter()
            .zip(&many)
            .map(|(few, many)| {
                let (f, m) = (numbers(&few.summary), numbers(&many.summary));
                let off = |k: usize| norm(&(&few.tractions[k] - &many.tractions[k]));
                PathError {
                    q: off(1).hypot(off(2)) / q,
                    p: off(0) / p,
                    numbers: std::array::from_fn(|n| (f[n] - m[n]).abs()),
                    bearable: mu * many.p() / q,
                }
            })
            .collect())
    }

    /// The path run through, and how each branch ends.
    fn ends(&self, path: &LoadPath) -> Result<Vec<End>, Error> {
        let mut scene = self.scene.clone();
        scene.path = path.clone();
        let mut march = March::until(&scene, &self.stop)?;
        let (mut increments, mut tractions) = (Vec::new(), Vec::new());
        while let Some(increment) = march.advance() {
            let increment = of_trial(increment)?;
            increments.push(increment);
            if increment.point.ends_branch {
                let Fields { p, q_x, q_y, .. } = march.fields();
                tractions.push([p, q_x, q_y]);
            }
        }
        let ends = summarise(&increments).into_iter().zip(tractions);
        Ok(ends
            .map(|(summary, tractions)| End { summary, tractions })
            .collect())
    }
}

/// How a branch ends.
struct End {
    summary: BranchSummary,
    tractions: Tractions,
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

/// The most contact cells that the branches end with.
fn most_contact(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<usize, Error> {
    let cell_area = scene.grid.cell_area();
    let mut march = March::until(scene, stop)?;
    let mut most = 0.0_f64;
    while let Some(increment) = march.advance() {
        most = most.max(of_trial(increment)?.contact_area);
    }
    Ok((most / cell_area).round() as usize)
}

/// An increment of a trial; a stop comes before the first increment of the run itself.
fn of_trial(increment: Result<Increment, Error>) -> Result<Increment, Error> {
    increment.map_err(|error| match error {
        Error::Interrupted { .. } => Error::Interrupted { increment: 0 },
        error => error,
    })
}

/// The grid of half as many cells each way, if there is one that is not too coarse.
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
