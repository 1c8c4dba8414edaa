//! Open settings: the branches of the cycle and their increments.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::estimate::choose_increments;
use contact_core::scene::{PathGrid, Scene};

use super::method::{Method, half_width};
use super::settings::{Cycling, Wear};
use super::stroke::Frame;

/// Most chosen places of a branch of a stroke, and their distance over the half-width of a spot of the first
/// contact. The pressure is taken as constant over the way between two places, on a contact that moves along.
const MOST_PLACES: usize = 48;
const APART: f64 = 0.25;
/// Distance of the places beyond [`FEW_PLACES`] of them.
const FEW_PLACES: usize = 12;
const FARTHER: f64 = 0.5;
/// Fewest where the normal force changes within the branch.
const MIN_PLACES_VARYING_FORCE: usize = 4;

impl Wear {
    /// The first branch of the cycle: the given one, or the first of the last whole cycle of the load path.
    pub fn first_branch(&self, scene: &Scene) -> Result<usize, Error> {
        Ok(self.with_cycle(scene)?.1)
    }

    /// The scene whose path ends with the cycle, and the first branch of the cycle. What comes after the last
    /// whole cycle of the load path belongs to no cycle.
    pub(crate) fn with_cycle(&self, scene: &Scene) -> Result<(Scene, usize), Error> {
        let mut scene = scene.clone();
        if let Some(first) = self.first_branch {
            return Ok((scene, first));
        }
        let (first, last) = (scene.path.last_cycle()).ok_or_else(|| scene.path.no_cycle())?;
        scene.path.branches.truncate(last + 1);
        Ok((scene, first))
    }

    /// Chooses the open settings of scene and wear: the cycle, and increments for the branches that
    /// have none. They are chosen by [`choose_increments`] in a march, by stroke over contact width
    /// in gross slip. Given settings stay.
    pub fn complete(&self, scene: &Scene, stop: &Arc<AtomicBool>) -> Result<(Scene, Self), Error> {
        scene.check()?;
        let mut wear = self.clone();
        let (mut scene, first_branch) = self.with_cycle(scene)?;
        wear.first_branch = Some(first_branch);
        wear.check(&scene)?;
        // The fields of every increment are wanted.
        scene.settings.solver.path_grid = PathGrid::Same;
        let method = Method::new(&scene, &wear, first_branch, stop)?;
        (wear.cycling, wear.note) = (method.cycling, method.note);
        wear.doubts = method.doubt.into_iter().collect();
        if wear.cycling == Cycling::Sliding {
            let half_width = match method.half_width {
                Some(half_width) => half_width,
                None => half_width(&scene, stop)?,
            };
            wear.half_width = half_width;
            choose_places(&mut scene, half_width);
            if !Frame::new(&scene).is_even(&scene) {
                scene.settings.skip.mirror = false;
            }
            return Ok((scene, wear));
        }
        Ok((choose_increments(&scene, stop)?, wear))
    }
}

/// Chooses the increments of each branch of a stroke, from the half-width of a spot \[m\].
fn choose_places(scene: &mut Scene, half_width: f64) {
    let (mut at, mut W_before) = (0.0, 0.0);
    for branch in &mut scene.path.branches {
        let to = branch.to.given.delta_x.unwrap_or(at);
        let W = branch.to.W;
        let places = |apart: f64| ((to - at).abs() / (apart * half_width)).ceil() as usize;
        let least = if W_before > 0.0 && (W - W_before).abs() > 1e-3 * W {
            MIN_PLACES_VARYING_FORCE
        } else {
            1
        };
        let many = places(FARTHER).max(FEW_PLACES);
        let chosen = places(APART).min(many).clamp(least, MOST_PLACES);
        branch.increments = branch.increments.or(Some(chosen));
        (at, W_before) = (to, W);
    }
}
