//! The path gone on with on other surfaces: what wear needs of the march.

use super::March;
use super::State;

impl March {
    /// Says how many cycles of wear the contact has been through, of which friction may be a function.
    pub(crate) fn after_cycles(&mut self, cycles: f64) {
        self.problem.cycles = cycles;
    }

    /// Puts the march into a state of its path, on surfaces whose gap is `h_init` on the kept cells
    /// \[m\]: what comes next begins from there. Where wear has changed the gap the first increment
    /// from there also takes the contact to the new surfaces. For scenes without a window
    /// (`skip.far = false`).
    pub(crate) fn go_on_from(&mut self, state: State, h_init: &[f64]) {
        debug_assert_eq!(state.window, self.domain.shape());
        self.state = state;
        self.domain.window.geometry.h_init.copy_from_slice(h_init);
    }
}
