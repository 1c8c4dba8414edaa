//! The numbers of increments for a tolerance of the path.
//!
//! In rounds: the path is run on a coarse grid, the error of every branch estimated (`path_error`),
//! and a branch whose error is too large gets more increments, by the order with which its error
//! has fallen. Branches that repeat earlier ones, as cycles do, get the same increments.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::path_error::with_path_errors;
use super::path_grid::choose_path_grid;
use super::repeats::Repeats;
use super::trial::Trial;
use super::two_runs::PathError;
use crate::error::Error;
use crate::plan::Plan;
use crate::scene::{Branch, LoadPath, Loads, PathGrid, RigidMotion, Scene, Spacing};

/// Bounds of the order m, error ~ n^-m, computed from two rounds.
const ORDERS: (f64, f64) = (1.25, 2.0);
/// Order m assumed after the first round. For a growing contact, and where the error is nearly
/// small enough ([`NEARLY`]), the lower bound of [`ORDERS`] is assumed instead.
const EXPECTED: f64 = 1.6;
/// Increments in the first round: of a branch that starts without contact and is followed by
/// others; of one that starts without contact and ends the path (its slip ring is the result); of
/// all others.
const FIRST_ROUND: (usize, usize, usize) = (12, 56, 6);
/// Error aimed at, over the allowed error.
const AIM: f64 = 0.9;
/// Largest accepted estimate, over the tolerance.
const ACCEPTED: f64 = 0.9;
/// Allowed error of a branch in which contact grows from nothing, over the tolerance: clamp(GROWN
/// |q|/q_max, INHERITED), |q| being the norm of the shear at its end (from the load alone, of
/// dissimilar bodies) and q_max the largest of the path. If no branch follows: max(1, mu
/// |p|/q_max).
const GROWN: f64 = 6.0;
/// Bounds of that ratio; once later branches have kept their error in spite of more increments
/// ([`KEPT`]), the lower bound alone.
const INHERITED: (f64, f64) = (0.36, 0.9);
/// A branch has inherited its error from the growth of contact if more increments of its own reduce
/// it to no less than KEPT times: cells that stick keep that error.
const KEPT: f64 = 0.8;
/// Largest factor of the increments of a branch in a round.
const MOST_REFINEMENT: f64 = 4.0;
/// No other round is needed if the error is at most NEARLY times the one aimed at: NEARLY.0 with an
/// order from two rounds, NEARLY.1 with the assumed one.
const NEARLY: (f64, f64) = (3.0, 2.0);
/// An error above OWN times the error of a preceding growth of contact is not inherited from it.
const OWN: f64 = 2.0;
/// Most rounds.
const MOST_ROUNDS: usize = 8;
/// Most increments of a path and of a branch. Where these are not enough (friction that falls with
/// slip is of first order) the run reports the remaining error.
const MOST_INCREMENTS: usize = 20_000;
const MOST_OF_BRANCH: usize = 1000;

/// The scene with increments chosen for each branch that has none, for an error of the shear within
/// `solver.path_tolerance`, with the estimated error of each branch, and with the grid that the path
/// is solved on.
///
/// A scene whose increments are given keeps them; its errors are estimated where a path grid is given
/// ([`PathGrid::Cells`]). Ends when `stop` is raised:
/// [`Error::Interrupted`] after increment 0.
pub fn choose_increments(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Scene, Error> {
    if !scene.path.has_open_increments() {
        let has_estimates = scene.path.branches.iter().all(|b| b.path_error.is_some());
        return if scene.path_grid().is_some() && !has_estimates {
            with_path_errors(scene, stop)
        } else {
            Ok(scene.clone())
        };
    }
    scene.check()?;
    if scene.yields() {
        return choose_for_yielding(scene, stop);
    }
    let mut chosen = by_trial(scene, stop)?;
    choose_path_grid(&mut chosen, stop)?;
    Ok(chosen)
}

/// Chooses the increments of a scene of elastic bodies by trial runs on a coarse grid, before the path grid is
/// chosen; each branch gets its estimated error.
pub(super) fn by_trial(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Scene, Error> {
    let mut chosen = scene_of_first_round(scene);
    if scene.friction.mu == 0.0 {
        // Without friction the pressure depends on the loads alone, not on the path.
        let branches = chosen.path.branches.iter_mut();
        branches.for_each(|b| b.path_error = Some(0.0));
        return Ok(chosen);
    }
    let mut trial = Trial::new(&chosen, stop)?;
    let mut choice = Choice::new(scene, chosen.path);
    let settled = choice.settle(&mut trial)?;
    chosen.path = choice.path;
    // The errors of branches with given increments are reported, too.
    if !settled || choice.open.contains(&false) {
        let errors = trial.errors(&chosen.path, |_| true)?;
        for (branch, error) in chosen.path.branches.iter_mut().zip(errors) {
            branch.path_error = Some(error.q);
        }
    }
    Ok(chosen)
}

/// The scene to begin the choice with: the increments of the first round, and the tolerance of the whole scene
/// fixed.
pub(super) fn scene_of_first_round(scene: &Scene) -> Scene {
    let mut begun = scene.clone();
    begun.settings.solver.tolerance = Some(scene.tolerance());
    let couples = Plan::new(scene).coupling;
    begin(&mut begun.path, scene.friction.mu > 0.0, couples);
    begun
}

/// The scene with the estimated error of the shear at the end of each branch.
///
/// Compared with half of the increments, or with twice as many where a branch has only one. Ends
/// when `stop` is raised.
pub fn estimate_path_error(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Scene, Error> {
    if scene.path.has_open_increments() {
        choose_increments(scene, stop)
    } else {
        with_path_errors(scene, stop)
    }
}

/// Fewest increments of a branch of bodies that yield where no number is given: the plastic strain is
/// of second order in them.
const OF_YIELDING: usize = 12;

/// The increments of bodies that yield: as many as elastic bodies need, 12 in a branch at least, on the grid of
/// the scene.
fn choose_for_yielding(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Scene, Error> {
    let mut chosen = choose_increments(&scene.elastic(), stop)?;
    chosen.body1.plastic.clone_from(&scene.body1.plastic);
    chosen.body2.plastic.clone_from(&scene.body2.plastic);
    chosen.settings.solver.path_grid = PathGrid::Same;
    for (branch, given) in chosen.path.branches.iter_mut().zip(&scene.path.branches) {
        if given.increments.is_none() {
            branch.increments = branch.increments.map(|n| n.max(OF_YIELDING));
        }
    }
    Ok(chosen)
}

/// The increments as chosen so far.
pub(super) struct Choice {
    pub(super) path: LoadPath,
    /// Branches whose increments are chosen.
    open: Vec<bool>,
    /// Increments and error of a branch in the last round in which it was refined.
    before: Vec<Option<(usize, f64)>>,
    /// Upper bound of the allowed error of a growth of contact, over the tolerance.
    most_inherited: f64,
    /// `solver.path_tolerance`.
    tolerance: f64,
    repeats: Repeats,
}

impl Choice {
    /// Chooses the increments of the branches that have none, starting from the increments of `path`.
    pub(super) fn new(scene: &Scene, path: LoadPath) -> Self {
        let branches = scene.path.branches.iter();
        let open: Vec<bool> = branches.map(|b| b.increments.is_none()).collect();
        Self {
            before: vec![None; open.len()],
            most_inherited: INHERITED.1,
            tolerance: scene.settings.solver.path_tolerance,
            repeats: if scene.friction.varies() {
                Repeats::none(&path)
            } else {
                Repeats::new(&path, &open)
            },
            path,
            open,
        }
    }

    /// Estimates the errors and refines branches, round by round, until the error of every branch is allowed.
    /// Returns false where [`MOST_ROUNDS`] or [`MOST_INCREMENTS`] are reached before.
    fn settle(&mut self, trial: &mut Trial) -> Result<bool, Error> {
        let last = self.repeats.last();
        let mut until = last;
        for _ in 0..MOST_ROUNDS {
            let mut part = self.path.clone();
            part.branches.truncate(until + 1);
            // Only the increments that are chosen are varied.
            let errors = trial.errors(&part, |k| self.open[k])?;
            let unsettled = self.refine(&errors);
            self.repeats.fill(&mut self.path.branches);
            until = match unsettled {
                None if until == last => return Ok(true),
                // The branches after a growth of contact depend on it: they are judged once it is
                // refined.
                Some(k) if self.path.branches[k].spacing == Spacing::EqualRadius => k,
                _ => last,
            };
            if self.path.increments() > MOST_INCREMENTS {
                break;
            }
        }
        Ok(false)
    }

    /// The path up to the last branch that is no repetition of an earlier one.
    pub(super) fn without_repeats(&self) -> LoadPath {
        let mut part = self.path.clone();
        part.branches.truncate(self.repeats.last() + 1);
        part
    }

    /// Refines the branches whose error is too large. Returns whether the choice can stay: the errors were
    /// allowed, or so nearly that the new increments need no other round.
    pub(super) fn refine_and_accept(&mut self, errors: &[PathError]) -> bool {
        let unsettled = self.refine(errors);
        self.repeats.fill(&mut self.path.branches);
        unsettled.is_none()
    }

    /// Gives more increments to the open branches whose error is too large. Returns the first branch whose
    /// error must be estimated again.
    fn refine(&mut self, errors: &[PathError]) -> Option<usize> {
        self.lower_error_of_growth(errors);
        // `inherited`: the error of the last growth of contact that is still too large.
        let (mut first, mut inherited) = (None, 0.0);
        for (k, error) in errors.iter().enumerate() {
            let allowed = self.allowed(k, error);
            let branch = &mut self.path.branches[k];
            branch.path_error = Some(error.q);
            if self.open[k] && error.chosen_by() > allowed.max(OWN * inherited) {
                if !refine(branch, error.chosen_by(), allowed, &mut self.before[k]) {
                    first = first.or(Some(k));
                }
                if branch.spacing == Spacing::EqualRadius {
                    inherited = error.q;
                }
            }
        }
        first
    }

    /// Lowers the allowed error of growths of contact to the stricter value if more increments of a later
    /// branch have not lowered its own error ([`KEPT`]): it inherits the error of the growth.
    fn lower_error_of_growth(&mut self, errors: &[PathError]) {
        let keeps_its_error = |k: usize| {
            let error = errors[k].q;
            self.path.branches[k].spacing != Spacing::EqualRadius
                && self.open[k]
                && error > ACCEPTED * self.tolerance
                && self.before[k].is_some_and(|(_, before)| error > KEPT * before)
        };
        if (0..errors.len()).any(keeps_its_error) {
            self.most_inherited = INHERITED.0;
        }
    }

    /// The largest error that branch `k` may have: a part of the tolerance of the path. Growths of the contact
    /// at the start may have more, if shear later covers their error.
    fn allowed(&self, k: usize, error: &PathError) -> f64 {
        let part = match self.path.branches[k].spacing {
            Spacing::Uniform | Spacing::ShortFirst => ACCEPTED,
            Spacing::EqualRadius if k + 1 < self.path.branches.len() => {
                (GROWN * error.reached).clamp(INHERITED.0, self.most_inherited)
            }
            Spacing::EqualRadius => error.bearable.max(1.0),
        };
        part * self.tolerance
    }
}

/// Sets the number of increments for which a branch has the `allowed` error, by the order of convergence since
/// the round `before` (increments, error). Returns whether the estimate is good enough not to be repeated.
fn refine(
    branch: &mut Branch,
    error: f64,
    allowed: f64,
    before: &mut Option<(usize, f64)>,
) -> bool {
    let count = branch.equal_increments();
    let grows = branch.spacing == Spacing::EqualRadius;
    let excess = error / (AIM * allowed);
    let limit = if before.is_some() { NEARLY.0 } else { NEARLY.1 };
    let near = !grows && excess <= limit;
    let order = match *before {
        Some(before) => order(before, (count, error)),
        None if grows || near => ORDERS.0,
        None => EXPECTED,
    };
    *before = Some((count, error));
    let factor = excess.powf(1.0 / order).min(MOST_REFINEMENT);
    let count_needed = ((count as f64 * factor).ceil() as usize).next_multiple_of(2);
    let count_needed = count_needed.min(MOST_OF_BRANCH.max(count));
    branch.set_equal_increments(count_needed);
    let near = near || count_needed == count;
    if near {
        branch.path_error = Some(error * (count as f64 / count_needed as f64).powf(order));
    }
    near
}

/// The observed order of convergence: error ~ increments^-order, from two rounds (increments, error), within
/// [`ORDERS`].
fn order(before: (usize, f64), now: (usize, f64)) -> f64 {
    let fallen = (before.1 / now.1).ln() / (now.0 as f64 / before.0 as f64).ln();
    fallen.clamp(ORDERS.0, ORDERS.1)
}

/// Sets the increments of the first round of all branches that have none: equal radius from no contact; a short
/// first increment in a branch that shears after a turn of the path; a single increment where the path goes
/// straight on, as along the chords of a curve, or where nothing can slip. Nothing slips without `friction`,
/// nor as long as bodies without coupling (`couples` false) are only pressed.
fn begin(path: &mut LoadPath, friction: bool, couples: bool) {
    let mut touches = false;
    let mut only_pressed = true;
    let last = path.branches.len() - 1;
    let steps: Vec<Loads> = (0..=last).map(|k| step(&path.branches, k)).collect();
    for (k, branch) in path.branches.iter_mut().enumerate() {
        only_pressed &= branch.only_presses();
        let friction = friction && (couples || !only_pressed);
        if branch.increments.is_none() {
            let goes_on = k > 0 && steps[k].projection_factor(&steps[k - 1]).is_some();
            if !touches {
                branch.spacing = Spacing::EqualRadius;
            } else if friction && !goes_on && shears(&steps[k]) {
                branch.spacing = Spacing::ShortFirst;
            }
            branch.set_equal_increments(match (friction, touches) {
                (false, _) => 1,
                (true, false) if k < last => FIRST_ROUND.0,
                (true, false) => FIRST_ROUND.1,
                (true, true) if goes_on => 1,
                (true, true) => FIRST_ROUND.2,
            });
        }
        touches = branch.to.W > 0.0 || branch.to.given.delta_z.is_some_and(|d| d > 0.0);
    }
}

/// The change of the loads in branch `k`, or of the motions where these are given.
fn step(branches: &[Branch], k: usize) -> Loads {
    let before = k
        .checked_sub(1)
        .map_or(Loads::default(), |k| branches[k].to);
    let motions = before.given.motions().map(Option::unwrap_or_default);
    branches[k].to.since(&before, motions)
}

/// Whether a change of the loads acts along the plane.
fn shears(step: &Loads) -> bool {
    let mut in_plane = RigidMotion::ALL.into_iter().filter(|of| of.is_in_plane());
    in_plane.any(|of| step.prescribed(of).value() != 0.0)
}
