//! Fields transferred to another window with the same centre.

use crate::march::State;
use crate::plan::Mirror;
use crate::solvers::Interface;

/// A field of kept cells (`from` along x and y) in a window of other shape (`to`) with the same centre. New
/// cells get `elsewhere`; a narrower window cuts the field.
pub(super) fn embedded<T: Copy>(
    field: &[T],
    from: (usize, usize),
    to: (usize, usize),
    mirror: Mirror,
    elsewhere: T,
) -> Vec<T> {
    // Offset of the smaller window in the larger one.
    let begins =
        |from: usize, to: usize| (to.saturating_sub(from) / 2, from.saturating_sub(to) / 2);
    let (i, i_from) = begins(from.0, to.0);
    let (j, j_from) = match mirror {
        Mirror::None => begins(from.1, to.1),
        // The kept half begins at the middle row.
        Mirror::Y => (0, 0),
    };
    let (columns, rows) = (from.0.min(to.0), from.1.min(to.1));
    let mut embedded = vec![elsewhere; to.0 * to.1];
    for column in 0..columns {
        let values = &field[(i_from + column) * from.1 + j_from..][..rows];
        embedded[(i + column) * to.1 + j..][..rows].copy_from_slice(values);
    }
    embedded
}

/// An interface in another window; in a wider one the displacements of the new cells are not
/// computed.
pub(super) fn interface(
    now: &Interface,
    from: (usize, usize),
    to: (usize, usize),
    mirror: Mirror,
) -> Interface {
    now.map(
        |field| embedded(field, from, to, mirror, 0.0),
        |slips| embedded(slips, from, to, mirror, false),
    )
}

/// A state in another window; in a wider one the displacements of the new cells are not computed.
pub(in crate::march) fn state(
    state: &State,
    from: (usize, usize),
    to: (usize, usize),
    mirror: Mirror,
) -> State {
    let field = |f: &Vec<f64>| embedded(f, from, to, mirror, 0.0);
    State {
        interface: interface(&state.interface, from, to, mirror),
        total_slip: state.total_slip.each_ref().map(field),
        slip_length: field(&state.slip_length),
        dissipated: field(&state.dissipated),
        history_step: field(&state.history_step),
        indented: if state.indented.is_empty() {
            Vec::new()
        } else {
            field(&state.indented)
        },
        p_before: field(&state.p_before),
        q_before: state.q_before.each_ref().map(field),
        residual: state.residual.each_ref().map(field),
        at_limit: embedded(&state.at_limit, from, to, mirror, false),
        along: state.along.clone(),
        yielded: state.yielded.clone(),
        ..*state
    }
}
