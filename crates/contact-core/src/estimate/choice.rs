//! How many increments a tolerance of the path asks for.
//!
//! Rounds of the path on a coarse grid, each with an error of every branch (`path_error`): a branch whose error
//! is too large gets more increments by the order that its error has fallen with.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::trial::{PathError, Trial};
use crate::error::Error;
use crate::scene::{Branch, LoadPath, Loads, RigidMotion, Scene, Spacing};

/// Orders that a branch may show from one round to the next.
const ORDERS: (f64, f64) = (1.25, 2.0);
/// The order that is expected before two rounds tell, but of the growth of contact and of what is nearly
/// enough, where it is the least.
const EXPECTED: f64 = 1.6;
/// Increments to begin with: of a branch that begins without contact, of one with which the path ends
/// too, whose slip rings are of interest, and of others.
const FIRST: (usize, usize, usize) = (12, 56, 6);
/// Part of the tolerance that is aimed at.
const AIM: f64 = 0.9;
/// Part of the tolerance that an estimate may come to.
const ACCEPTED: f64 = 0.9;
/// Part of the tolerance that is left to the growth of contact from nothing, over the part that the
/// shear has by then of the largest, which is what dissimilar bodies make of the load alone. Where
/// nothing follows, the error is measured against the shear that friction can bear.
const GROWN: f64 = 6.0;
/// The least and the most part that is.
const INHERITED: (f64, f64) = (0.36, 0.9);
/// Part of its error that the end of a branch has at least kept, with more increments of this branch,
/// where the error is that of the growth: what sticks keeps it.
const KEPT: f64 = 0.8;
/// Most that the number of increments of a branch grows by in a round.
const GROWTH: f64 = 4.0;
/// Times the error aimed at from which a branch gets its increments without another round: with an order that two
/// rounds have shown, and with the least order.
const NEAR: (f64, f64) = (3.0, 2.0);
/// Times the error of a growth of contact from nothing that an error has that is not inherited from it.
const OWN: f64 = 2.0;
/// Rounds of choosing.
const ROUNDS: usize = 8;
/// Most increments of a path that are chosen, and of a branch: where those are not enough (friction that falls with
/// slip is of first order) the error that they leave is told.
const MOST: usize = 20_000;
const MOST_OF_BRANCH: usize = 1000;

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
    let mut chosen = scene.clone();
    chosen.settings.solver.tolerance = Some(scene.tolerance());
    begin(&mut chosen.path, scene.friction.mu > 0.0);
    if scene.friction.mu == 0.0 {
        // Pressure depends on the loads alone.
        let branches = chosen.path.branches.iter_mut();
        branches.for_each(|b| b.path_error = Some(0.0));
        return Ok(chosen);
    }
    let mut trial = Trial::new(&chosen, stop)?;
    let mut choice = Choice::new(scene, chosen.path);
    let settled = choice.settle(&mut trial)?;
    chosen.path = choice.path;
    // At the end what given increments leave counts.
    if !settled || choice.open.contains(&false) {
        let errors = trial.errors(&chosen.path, |_| true)?;
        for (branch, error) in chosen.path.branches.iter_mut().zip(errors) {
            branch.path_error = Some(error.q);
        }
    }
    Ok(chosen)
}

/// The increments as chosen so far.
struct Choice {
    path: LoadPath,
    /// Branches whose increments are chosen.
    open: Vec<bool>,
    /// What a branch had in the last round in which it was refined, and the error with it.
    before: Vec<Option<(usize, f64)>>,
    /// Largest part of the tolerance left to a growth of contact.
    most_inherited: f64,
    /// `solver.path_tolerance`.
    tolerance: f64,
}

impl Choice {
    fn new(scene: &Scene, path: LoadPath) -> Self {
        let branches = &scene.path.branches;
        Self {
            path,
            open: branches.iter().map(|b| b.increments.is_none()).collect(),
            before: vec![None; branches.len()],
            most_inherited: INHERITED.1,
            tolerance: scene.settings.solver.path_tolerance,
        }
    }

    /// Rounds until every branch has an error that is allowed; whether that came about.
    fn settle(&mut self, trial: &mut Trial) -> Result<bool, Error> {
        let last = self.path.branches.len() - 1;
        let mut until = last;
        for _ in 0..ROUNDS {
            let mut part = self.path.clone();
            part.branches.truncate(until + 1);
            // Whatever given increments leave is no matter of those that are chosen.
            let errors = trial.errors(&part, |k| self.open[k])?;
            until = match self.refine(&errors) {
                None if until == last => return Ok(true),
                // What follows the growth of contact starts from it.
                Some(k) if self.path.branches[k].spacing == Spacing::EqualRadius => k,
                _ => last,
            };
            if self.path.increments() > MOST {
                break;
            }
        }
        Ok(false)
    }

    /// More increments for the branches whose error is too large; the first of them to look at again.
    fn refine(&mut self, errors: &[PathError]) -> Option<usize> {
        self.see_what_is_inherited(errors);
        // The error of a growth of contact that is still too large.
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

    /// Leaves less of the tolerance to the growths of contact where more increments of a later branch
    /// have not lowered its error.
    fn see_what_is_inherited(&mut self, errors: &[PathError]) {
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

    /// The error that branch `k` may have.
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

/// Gives a branch the increments with which its error comes to what is allowed, by what it was with fewer of them;
/// whether they need no other round.
fn refine(
    branch: &mut Branch,
    error: f64,
    allowed: f64,
    before: &mut Option<(usize, f64)>,
) -> bool {
    let count = branch.equal_increments();
    let grows = branch.spacing == Spacing::EqualRadius;
    let excess = error / (AIM * allowed);
    let limit = if before.is_some() { NEAR.0 } else { NEAR.1 };
    let near = !grows && excess <= limit;
    let order = match *before {
        Some(before) => order(before, (count, error)),
        None if grows || near => ORDERS.0,
        None => EXPECTED,
    };
    *before = Some((count, error));
    let factor = excess.powf(1.0 / order).min(GROWTH);
    let more = ((count as f64 * factor).ceil() as usize).next_multiple_of(2);
    let more = more.min(MOST_OF_BRANCH.max(count));
    branch.set_equal_increments(more);
    let near = near || more == count;
    if near {
        branch.path_error = Some(error * (count as f64 / more as f64).powf(order));
    }
    near
}

/// The order at which the error of a branch has fallen from one number of increments to another.
fn order(before: (usize, f64), now: (usize, f64)) -> f64 {
    let fallen = (before.1 / now.1).ln() / (now.0 as f64 / before.0 as f64).ln();
    fallen.clamp(ORDERS.0, ORDERS.1)
}

/// Gives open branches the increments to begin with. Those that begin without contact grow by equal radii, those
/// that shear from a turn of the path on have a short first increment, and those that go on, as the chords of a curve
/// do, begin with one.
fn begin(path: &mut LoadPath, friction: bool) {
    let mut touches = false;
    let last = path.branches.len() - 1;
    let steps: Vec<Loads> = (0..=last).map(|k| step(&path.branches, k)).collect();
    for (k, branch) in path.branches.iter_mut().enumerate() {
        if branch.increments.is_none() {
            let goes_on = k > 0 && steps[k].along(&steps[k - 1]).is_some();
            if !touches {
                branch.spacing = Spacing::EqualRadius;
            } else if friction && !goes_on && shears(&steps[k]) {
                branch.spacing = Spacing::ShortFirst;
            }
            branch.set_equal_increments(match (friction, touches) {
                (false, _) => 1,
                (true, false) if k < last => FIRST.0,
                (true, false) => FIRST.1,
                (true, true) if goes_on => 1,
                (true, true) => FIRST.2,
            });
        }
        touches = branch.to.W > 0.0 || branch.to.given.delta_z.is_some_and(|d| d > 0.0);
    }
}

/// The change of the loads, or of the motions in their place, in branch `k`.
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
