//! Cells that friction without a limit would hold and that their shear would lift.
//!
//! A cell at the rim of a contact that never slips may have no place: while it sticks, the shear asks for a
//! tension, and once it has parted it carries no shear and overlaps. What large coefficients of friction tend
//! to lies between: the cell slips, under a shear that leaves it just pressed, in a region that shrinks towards
//! the rim. So a cell that has left the contact with a shear is pressed without shear once it is back.

use crate::solvers::Interface;

/// Passes from which on a cell that leaves the contact is looked at: the first ones find the contact.
const FIRST: usize = 3;

/// The numbers of such cells.
#[derive(Debug, Default)]
pub(super) struct Lifted(Vec<usize>);

impl Lifted {
    /// Begins anew: no cell is lifted.
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// Looks for cells that the normal solver has taken out of the contact in a pass, from 1; their pressure
    /// was `p_before`.
    pub(super) fn find(&mut self, pass: usize, mu: &[f64], p_before: &[f64], now: &Interface) {
        if pass < FIRST {
            return;
        }
        let left = |&n: &usize| mu[n].is_infinite() && p_before[n] > 0.0 && now.p[n] <= 0.0;
        self.0.extend((0..mu.len()).filter(left));
    }

    /// Takes the bounds of lifted cells away.
    pub(super) fn limit(&self, bound: &mut [f64]) {
        for &n in &self.0 {
            bound[n] = 0.0;
        }
    }
}
