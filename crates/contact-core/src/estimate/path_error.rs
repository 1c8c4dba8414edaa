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
/// Times the error aimed at from which a branch gets its increments without another round.
const NEAR: f64 = 2.0;
/// Times the error of a growth of contact from nothing that an error has that is not inherited from it.
const OWN: f64 = 2.0;
/// Rounds of choosing.
const ROUNDS: usize = 8;
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
    chosen.settings.solver.tolerance = Some(scene.tolerance());
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
    let mut trial = Trial::new(&chosen, stop)?;
    let last = chosen.path.branches.len() - 1;
    // What was chosen for a branch so far, and the error with it.
    let mut before: Vec<Option<(usize, f64)>> = vec![None; last + 1];
    let mut until = last;
    let mut most_inherited = INHERITED.1;
    let mut settled = false;
    for _ in 0..ROUNDS {
        let mut part = chosen.path.clone();
        part.branches.truncate(until + 1);
        // Whatever given increments leave is no matter of those that are chosen.
        let errors = trial.errors(&part, |k| open[k])?;
        let kept = |k: usize| before[k].is_some_and(|(_, error)| errors[k].q > KEPT * error);
        let uniform = |k: usize| chosen.path.branches[k].spacing != Spacing::EqualRadius;
        let over = |k: usize| open[k] && errors[k].q > ACCEPTED * tolerance;
        if (0..errors.len()).any(|k| uniform(k) && over(k) && kept(k)) {
            most_inherited = INHERITED.0;
        }
        // The first branch to look at again, and the error of a growth of contact that is still too large.
        let (mut first, mut inherited) = (None, 0.0);
        for (k, error) in errors.iter().enumerate() {
            let branch = &mut chosen.path.branches[k];
            branch.path_error = Some(error.q);
            let allowed = match branch.spacing {
                Spacing::Uniform | Spacing::ShortFirst => ACCEPTED * tolerance,
                Spacing::EqualRadius if k < last => {
                    (GROWN * error.reached).clamp(INHERITED.0, most_inherited) * tolerance
                }
                Spacing::EqualRadius => tolerance * error.bearable.max(1.0),
            };
            if open[k] && error.q > allowed.max(OWN * inherited) {
                if !refine(branch, error.q, allowed, &mut before[k]) {
                    first = first.or(Some(k));
                }
                if branch.spacing == Spacing::EqualRadius {
                    inherited = error.q;
                }
            }
        }
        until = match first {
            None if until == last => {
                settled = true;
                break;
            }
            // What follows the growth of contact starts from it.
            Some(k) if chosen.path.branches[k].spacing == Spacing::EqualRadius => k,
            _ => last,
        };
        if chosen.path.increments() > MOST {
            break;
        }
    }
    // At the end what given increments leave counts.
    if !settled || open.contains(&false) {
        let errors = trial.errors(&chosen.path, |_| true)?;
        for (branch, error) in chosen.path.branches.iter_mut().zip(errors) {
            branch.path_error = Some(error.q);
        }
    }
    Ok(chosen)
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
    let near = !grows && excess <= NEAR;
    let order = match *before {
        Some(before) => order(before, (count, error)),
        None if grows || near => ORDERS.0,
        None => EXPECTED,
    };
    *before = Some((count, error));
    let factor = excess.powf(1.0 / order).min(GROWTH);
    let more = ((count as f64 * factor).ceil() as usize).next_multiple_of(2);
    branch.set_equal_increments(more);
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
pub(crate) fn path_errors(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Vec<PathError>, Error> {
    if scene.friction.mu == 0.0 {
        // Pressure depends on the loads alone.
        let branches = scene.path.branches.iter();
        return Ok(branches.map(|_| PathError::default()).collect());
    }
    Trial::new(scene, stop)?.errors(&scene.path, |_| true)
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
