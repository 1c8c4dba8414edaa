//! Points of fretting loops.

use contact_core::estimate::ErrorBars;
use contact_core::march::{Increment, Status};
use contact_core::scene::Grid;
use contact_core::zones::slip_cells;

/// A tangential motion and the load that drives it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// T_x and delta_x.
    #[default]
    X,
    /// T_y and delta_y.
    Y,
    /// M_z and phi_z: moments \[N m\] replace forces, rotations \[rad\] replace shifts.
    Torsion,
}

/// A point of a loop: force and shift at the end of an increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPoint {
    /// Branch of the load path, from 0.
    pub branch: usize,
    /// Tangential force \[N\].
    pub T: f64,
    /// Tangential shift \[m\].
    pub delta: f64,
    /// Energy dissipated by friction in the increment \[J\].
    pub dissipated: f64,
    /// State of the interface.
    pub status: Status,
    /// Cells across the zone that slips ([`slip_cells`]).
    pub slip_cells: f64,
}

impl Direction {
    /// Errors of the dissipated energy \[J\] of a branch, and of force \[N\] and shift \[m\] at its
    /// end, for [`super::Cycle::errors`].
    pub fn errors_of(self, bars: &ErrorBars) -> [f64; 3] {
        let (T, delta) = match self {
            Self::X => (bars.T_x, bars.delta_x),
            Self::Y => (bars.T_y, bars.delta_y),
            Self::Torsion => (bars.M_z, bars.phi_z),
        };
        [bars.dissipated, T, delta].map(|bar| bar.total)
    }
}

impl LoopPoint {
    /// The point of the loop after an increment: force (or moment), shift (or rotation), energy, state.
    pub fn new(increment: &Increment, grid: &Grid, direction: Direction) -> Self {
        let (loads, motion) = (&increment.point.loads, &increment.motion);
        let (T, delta) = match direction {
            Direction::X => (loads.T_x, motion.delta_x),
            Direction::Y => (loads.T_y, motion.delta_y),
            Direction::Torsion => (loads.M_z, motion.phi_z),
        };
        Self {
            branch: increment.point.branch,
            T,
            delta,
            dissipated: increment.energy.dissipated,
            status: increment.status,
            slip_cells: slip_cells(grid, increment.contact_area, increment.stick_ratio()),
        }
    }
}
