//! Cells that friction without a limit would hold and that their shear would lift.
//!
//! A cell at the rim of a contact that never slips may have no place: while it sticks, the shear asks for a
//! tension, and once it has parted it carries no shear and overlaps. What large coefficients of friction tend
//! to lies between: the cell slips, under a shear that leaves it just pressed. So a cell that has left
//! the contact with a shear bears at most a quarter of it once it is back, and a quarter of that if it leaves
//! again.

use crate::solvers::Interface;

/// Passes from which on a cell that leaves the contact is looked at: the first ones find the contact.
const FIRST: usize = 3;
/// Part of its shear that a lifted cell bears.
const PART: f64 = 0.25;

/// The shear that such cells bear at most.
#[derive(Debug, Default)]
pub(super) struct Lifted {
    /// Number of the cell, and its bound \[Pa\].
    cells: Vec<(usize, f64)>,
}

impl Lifted {
    /// Begins anew: no cell is lifted.
    pub(super) fn clear(&mut self) {
        self.cells.clear();
    }

    /// Looks for cells that the normal solver has taken out of the contact in a pass, from 1; their pressure
    /// was `p_before`, and the shear is still theirs.
    pub(super) fn find(&mut self, pass: usize, mu: &[f64], p_before: &[f64], now: &Interface) {
        if pass < FIRST {
            return;
        }
        for n in 0..mu.len() {
            if mu[n].is_finite() || p_before[n] <= 0.0 || now.p[n] > 0.0 {
                continue;
            }
            let part = PART * now.q[0][n].hypot(now.q[1][n]);
            match self.cells.iter_mut().find(|(cell, _)| *cell == n) {
                Some((_, bound)) => *bound = bound.min(part),
                None => self.cells.push((n, part)),
            }
        }
    }

    /// Lowers the bounds of lifted cells that are in contact.
    pub(super) fn limit(&self, bound: &mut [f64]) {
        for &(n, limit) in &self.cells {
            bound[n] = bound[n].min(limit);
        }
    }
}
