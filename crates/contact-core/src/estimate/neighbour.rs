//! The increments of a scene from the increments of a neighbouring one.
//!
//! The increments n that were chosen for the neighbour are the first guess, and one comparison checks
//! them: e is the change of the shear from n/4 to n/2 increments at the end of a branch, on a grid of
//! few cells. The error E with n increments follows from the error of the neighbour (0):
//!
//! ```text
//! E = E_0 e/e_0
//! ```
//!
//! The numbers stand where every error is allowed. A branch whose error is less than twice the allowed
//! one gets more increments; beyond that they are chosen anew. The result depends on the two
//! scenes alone, so that a study gives the same bits in any order and after an interruption. What is
//! known of neighbours is kept for the process: a scene is the neighbour of many.

use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use super::choice::{Choice, by_trial, choose_increments, scene_of_first_round};
use super::path_grid::choose_path_grid;
use super::trial::Trial;
use super::two_runs::PathError;
use crate::error::Error;
use crate::scene::{LoadPath, Scene};

/// Neighbours that are kept.
const KEPT: usize = 16;

/// Data of scenes that others were compared with, the latest last.
static KNOWN: Mutex<Vec<(Scene, Arc<Known>)>> = Mutex::new(Vec::new());

/// The increments of a scene, and what a comparison of half of them gives.
struct Known {
    chosen: Scene,
    /// Cells of the grid of the comparison.
    cells: (usize, usize),
    /// Changes e of the branches that repeat no other.
    changes: Vec<f64>,
}

impl Known {
    /// Chooses the increments of a scene, and measures how much half of them changes the shear at the end of
    /// each branch.
    fn new(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        let chosen = by_trial(scene, stop)?;
        let mut trial = Trial::for_halved_increments(&chosen, None, stop)?;
        let path = Choice::new(scene, chosen.path.clone()).without_repeats();
        let changes = trial.errors(&with_half_increments(path), |_| true)?;
        Ok(Self {
            chosen,
            cells: trial.cells(),
            changes: changes.iter().map(|change| change.q).collect(),
        })
    }

    /// Returns what is known of a scene whose increments are to be taken over; it is computed once in a
    /// process.
    fn get_or_compute(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<Arc<Self>, Error> {
        let store = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let find_cached = |all: &[(Scene, Arc<Self>)]| {
            let entry = all.iter().find(|(of, _)| of == scene);
            entry.map(|(_, known)| known.clone())
        };
        if let Some(known) = find_cached(&store()) {
            return Ok(known);
        }
        let computed = Arc::new(Self::new(scene, stop)?);
        let mut cache = store();
        if cache.len() == KEPT {
            cache.remove(0);
        }
        cache.push((scene.clone(), computed.clone()));
        Ok(computed)
    }
}

/// Chooses as [`choose_increments`] does, with the increments of a neighbouring scene as the first guess.
///
/// They are chosen anew where the branches of the two paths are of different kinds, a branch of one of
/// them has its number, the bodies yield, or an error in one comparison is more than twice the
/// allowed one. Ends when `stop` is raised: [`Error::Interrupted`] after increment 0.
pub fn choose_increments_like(
    scene: &Scene,
    neighbour: &Scene,
    stop: &Arc<AtomicBool>,
) -> Result<Scene, Error> {
    if !(is_open(scene) && is_open(neighbour)) {
        return choose_increments(scene, stop);
    }
    scene.check()?;
    if neighbour.check().is_err() {
        return choose_increments(scene, stop);
    }
    let neighbour_data = match Known::get_or_compute(&without_title(neighbour), stop) {
        Ok(known) => known,
        Err(error @ Error::Interrupted { .. }) => return Err(error),
        // A neighbour without a solution gives no estimate for the scene.
        Err(_) => return choose_increments(scene, stop),
    };
    let scene_alone = without_title(scene);
    let path_if_found = if without_title(neighbour) == scene_alone {
        Some(neighbour_data.chosen.path.clone())
    } else {
        path_of_neighbour(scene, &neighbour_data, stop)?
    };
    let Some(path) = path_if_found else {
        return choose_increments(scene, stop);
    };
    let mut chosen = scene_of_first_round(scene);
    chosen.path = path;
    choose_path_grid(&mut chosen, stop)?;
    Ok(chosen)
}

/// Whether all increments of a scene are to be chosen by trial, and a neighbour's can be tried: Coulomb
/// friction that does not change along the path, elastic bodies.
fn is_open(scene: &Scene) -> bool {
    let mut branches = scene.path.branches.iter();
    branches.all(|branch| branch.increments.is_none())
        && scene.friction.mu > 0.0
        && !scene.friction.varies()
        && !scene.yields()
}

/// The scene without its title, which does not change its increments: the key of the cache.
fn without_title(scene: &Scene) -> Scene {
    let mut plain = scene.clone();
    plain.title.clear();
    plain
}

/// The path of the scene with the increments of its neighbour, if one comparison confirms that its errors are
/// allowed; none otherwise, or where the two paths are of different kinds.
fn path_of_neighbour(
    scene: &Scene,
    known: &Known,
    stop: &Arc<AtomicBool>,
) -> Result<Option<LoadPath>, Error> {
    let mut begun = scene_of_first_round(scene);
    let of_neighbour = &known.chosen.path.branches;
    let kinds = begun.path.branches.iter().zip(of_neighbour);
    let cells = |of: &Scene| (of.grid.nx, of.grid.ny, of.grid.plane_strain);
    let alike = cells(scene) == cells(&known.chosen)
        && begun.path.branches.len() == of_neighbour.len()
        && kinds
            .into_iter()
            .all(|(of, other)| of.spacing == other.spacing);
    if !alike {
        return Ok(None);
    }
    for (branch, other) in begun.path.branches.iter_mut().zip(of_neighbour) {
        branch.increments = other.increments;
    }
    let mut choice = Choice::new(scene, begun.path.clone());
    let path = choice.without_repeats();
    if path.branches.len() != known.changes.len() {
        return Ok(None);
    }
    let mut trial = Trial::for_halved_increments(&begun, Some(known.cells), stop)?;
    let changes = match trial.errors(&with_half_increments(path), |_| true) {
        Ok(changes) => changes,
        Err(error @ Error::Interrupted { .. }) => return Err(error),
        Err(_) => return Ok(None),
    };
    let of_neighbour = of_neighbour.iter().zip(&known.changes);
    let errors: Option<Vec<PathError>> = changes
        .into_iter()
        .zip(of_neighbour)
        .map(|(change, (branch, before))| {
            let error = branch.path_error?;
            let ratio = error / before;
            ratio.is_finite().then(|| change.times(ratio))
        })
        .collect();
    let stands = errors.is_some_and(|errors| choice.refine_and_accept(&errors));
    Ok(stands.then_some(choice.path))
}

/// The path with half of the increments in each branch, at least one.
fn with_half_increments(mut path: LoadPath) -> LoadPath {
    for branch in &mut path.branches {
        branch.set_equal_increments((branch.equal_increments() / 2).max(1));
    }
    path
}
