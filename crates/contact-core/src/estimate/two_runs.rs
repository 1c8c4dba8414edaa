//! A scene solved twice along its path, differently: what changes at the ends of the branches.
//!
//! The states at the ends of the branches are kept: a path with the same first branches as the last
//! one is continued from there.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ndarray::Array2;

use super::numbers::{NUMBERS, numbers};
use crate::error::Error;
use crate::march::{BranchSummary, Increment, March, Motion, State, Tractions, summarise};
use crate::scene::{Branch, LoadPath, Scene};

/// Error of the increments at the end of a branch.
#[derive(Clone, Default)]
pub(crate) struct PathError {
    /// Error of the shear: L2 norm, over the largest of the path.
    pub(crate) q: f64,
    /// Error of the pressure: L2 norm, over the largest of the path.
    pub(crate) p: f64,
    /// Numbers of the branch, each in its unit, minus the numbers with many increments.
    pub(crate) numbers: [f64; NUMBERS],
    /// Error of the residual displacement of bodies that yield: L2 norm, over the largest of the path.
    pub(crate) residual: f64,
    /// The larger of the errors of the shift and of the dissipated energy, each over the largest of
    /// the path.
    pub(crate) motion: f64,
    /// Whether the shift follows from a force.
    pub(crate) driven: bool,
    /// The shear there over the largest of the path (L2).
    pub(crate) reached: f64,
    /// The shear that friction can bear there over the largest of the path (L2).
    pub(crate) bearable: f64,
    /// Energy dissipated in the branch \[J\].
    pub(crate) dissipated: f64,
    /// Mean width of the ring of slip there \[m\].
    pub(crate) ring: f64,
    /// [`unconfirmed_peak`] of the run with few increments by the run with many, and the reverse \[Pa\].
    pub(crate) unconfirmed: [f64; 2],
}

/// Above SLIDING times the limit of friction shift and energy grow without bound while the shear
/// hardly changes; their errors may be RUN_AWAY times the error of the shear.
const SLIDING: f64 = 0.99;
const RUN_AWAY: f64 = 3.0;

impl PathError {
    /// Whether a given force is near the limit of friction.
    pub(crate) fn is_near_sliding(&self) -> bool {
        self.driven && self.reached > SLIDING * self.bearable
    }

    /// The error by which increments are chosen: of the shear; near full sliding the larger of it and the
    /// scaled error of shift and energy.
    pub(crate) fn chosen_by(&self) -> f64 {
        if self.is_near_sliding() {
            self.q.max(self.motion / RUN_AWAY)
        } else {
            self.q
        }
    }

    /// Adds the errors of the fields p and q of another source.
    pub(crate) fn add_fields(&mut self, other: &Self) {
        self.p += other.p;
        self.q += other.q;
    }

    /// Adds the errors of the numbers of another source, whose signs are not known.
    pub(crate) fn add_numbers(&mut self, other: &Self) {
        for (error, other) in self.numbers.iter_mut().zip(other.numbers) {
            *error += other.abs().copysign(*error);
        }
    }

    /// All errors times a factor.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self {
            q: factor * self.q,
            p: factor * self.p,
            residual: factor * self.residual,
            motion: factor * self.motion,
            numbers: self.numbers.map(|n| factor * n),
            ..self
        }
    }
}

/// The runs, the coarser one first.
pub(crate) struct TwoRuns {
    few: Run,
    many: Run,
    mu: f64,
    /// The largest p and q at the end of a branch so far (L2).
    largest: (f64, f64),
    /// The largest shift and the largest energy dissipated in a branch, so far \[m, J\].
    moved: (f64, f64),
}

impl TwoRuns {
    /// Sets up two runs, one for few increments and one for many.
    pub(crate) fn new(few: &Scene, many: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        Ok(Self {
            few: Run::new(few, stop)?,
            many: Run::new(many, stop)?,
            mu: many.friction.mu,
            largest: (f64::MIN_POSITIVE, f64::MIN_POSITIVE),
            moved: (f64::MIN_POSITIVE, f64::MIN_POSITIVE),
        })
    }

    /// Substeps in which contacts grow.
    pub(crate) fn growth_steps(&self) -> usize {
        self.many.growth_steps
    }

    /// Sets the substeps in which contacts grow, of the run in few and of the run in many increments.
    pub(crate) fn grow_in(&mut self, [few, many]: [usize; 2]) {
        self.few.grow_in(few);
        self.many.grow_in(many);
    }

    /// Solves the end of an indentation in many increments again, from what the stick zone remembers on its own
    /// grid; returns whether the scene allows this.
    pub(crate) fn remember(&mut self) -> bool {
        self.many.march.remember_on_its_grid()
    }

    /// Solves the first `branches` of a path once for both runs, which differ only in the grid of their path
    /// there.
    pub(crate) fn share(&mut self, path: &LoadPath, branches: usize) -> Result<(), Error> {
        let mut first = path.clone();
        first.branches.truncate(branches);
        let ends = self.few.solve_path(&first)?.iter().cloned();
        self.many.ends = ends.map(End::on_the_grid_alone).collect();
        Ok(())
    }

    /// Solves the path in few and in many increments in parallel; returns the change between them at the end of
    /// each branch.
    pub(crate) fn change(
        &mut self,
        few: &LoadPath,
        many: &LoadPath,
    ) -> Result<Vec<PathError>, Error> {
        let (few, many) = rayon::join(|| self.few.solve_path(few), || self.many.solve_path(many));
        let (few, many) = (few?, many?);
        for end in many {
            let (p, q) = self.largest;
            self.largest = (p.max(end.pressure_norm()), q.max(end.shear_norm()));
            let (shift, energy) = self.moved;
            let Motion {
                delta_x, delta_y, ..
            } = end.summary.motion;
            self.moved = (
                shift.max(delta_x.hypot(delta_y)),
                energy.max(end.summary.dissipated),
            );
        }
        let change_of_residual = |end: &End, from: Option<&End>| -> f64 {
            let residual_displacement = |end: &End| -> Vec<f64> {
                let bodies = end.state.yielded.iter().flat_map(|yielded| &yielded.bodies);
                bodies.flat_map(|body| body.displacement.clone()).collect()
            };
            let (own, other) = (
                residual_displacement(end),
                from.map_or_else(Vec::new, residual_displacement),
            );
            let reference = other.into_iter().chain(std::iter::repeat(0.0));
            let squares = own.iter().zip(reference).map(|(a, b)| (a - b) * (a - b));
            squares.sum::<f64>().sqrt()
        };
        let largest = many.iter().map(|end| change_of_residual(end, None));
        let largest = largest.fold(f64::MIN_POSITIVE, f64::max);
        let ((p, q), (shift, energy)) = (self.largest, self.moved);
        let pairs = few.iter().zip(many);
        Ok(pairs
            .map(|(few, many)| {
                let (f, m) = (numbers(&few.summary), numbers(&many.summary));
                let off = |k: usize| norm(&(&few.tractions[k] - &many.tractions[k]));
                let (one, other) = (few.summary.motion, many.summary.motion);
                let prescribed = many.summary.loads.given;
                let shifts = (one.delta_x - other.delta_x).hypot(one.delta_y - other.delta_y);
                let energies = (few.summary.dissipated - many.summary.dissipated).abs();
                PathError {
                    motion: (shifts / shift).max(energies / energy),
                    q: off(1).hypot(off(2)) / q,
                    p: off(0) / p,
                    residual: change_of_residual(many, Some(few)) / largest,
                    numbers: std::array::from_fn(|n| f[n] - m[n]),
                    driven: prescribed.delta_x.is_none() && prescribed.delta_y.is_none(),
                    reached: many.shear_norm() / q,
                    bearable: self.mu * many.pressure_norm() / q,
                    dissipated: many.summary.dissipated,
                    ring: if many.summary.contact_radius > 0.0 {
                        (1.0 - many.summary.stick_ratio.sqrt()) * many.summary.contact_radius
                    } else {
                        0.0
                    },
                    unconfirmed: [
                        unconfirmed_peak(&few.tractions, &many.tractions),
                        unconfirmed_peak(&many.tractions, &few.tractions),
                    ],
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
#[derive(Clone)]
struct End {
    branch: Branch,
    state: State,
    summary: BranchSummary,
    tractions: Tractions,
}

impl Run {
    /// Sets up a run that has solved nothing yet.
    fn new(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        let march = March::until(scene, stop)?;
        Ok(Self {
            growth_steps: march.plan().methods.growth_steps,
            march,
            ends: Vec::new(),
        })
    }

    /// Sets the substeps in which contacts grow. A change discards the solved branches.
    fn grow_in(&mut self, steps: usize) {
        if self.growth_steps != steps {
            self.growth_steps = steps;
            self.march.grow_in(steps);
            self.ends.clear();
        }
    }

    /// Solves the path, from the end of the last branch that is known already; returns the ends of all its
    /// branches.
    fn solve_path(&mut self, path: &LoadPath) -> Result<&[End], Error> {
        let kept_ends = self.ends.iter().zip(&path.branches);
        let kept_ends = kept_ends.take_while(|(end, branch)| end.branch == without_error(branch));
        self.ends.truncate(kept_ends.count());
        let state = self.ends.last().map(|end| end.state.clone());
        self.march.go_along(path, state);
        let mut increments = Vec::new();
        while let Some(increment) = self.march.advance() {
            let increment = increment_of_trial(increment)?;
            increments.push(increment);
            if increment.point.ends_branch {
                let tractions = self.march.tractions();
                self.ends
                    .extend(summarise(&increments).pop().map(|summary| End {
                        branch: without_error(&path.branches[increment.point.branch]),
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

/// The branch without its estimated error, to compare what is to be solved.
fn without_error(branch: &Branch) -> Branch {
    Branch {
        path_error: None,
        ..*branch
    }
}

impl End {
    /// The end of a branch without the state of the path grid.
    fn on_the_grid_alone(mut self) -> Self {
        self.state.along = None;
        self
    }

    /// Norm of the pressure \[Pa\], root of the sum of squares over the cells.
    fn pressure_norm(&self) -> f64 {
        norm(&self.tractions[0])
    }

    /// Norm of the shear \[Pa\], root of the sum of squares over the cells.
    fn shear_norm(&self) -> f64 {
        norm(&self.tractions[1]).hypot(norm(&self.tractions[2]))
    }
}

/// The part of the largest shear traction that another run does not confirm \[Pa\]: max |q| - max (|q| - |q -
/// q'|).
///
/// Cells that enter the contact within an increment keep a shear that belongs to its end. The error is a
/// ripple with peaks at the borders of the increments. It falls like n^-1/2 at the peaks, while the
/// largest |q| jumps from peak to peak: its change from n/2 to n is no error of it.
fn unconfirmed_peak([_, x, y]: &Tractions, [_, other_x, other_y]: &Tractions) -> f64 {
    let (mut largest, mut confirmed) = (0.0_f64, 0.0_f64);
    let cells = x.iter().zip(y).zip(other_x.iter().zip(other_y));
    for ((x, y), (other_x, other_y)) in cells {
        let q = x.hypot(*y);
        largest = largest.max(q);
        confirmed = confirmed.max(q - (x - other_x).hypot(y - other_y));
    }
    largest - confirmed
}

/// Root of the sum of squares of a field.
fn norm(f: &Array2<f64>) -> f64 {
    f.iter().map(|f| f * f).sum::<f64>().sqrt()
}

/// Passes on an increment of a trial. An interruption counts as one before the first increment of the run.
pub(crate) fn increment_of_trial(increment: Result<Increment, Error>) -> Result<Increment, Error> {
    increment.map_err(|error| match error {
        Error::Interrupted { .. } => Error::Interrupted { increment: 0 },
        error => error,
    })
}
