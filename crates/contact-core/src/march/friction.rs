//! The friction coefficient of each cell, after what its material has been through.

use super::State;
use super::domain::Geometry;
use super::problem::Problem;
use super::rolled::{Roll, Rolled};
use crate::scene::History;

/// Sets `mu` for an increment, the material rolled as it is.
pub(super) fn update(
    problem: &Problem,
    geometry: &Geometry,
    state: &State,
    (roll, rolled): (&Roll, Option<&Rolled>),
    mu: &mut [f64],
) {
    let friction = &problem.scene.friction;
    let changes = friction.kinetic.is_some() || friction.history.is_some();
    if !changes && geometry.friction_map.is_empty() {
        return;
    }
    let last = rolled.map_or(&state.interface, |rolled| &rolled.interface);
    let origin = |n: usize| roll.origin(geometry, problem.plan.mirror, n);
    for (n, mu) in mu.iter_mut().enumerate() {
        let slipped = friction.kinetic.filter(|_| last.slip[n]);
        let map = geometry.friction_map.get(n).copied().unwrap_or(1.0);
        let history = friction.history.as_ref().map_or(1.0, |history| {
            history.factor(match history.of {
                History::Increment => state.increments as f64,
                History::Slip => origin(n).map_or(0.0, |n| state.slip_length[n]),
                History::Dissipated => origin(n).map_or(0.0, |n| state.dissipated[n]),
            })
        });
        let factor = map * history;
        *mu = if factor > 0.0 {
            slipped.unwrap_or(friction.mu) * factor
        } else {
            0.0
        };
    }
}
