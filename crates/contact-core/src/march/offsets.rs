//! Offsets: displacements that the surfaces have without tractions, in the gap and in the plane.
//!
//! An increment begins with a new set of them. The gap grows by theirs, and the slip, eq. (7), counts
//! their change like the change of the elastic displacement: the displacement of the material at the
//! start of the increment is lowered by the change.

use super::domain::Geometry;
use super::state::State;
use crate::cells::{Arms, set_fields};
use crate::plan::Mirror;
use crate::yielding::Residual;

/// Offsets on the kept cells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Offsets {
    /// u_x, u_y \[m\], u_y stretched as the solver's.
    u: [Vec<f64>; 2],
    /// Growth of the gap \[m\].
    gap: Vec<f64>,
}

impl Offsets {
    /// Folds residual displacements \[m\] on the grid of the scene to the kept cells.
    pub(super) fn from_residual(residual: &Residual, arms: &Arms, mirror: Mirror) -> Self {
        let [x, y] = [&residual.u[0], &residual.u[1]].map(|u| mirror.fold(u));
        Self {
            u: [x, y.iter().map(|y| y * arms.axis_ratio).collect()],
            gap: mirror.fold(&residual.gap),
        }
    }
}

/// Replaces the offsets `from` that a state was solved with by `to`, in its displacements and in the gap.
/// `bare` is the gap without any offsets \[m\].
pub(super) fn replace(
    state: &mut State,
    geometry: &mut Geometry,
    bare: &[f64],
    [from, to]: [&Offsets; 2],
) {
    let interface = &mut state.interface;
    let [x, y] = &mut interface.u;
    let change = [
        (x, &from.u[0], &to.u[0]),
        (y, &from.u[1], &to.u[1]),
        (&mut interface.u_z, &from.gap, &to.gap),
    ];
    for (u, from, to) in change {
        set_fields([&from[..], to], [u], |_, [from, to], [u]| [u - (to - from)]);
    }
    let gap = &mut geometry.h_init;
    set_fields([bare, &to.gap], [gap], |_, [bare, offset], _| {
        [bare + offset]
    });
}
