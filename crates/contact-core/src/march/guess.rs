//! The first guess of an increment.

use rayon::prelude::*;

use super::setup::Setup;
use crate::cells::{CHUNK, copy, length, set_fields, sweep};
use crate::solvers::inner::scale_pressure;
use crate::solvers::{Interface, friction_bound};

/// Tractions and slip set to start from: the last increment's, extrapolated while the loads
/// keep their direction (the paper takes them as they are). At a reversal every cell is taken
/// to stick: slip needs the load to move on before it sets in again. Bodies that have not touched
/// start from the pressure of a paraboloid.
pub(super) fn first_guess(setup: &Setup<'_>, extrapolates: bool) -> Interface {
    let (problem, state) = (setup.problem, setup.state);
    let mut guess = state.interface.clone();
    if state.loads.W <= 0.0 {
        let p = setup
            .first_pressure
            .get_or_compute(problem, setup.kernel, setup.point);
        guess.p = setup.geometry.cut(problem.plan.mirror, &p);
    }
    match setup.goes_on {
        Some(factor) if extrapolates && problem.plan.methods.extrapolation => {
            let from = [&state.interface.p[..], &state.p_before];
            set_fields(from, [&mut guess.p], |_, [p, before], [guess]| {
                [guess + factor * (p - before)]
            });
            extrapolate_shear(&mut guess, &state.q_before, setup.mu, factor);
        }
        Some(_) => {}
        None if setup.stays() => {}
        None => guess.slips.fill(false),
    }
    let [sum] = sweep([], [&mut guess.p], |_, [], [p]| {
        ([p.max(0.0)], [p.max(0.0)])
    });
    if setup.drives.normal.free[0] && sum <= 0.0 {
        // Every cell would have left the contact: no extrapolation.
        copy(&state.interface.p, &mut guess.p);
    } else if setup.drives.normal.free[0] {
        scale_pressure(&mut guess.p, setup.drives.normal.sums[0], problem.hardness);
    } else {
        let hardness = problem.hardness;
        set_fields([], [&mut guess.p], |_, [], [p]| [p.min(hardness)]);
    }
    guess
}

/// Extrapolates the shear. The shortfall of a stick cell goes with the square root of its distance
/// from the moving slip front (Cattaneo: g - q ~ (c^2 - r^2)^(1/2)), so that the square of the
/// shortfall is extrapolated linearly; where that is not positive the cell starts to slip.
fn extrapolate_shear(guess: &mut Interface, q_before: &[Vec<f64>; 2], mu: &[f64], factor: f64) {
    let Interface { p, q, slips, .. } = guess;
    let [q_x, q_y] = q;
    let chunks = (
        q_x.par_chunks_mut(CHUNK),
        q_y.par_chunks_mut(CHUNK),
        slips.par_chunks_mut(CHUNK),
    );
    let chunks = chunks.into_par_iter().enumerate();
    chunks.for_each(|(chunk, (q_x, q_y, slips))| {
        for (i, n) in (chunk * CHUNK..).take(q_x.len()).enumerate() {
            let bound = friction_bound(mu[n], p[n]);
            if bound <= 0.0 {
                continue;
            }
            let q = [q_x[i], q_y[i]];
            let change = [q[0] - q_before[0][n], q[1] - q_before[1][n]];
            let moved = length(change);
            let inside = bound * bound - q[0] * q[0] - q[1] * q[1];
            let mut part = factor;
            if !slips[i] && inside > 0.0 && inside.is_finite() && moved > 0.0 {
                let along = (q[0] * change[0] + q[1] * change[1]) / moved;
                let step_to_bound = (along * along + inside).sqrt() - along;
                let before = step_to_bound + moved;
                let square = step_to_bound * step_to_bound
                    + factor * (step_to_bound * step_to_bound - before * before);
                slips[i] = square <= 0.0;
                part = (step_to_bound - square.max(0.0).sqrt()) / moved;
            }
            q_x[i] += part * change[0];
            q_y[i] += part * change[1];
        }
    });
}
