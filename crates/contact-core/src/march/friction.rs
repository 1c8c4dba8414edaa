//! The friction coefficient of each cell as a function of the history of its material.
//!
//! The bound at the end of an increment depends on the history up to then, and so on the slip of
//! the increment itself. The increment is solved with an extrapolated history, then again with the
//! history that the solution gives, until the coefficient no longer changes.

use super::setup::Setup;
use crate::error::Error;
use crate::scene::{CellHistory, History, UserFriction};

/// Most corrections of the coefficient in an increment, and the relative change that ends them.
pub(super) const CORRECTIONS: usize = 8;
const LEAST_CHANGE: f64 = 1e-3;

/// Sets `mu` at the end of an increment in which the history of cell n grows by `grows(n)`, and
/// `before` at its start for the same material (rolling included).
pub(super) fn update(
    setup: &Setup<'_>,
    grows: impl Fn(usize) -> f64,
    [mu, before]: [&mut [f64]; 2],
) {
    let (geometry, state) = (setup.geometry, setup.state);
    let friction = &setup.problem.scene.friction;
    let exposed = &setup.problem.surface.friction;
    if !friction.varies() && geometry.friction_map.is_empty() && exposed.is_empty() {
        return;
    }
    let last = setup.last();
    let origin = |n: usize| setup.roll.origin(geometry, setup.problem.plan.mirror, n);
    for (n, (mu, before)) in mu.iter_mut().zip(before).enumerate() {
        let level = friction.mu_of_cell(last.slips[n]);
        let map = geometry.friction_map.get(n).copied().unwrap_or(1.0)
            * exposed.get(n).copied().unwrap_or(1.0);
        let at = |field: &[f64]| origin(n).map_or(0.0, |n| field[n]);
        let factors = friction.history.as_ref().map_or([1.0; 2], |history| {
            let so_far = match history.of {
                History::Increment => return [history.factor(state.increments as f64); 2],
                History::Cycles => return [history.factor(setup.problem.cycles); 2],
                History::Slip => at(&state.slip_length),
                History::Dissipated => at(&state.dissipated),
            };
            [so_far + grows(n), so_far].map(|of| history.factor(of))
        });
        [*mu, *before] = factors.map(|history| {
            let factor = map * history;
            if factor > 0.0 { level * factor } else { 0.0 }
        });
    }
}

/// The pressure at the end of an increment, and by how much slip and dissipated energy have grown.
pub(super) struct Solved<'a> {
    pub(super) p: &'a [f64],
    pub(super) slip: &'a [f64],
    pub(super) dissipated: &'a [f64],
}

/// Sets `mu` by a user's law: at the start of an increment (`solved` is none), or at the end of one that is
/// solved.
pub(super) fn by_law(
    setup: &Setup<'_>,
    law: &UserFriction,
    solved: Option<&Solved<'_>>,
    mu: &mut [f64],
) -> Result<(), Error> {
    let (geometry, state) = (setup.geometry, setup.state);
    let (mirror, arms) = (setup.problem.plan.mirror, &geometry.arms);
    let in_metres = |of: &[f64]| of.iter().map(|of| of * arms.length).collect::<Vec<_>>();
    let grown = |field: &[f64], by: Option<&[f64]>| -> Vec<f64> {
        (0..mu.len())
            .map(|n| {
                let so_far = setup
                    .roll
                    .origin(geometry, mirror, n)
                    .map_or(0.0, |n| field[n]);
                so_far + by.map_or(0.0, |by| by[n])
            })
            .collect()
    };
    let surface = &setup.problem.surface;
    let (zeros, ones) = (vec![0.0; mu.len()], vec![1.0; mu.len()]);
    let field = |field: &'_ [f64], fresh: &'_ [f64]| -> Vec<f64> {
        if field.is_empty() { fresh } else { field }.to_vec()
    };
    let [worn1, worn2] = surface.worn.each_ref().map(|worn| field(worn, &zeros));
    let [layer1, layer2] = surface.layer.each_ref().map(|layer| field(layer, &zeros));
    let cells = CellHistory {
        worn: [&worn1, &worn2],
        layer: [&layer1, &layer2],
        bed: &field(&surface.bed, &zeros),
        aerated: &field(&surface.aerated, &ones),
        x: &in_metres(&arms.x),
        y: &in_metres(&arms.y),
        p: solved.map_or(&setup.last().p, |solved| solved.p),
        slip: &grown(&state.slip_length, solved.map(|solved| solved.slip)),
        dissipated: &grown(&state.dissipated, solved.map(|solved| solved.dissipated)),
    };
    law.coefficients(&cells, setup.problem.scene.friction.mu, mu)
}

/// Returns the expected growth of the history of each cell: the growth in the last increment times the ratio of
/// the steps; zero where the path turns.
pub(super) fn expected_growth(setup: &Setup<'_>) -> impl Fn(usize) -> f64 {
    let (ratio, mirror) = (setup.goes_on.unwrap_or(0.0), setup.problem.plan.mirror);
    move |n| {
        let from = setup.roll.origin(setup.geometry, mirror, n);
        from.map_or(0.0, |n| ratio * setup.state.history_step[n])
    }
}

/// Whether the coefficient that follows from a solution agrees with the one that it was solved
/// with.
pub(super) fn has_settled(mu: &[f64], next: &[f64]) -> bool {
    mu.iter()
        .zip(next)
        .all(|(mu, next)| (mu - next).abs() <= LEAST_CHANGE * mu)
}
