//! Cells under friction without a limit that the shear would lift off.
//!
//! A cell at the rim of a contact with mu = infinity may have neither state: if it sticks, the
//! shear requires a tension; if it separates, it carries no shear and overlaps. The limit of large
//! mu lies between: the cell slips, under a shear that leaves it just pressed, in a region that
//! shrinks towards the rim as mu grows. A cell that has left the contact while it carried shear is
//! therefore pressed without shear when it comes back.

use crate::solvers::Interface;

/// First pass in which a cell that leaves the contact counts as lifted: the passes before only determine the
/// contact.
const FIRST_LIFTING_PASS: usize = 3;

/// Indices of these cells.
#[derive(Debug, Default)]
pub(super) struct Lifted(Vec<usize>);

impl Lifted {
    /// Removes all lifted cells.
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds the cells that the normal solver has taken out of the contact in a pass (from 1), with
    /// p = `p_before` before it.
    pub(super) fn add_lifted(
        &mut self,
        pass: usize,
        mu: &[f64],
        p_before: &[f64],
        now: &Interface,
    ) {
        if pass < FIRST_LIFTING_PASS {
            return;
        }
        let is_lifted = |&n: &usize| mu[n].is_infinite() && p_before[n] > 0.0 && now.p[n] <= 0.0;
        self.0.extend((0..mu.len()).filter(is_lifted));
    }

    /// Sets the bound of lifted cells to zero.
    pub(super) fn clear_bound(&self, bound: &mut [f64]) {
        for &n in &self.0 {
            bound[n] = 0.0;
        }
    }
}
