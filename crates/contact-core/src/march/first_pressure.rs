//! The initial guess of the pressure of a first contact.

use ndarray::Array2;

use super::problem::Problem;
use crate::scene::LoadPoint;

/// Initial pressure of bodies that have not touched, on the whole grid: up to a factor that of a
/// paraboloid of the approach expected at a point; uniform without
/// [`Methods::first_contact`](crate::plan::Methods::first_contact).
pub(super) fn first_pressure(problem: &Problem, point: &LoadPoint) -> Array2<f64> {
    let h_init = problem.scene.h_init();
    if !problem.plan.methods.first_contact {
        return Array2::ones(h_init.dim());
    }
    let lowest = h_init.iter().fold(f64::INFINITY, |m, h| m.min(*h));
    let approach = problem.approach_at(point, lowest);
    h_init.map(|h| {
        if approach > 0.0 {
            (1.0 - 2.0 * (h - lowest) / approach).max(0.0).sqrt()
        } else {
            0.0
        }
    })
}
