//! The error of the shear at the ends of the branches, with what the run itself shows of it.
//!
//! The estimate of `path_error` comes from a coarse grid. Where the ring of slip of a contact that
//! grows is narrower than a cell of that grid, it does not know the slip that cells miss which come
//! to stick within an increment. The run has it in the scatter of its shear from cell to cell. In 50
//! random indentations of dissimilar bodies, 42 cells across their radius, the error over the
//! scatter is between 0.4 and 1.6.
//!
//! While bodies are only pressed, it is the scatter of that time. Afterwards a cell that sticks
//! keeps the error, one that slips loses it, and the scatter grows by the bends of a shear that
//! turns: the least scatter since is a bound.

use super::Increment;
use super::accounts::SAMPLES;
use super::growing::are_paraboloids;
use crate::scene::Scene;

/// For every branch of a scene, the error of the shear at its end: L2 norm over the largest of the
/// path. Its `path_error` (0 if it has none) and, where smooth bodies came into contact on
/// 32 cells across the radius or more, the scatter of the shear, as independent errors.
///
/// `increments` belong to a run; the ends of branches are enough.
pub fn shear_errors(scene: &Scene, increments: &[Increment]) -> Vec<f64> {
    let branches = scene.path.branches.iter();
    let mut errors: Vec<f64> = branches.map(|b| b.path_error.unwrap_or(0.0)).collect();
    let ends = increments.iter().filter(|i| i.point.ends_branch);
    let cells = ends.clone().map(|end| end.cells_per_radius);
    if cells.fold(0.0, f64::max) < SAMPLES || !are_paraboloids(scene) {
        return errors;
    }
    let over_contact = |rms: f64, end: &Increment| rms * end.contact_area.sqrt();
    let shears = ends.clone().map(|end| over_contact(end.q_rms, end));
    let largest = shears.fold(f64::MIN_POSITIVE, f64::max);
    let branches = scene.path.branches.iter();
    let pressed = branches.take_while(|branch| branch.only_presses()).count();
    let mut kept = f64::INFINITY;
    for end in ends {
        let scatter = over_contact(end.q_scatter.unwrap_or(0.0), end);
        kept = if end.contact_area <= 0.0 {
            f64::INFINITY
        } else if end.point.branch < pressed {
            scatter
        } else {
            kept.min(scatter)
        };
        if let Some(error) = errors.get_mut(end.point.branch)
            && kept.is_finite()
        {
            *error = error.hypot(kept / largest);
        }
    }
    errors
}
