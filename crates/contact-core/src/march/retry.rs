//! Increments that do not converge are retried, from the last tractions as they are, then in
//! halves.
//!
//! An extrapolated guess may lie outside the domain of convergence; without it the solution is the
//! same. Half of the increment is an easier problem, since the last state is nearer to the
//! solution. It is also a finer path, so that the result changes as with twice the increments. A
//! contact that grows by much is solved in steps to begin with ([`growing`](super::growing)).
//! [`Work::parts`](super::Work::parts) is the number of pieces in which an increment was solved. All tries
//! together have a bound on their work; beyond it the increment fails, and [`why`] names the
//! physical cause.

use super::coupling::coupling;
use super::domain::{AROUND, Domain};
use super::growing::steps;
use super::increment::increment;
use super::problem::Problem;
use super::setup::{Failure, Workspace};
use super::{Energy, Increment, Residuals, State, Yield};
use crate::error::Error;
use crate::scene::{LoadPoint, Preset};

/// Halvings of an increment before the run gives up.
const HALVINGS: u32 = 5;
/// Most convolutions for an increment, all tries together. Usual increments take a few, those at
/// the limits of friction and coupling some thousand.
pub(super) const CONVOLUTIONS: usize = 10_000;
/// mu times the coupling above which it is named as the cause of a failure.
const STRONG: f64 = 0.5;

/// The increment to `point`, in one piece if it converges, else in several; a failure leaves the
/// state unchanged.
pub(super) fn reach(
    problem: &Problem,
    domain: &mut Domain,
    state: &mut State,
    ws: &mut Workspace,
    point: &LoadPoint,
) -> Result<Increment, Failure> {
    let steps = steps(problem, state, point);
    if !steps.is_empty() {
        let before = state.clone();
        let ended = in_steps(problem, domain, state, ws, &steps, point);
        if ended.is_err() {
            *state = before;
        }
        return ended;
    }
    let mut whole = |extrapolates| increment(problem, domain, state, ws, point, extrapolates);
    let mut ended = whole(true);
    if !problem.plan.methods.retries {
        return ended;
    }
    if has_not_converged(&ended) && problem.plan.methods.extrapolation {
        ended = whole(false);
    }
    if !has_not_converged(&ended) || domain.is_spent() {
        return ended;
    }
    let before = state.clone();
    let ended = in_halves(problem, domain, state, ws, point, HALVINGS);
    if ended.is_err() {
        *state = before;
    }
    ended
}

/// The physical cause of an increment that did not converge, as the end of a sentence.
pub(super) fn why(problem: &Problem, domain: &Domain) -> String {
    let mut parts = Vec::new();
    if domain.is_spent() {
        parts.push(format!(
            "; {CONVOLUTIONS} convolutions are the most for an increment"
        ));
    }
    let friction = &problem.scene.friction;
    if problem.scene.settings.solver.preset == Preset::Spinu2020 {
        parts.push("; the preset spinu2020 is the method of the paper, for comparison".to_owned());
    } else if problem.plan.coupling && friction.mu.is_infinite() {
        parts.push("; friction without a limit holds cells that shear would lift: a finite mu lets them slip".to_owned());
    } else if problem.plan.coupling && friction.mu > 0.0 {
        let product = friction.mu * coupling(&problem.scene);
        if product > STRONG {
            parts.push(format!(
                "; mu times the coupling of the bodies, Dundurs' beta where they have no coatings, is {product:.2}: above \
                 {STRONG} a solution is not certain"
            ));
        }
    }
    if friction.varies() {
        parts.push(
            "; the coefficient of friction follows the history of the cells. Where it falls faster than the contact gives \
             way, cells slip at once and no increment is small enough"
                .to_owned(),
        );
    }
    parts.concat()
}

/// Whether an increment has ended without convergence, so that halves may help.
fn has_not_converged(ended: &Result<Increment, Failure>) -> bool {
    matches!(ended, Err(Failure::Error(Error::NotConverged { .. })))
}

/// The increment to `point` in substeps that count as one increment of the path.
fn in_steps(
    problem: &Problem,
    domain: &mut Domain,
    state: &mut State,
    ws: &mut Workspace,
    steps: &[LoadPoint],
    point: &LoadPoint,
) -> Result<Increment, Failure> {
    let mut whole: Option<Increment> = None;
    let mut take = |state: &mut State, to: &LoadPoint| {
        let mut ended = increment(problem, domain, state, ws, to, true);
        if problem.plan.methods.retries && has_not_converged(&ended) && !domain.is_spent() {
            ended = in_halves(problem, domain, state, ws, to, HALVINGS);
        }
        let step = ended.map_err(with_room_to_enter)?;
        let combined = whole.map_or(step, |before| before.followed_by(&step));
        whole = Some(combined);
        Ok::<_, Failure>(combined)
    };
    for step in steps {
        take(state, step)?;
        state.increments -= 1;
    }
    let mut increment = take(state, point)?;
    if state.work != 0.0 {
        increment.residuals.energy = increment.energy.imbalance() / state.work;
    }
    Ok(increment)
}

/// Widens the window that a failure asks for by the cells that entering cells need around them.
fn with_room_to_enter(failure: Failure) -> Failure {
    match failure {
        Failure::Narrow(half) => Failure::Narrow(half.map(|cells| cells + AROUND)),
        other => other,
    }
}

/// The increment to `point` in two halves, each halved again if needed, `halvings` times at most.
fn in_halves(
    problem: &Problem,
    domain: &mut Domain,
    state: &mut State,
    ws: &mut Workspace,
    point: &LoadPoint,
    halvings: u32,
) -> Result<Increment, Failure> {
    let mut piece = |state: &mut State, point: &LoadPoint| {
        let ended = increment(problem, domain, state, ws, point, true);
        if halvings > 1 && has_not_converged(&ended) && !domain.is_spent() {
            return in_halves(problem, domain, state, ws, point, halvings - 1);
        }
        ended
    };
    let middle = point.interpolate_to(&state.loads, state.motion.motions(), 0.5);
    let first = piece(state, &middle)?;
    // Both halves are one increment of the path.
    state.increments -= 1;
    let second = piece(state, point)?;
    let mut whole = first.followed_by(&second);
    if state.work != 0.0 {
        whole.residuals.energy = whole.energy.imbalance() / state.work;
    }
    Ok(whole)
}

impl Increment {
    /// Joins two increments to one: the state at the end of the second, the sums of energies and work, the
    /// larger residuals.
    pub(super) fn followed_by(self, second: &Self) -> Self {
        let (e, f) = (self.energy, second.energy);
        let (r, s) = (self.residuals, second.residuals);
        Self {
            energy: Energy {
                work: e.work + f.work,
                elastic: e.elastic + f.elastic,
                dissipated: e.dissipated + f.dissipated,
                plastic: e.plastic + f.plastic,
                opening: e.opening + f.opening,
                quadrature: e.quadrature + f.quadrature,
            },
            residuals: Residuals {
                gap: r.gap.max(s.gap),
                penetration: r.penetration.max(s.penetration),
                coulomb: r.coulomb.max(s.coulomb),
                stick: r.stick.max(s.stick),
                direction: r.direction.max(s.direction),
                angle: r.angle.max(s.angle),
                balance: r.balance.max(s.balance),
                energy: s.energy,
            },
            yielded: Yield {
                passes: self.yielded.passes + second.yielded.passes,
                ..second.yielded
            },
            work: self.work + second.work,
            ..*second
        }
    }
}
