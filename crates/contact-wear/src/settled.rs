//! Open settings: the branches of the cycle and their increments.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::estimate::choose_increments;
use contact_core::scene::{PathGrid, Scene};

use super::settings::{Cycling, Wear};

/// Most chosen places of a branch of a stroke, and their distance over the half-width of the first
/// contact.
const MOST_PLACES: usize = 12;
const PLACE_DISTANCE: f64 = 0.25;
/// Fewest where the normal force changes within the branch.
const MIN_PLACES_VARYING_FORCE: usize = 4;

impl Wear {
    /// The first branch of the cycle: the given one, or the first branch of the last closed cycle
    /// of the load path.
    pub fn first_branch(&self, scene: &Scene) -> Result<usize, Error> {
        if let Some(first) = self.first_branch {
            return Ok(first);
        }
        let branches = &scene.path.branches;
        let moves = |first: usize| {
            let before = branches[first - 1].to;
            branches[first..].iter().any(|branch| branch.to != before)
        };
        let mut firsts = (1..branches.len()).rev();
        firsts
            .find(|&first| moves(first) && Self::check_closed(scene, first).is_ok())
            .ok_or_else(|| {
                let allowed = "a load path with a closed cycle: its last branch ends where an earlier one ended, as in \
                               [T, -T, T] of T_x";
                Error::invalid("path", "no closed cycle", allowed)
            })
    }

    /// Chooses the open settings of scene and wear: the cycle, and increments for the branches that
    /// have none. They are chosen by [`choose_increments`] in a march, by stroke over contact width
    /// in gross slip. Given settings stay.
    pub fn complete(&self, scene: &Scene, stop: &Arc<AtomicBool>) -> Result<(Scene, Self), Error> {
        scene.check()?;
        let mut wear = self.clone();
        wear.first_branch = Some(self.first_branch(scene)?);
        wear.check(scene)?;
        let mut scene = scene.clone();
        // The fields of every increment are wanted.
        scene.settings.solver.path_grid = PathGrid::Same;
        if wear.cycling == Cycling::Sliding {
            choose_places(&mut scene);
            return Ok((scene, wear));
        }
        Ok((choose_increments(&scene, stop)?, wear))
    }
}

/// Places for each branch of a stroke, [`PLACE_DISTANCE`] of the contact's half-width apart.
fn choose_places(scene: &mut Scene) {
    let (extent, _) = scene.grid.extent();
    let apart = PLACE_DISTANCE * scene.hertz().map_or(0.25 * extent, |hertz| hertz.a);
    let (mut at, mut W_before) = (0.0, 0.0);
    for branch in &mut scene.path.branches {
        let to = branch.to.given.delta_x.unwrap_or(at);
        let W = branch.to.W;
        let places = ((to - at).abs() / apart).ceil();
        let least = if W_before > 0.0 && (W - W_before).abs() > 1e-3 * W {
            MIN_PLACES_VARYING_FORCE
        } else {
            1
        };
        let chosen = (places as usize).clamp(least, MOST_PLACES);
        branch.increments = branch.increments.or(Some(chosen));
        (at, W_before) = (to, W);
    }
}
