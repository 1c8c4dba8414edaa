//! Continuing a march on worn surfaces.

use super::March;
use super::State;
use super::exposed_surface::ExposedSurface;

impl March {
    /// Sets the number of cycles done, of which friction may be a function.
    pub fn after_cycles(&mut self, cycles: f64) {
        self.problem.cycles = cycles;
    }

    /// Sets the surfaces that wear has left, of which friction may be a function. They stay until the
    /// next call. For scenes without a window (`skip.contact_window = false`).
    pub fn expose(&mut self, surface: ExposedSurface) {
        self.problem.surface = surface;
    }

    /// Sets the march to a state of its path, on surfaces with the gap `h_init` on the kept cells
    /// \[m\]. If wear has changed the gap, the next increment also brings the contact to the new
    /// surfaces. For scenes without a window (`skip.contact_window = false`).
    pub fn go_on_from(&mut self, state: State, h_init: &[f64]) {
        debug_assert_eq!(state.window, self.domain.shape());
        self.state = state;
        self.domain.window.geometry.h_init.copy_from_slice(h_init);
    }
}
