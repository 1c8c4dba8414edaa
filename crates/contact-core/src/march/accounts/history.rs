//! The state after an increment, with the history of the material in each cell.

use super::energy::{dissipated, slip_of};
use crate::cells::{length, set_fields};
use crate::march::domain::Geometry;
use crate::march::rolled::{Roll, Rolled};
use crate::march::setup::Setup;
use crate::march::{Increment, State, Status};
use crate::plan::Mirror;
use crate::scene::History;
use crate::solvers::Interface;
use crate::solvers::no_slip::{NoSlipTerms, slip, unopposed_part};

/// The cells that did not slip in an increment.
pub(in crate::march) struct Stuck {
    /// Area of the cells that did not slip \[m^2\].
    pub(in crate::march) area: f64,
    /// Cells at the limit of friction that are among them.
    pub(in crate::march) at_limit: Vec<bool>,
}

/// Inputs of an increment other than the state.
pub(in crate::march) struct Closing<'a> {
    pub(in crate::march) geometry: &'a Geometry,
    pub(in crate::march) mirror: Mirror,
    pub(in crate::march) roll: Roll,
    pub(in crate::march) rolled: Option<&'a Rolled>,
    /// Friction coefficients at the end and at the start.
    pub(in crate::march) mu: [&'a [f64]; 2],
    /// The history that friction depends on, if any.
    pub(in crate::march) history: Option<History>,
    pub(in crate::march) no_slip: &'a NoSlipTerms,
    /// Whether the residual slip is corrected in the next increment.
    pub(in crate::march) keeps_residual: bool,
    /// d(delta_x), d(delta_y), d(phi_z) times the length \[m\].
    pub(in crate::march) shift: [f64; 3],
    pub(in crate::march) stuck: Stuck,
    /// Lower bound of the gap of the cells beyond the window \[m\].
    pub(in crate::march) clear: f64,
    /// Largest pressure that the surfaces bear \[Pa\].
    pub(in crate::march) hardness: f64,
}

/// Ends the increment: its solution `now` becomes the present state, with energies, slip and history of the
/// cells added up.
pub(in crate::march) fn close(
    state: &mut State,
    increment: &Increment,
    now: Interface,
    closing: &Closing<'_>,
) {
    keep_residual(state, increment.status, &now, closing);
    if closing.roll.cells != 0 {
        let field = |f: &Vec<f64>| closing.roll.field(closing.geometry, closing.mirror, f);
        state.total_slip = state.total_slip.each_ref().map(field);
        state.slip_length = field(&state.slip_length);
        state.dissipated = field(&state.dissipated);
    }
    let last = std::mem::replace(&mut state.interface, now);
    let before = of_history(state, closing.history).map(<[f64]>::to_vec);
    add_slip(state, &last, closing);
    if let Some(before) = before {
        let now = of_history(state, closing.history).into_iter().flatten();
        state.history_step = now.zip(before).map(|(now, before)| now - before).collect();
    }
    let point = &increment.point;
    state.step = point.loads.since(&state.loads, state.motion.motions());
    state.p_before = last.p;
    state.q_before = last.q;
    state.loads = point.loads;
    state.motion = increment.motion;
    add_indentation(state, closing);
    state.work += increment.energy.work;
    state.without_slip = closing.stuck.area;
    (state.at_limit).clone_from(&closing.stuck.at_limit);
    state.clear = closing.clear;
    state.increments += 1;
}

/// Increase of the history that friction depends on, in each cell: slip \[m\] or dissipated energy \[J/m^2\],
/// by `of`; zero in cells that stick.
pub(in crate::march) fn growth(
    setup: &Setup<'_>,
    no_slip: &NoSlipTerms,
    now: &Interface,
    shift: [f64; 3],
    of: History,
) -> Vec<f64> {
    let (last, arms) = (setup.last(), &setup.geometry.arms);
    let grows = |n: usize| {
        if now.p[n] <= 0.0 || !now.slips[n] {
            return 0.0;
        }
        let (slip, _) = slip_of(no_slip, now, last, arms.displacement_in_plane(shift, n), n);
        match of {
            History::Increment | History::Cycles => 0.0,
            History::Slip => length([slip[0], slip[1] / arms.axis_ratio]),
            History::Dissipated => {
                dissipated([setup.mu[n], setup.mu_before[n]], now, last, slip, n)
            }
        }
    };
    (0..now.p.len()).map(grows).collect()
}

/// The field of the state that holds the history that friction depends on; none if it is no field.
fn of_history(state: &State, history: Option<History>) -> Option<&[f64]> {
    match history? {
        History::Increment | History::Cycles => None,
        History::Slip => Some(&state.slip_length),
        History::Dissipated => Some(&state.dissipated),
    }
}

/// Stores the residual slip, which the next increment corrects; none in gross slip, where the shift
/// is arbitrary beyond the incipient one.
fn keep_residual(state: &mut State, status: Status, now: &Interface, closing: &Closing<'_>) {
    let keeps = closing.keeps_residual && status != Status::GrossSlip;
    let arms = &closing.geometry.arms;
    let [x_0, y_0] = closing.no_slip.displacement();
    let [x, y] = &mut state.residual;
    let tractions = [&now.p[..], &now.q[0], &now.q[1]];
    let moved = [&now.u[0][..], &now.u[1], x_0, y_0];
    let fields = ((tractions, moved), &now.slips[..]);
    set_fields(fields, [x, y], |n, ((tractions, moved), slips), _| {
        let ([p, q_x, q_y], [u_x, u_y, x_0, y_0]) = (tractions, moved);
        if !keeps || p <= 0.0 {
            return [0.0; 2];
        }
        let slip = slip(
            [u_x, u_y],
            [x_0, y_0],
            arms.displacement_in_plane(closing.shift, n),
        );
        if slips {
            unopposed_part(slip, [q_x, q_y])
        } else {
            slip
        }
    });
}

/// Adds the overlap of the cells under the hardness to the permanent indentation.
fn add_indentation(state: &mut State, closing: &Closing<'_>) {
    let (hardness, geometry) = (closing.hardness, closing.geometry);
    if hardness == f64::INFINITY {
        return;
    }
    let approach = state.approach(&geometry.arms);
    state.indented.resize(state.interface.p.len(), 0.0);
    let fields = [
        &state.interface.p[..],
        &state.interface.u_z,
        &geometry.h_init,
    ];
    set_fields(fields, [&mut state.indented], |n, [p, u_z, h], [depth]| {
        let gap = u_z + h - geometry.arms.displacement_across(approach, n);
        [depth + if p >= hardness { (-gap).max(0.0) } else { 0.0 }]
    });
}

/// Adds the slip and the dissipated energy of the increment to the histories of the cells.
fn add_slip(state: &mut State, last: &Interface, closing: &Closing<'_>) {
    let now = &state.interface;
    let before = closing.rolled.map_or(last, |rolled| &rolled.interface);
    let (arms, [mu, mu_before]) = (&closing.geometry.arms, closing.mu);
    let [slip_x, slip_y] = &mut state.total_slip;
    let histories = [
        &mut slip_x[..],
        slip_y,
        &mut state.slip_length,
        &mut state.dissipated,
    ];
    let pressures = [&now.p[..], &before.p];
    set_fields(pressures, histories, |n, [p, p_before], old| {
        let [x, y, length, energy] = old;
        if p <= 0.0 && p_before <= 0.0 {
            return old;
        }
        let rigid = arms.displacement_in_plane(closing.shift, n);
        let (slip, _) = slip_of(closing.no_slip, now, before, rigid, n);
        let energy = energy + dissipated([mu[n], mu_before[n]], now, before, slip, n);
        if !(p > 0.0 && now.slips[n]) {
            return [x, y, length, energy];
        }
        let distance = crate::cells::length([slip[0], slip[1] / arms.axis_ratio]);
        [x + slip[0], y + slip[1], length + distance, energy]
    });
}
