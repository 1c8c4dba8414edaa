//! The pressure of a paraboloid, the initial guess of a first contact.

use ndarray::Array2;

use super::problem::Problem;
use crate::scene::LoadPoint;

/// Area of a first guess over the area that carries the load at the hardness.
const ROOM: f64 = 1.3;

/// Pressure of a paraboloid, up to a factor: the approach expected at a point less the gap `h_init`. Cells are
/// as many as the load needs at the hardness, `cell_area` \[m^2\] each.
pub(super) fn pressure_of_paraboloid(
    problem: &Problem,
    point: &LoadPoint,
    h_init: &Array2<f64>,
    cell_area: f64,
) -> Array2<f64> {
    let lowest = h_init.iter().fold(f64::INFINITY, |m, h| m.min(*h));
    let approach = problem.approach_at(point, lowest);
    let mut p = h_init.map(|h| {
        if approach > 0.0 {
            (1.0 - 2.0 * (h - lowest) / approach).max(0.0).sqrt()
        } else {
            0.0
        }
    });
    let needed = (ROOM * point.loads.W / (problem.hardness * cell_area)).ceil();
    let pressed = p.iter().filter(|&&p| p > 0.0).count();
    if needed > pressed as f64 && point.loads.given.delta_z.is_none() {
        let mut heights: Vec<f64> = h_init.iter().copied().collect();
        heights.sort_unstable_by(f64::total_cmp);
        let highest = heights[(needed as usize).min(heights.len()) - 1];
        p = h_init.map(|&h| if h <= highest { 1.0 } else { 0.0 });
    }
    p
}
