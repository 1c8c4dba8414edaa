//! The bulk stress of the body that is looked at, beside what its tractions cause.

use crate::scene::{Body, Grid};

/// The bulk stress of a body under each of several states.
#[derive(Clone, Debug, Default)]
pub(super) struct Bulk {
    sigma_B: Vec<f64>,
    plane_strain: bool,
}

impl Bulk {
    /// Of each state \[Pa\].
    pub(super) fn new(sigma_B: &[f64], grid: &Grid) -> Self {
        Self {
            sigma_B: sigma_B.to_vec(),
            plane_strain: grid.plane_strain,
        }
    }

    /// s_xx and s_yy of a state in a layer of the body \[Pa\].
    pub(super) fn stress(&self, body: &Body, state: usize, layer: usize) -> [f64; 2] {
        let sigma_B = self.sigma_B.get(state).copied().unwrap_or(0.0);
        body.bulk_stress(sigma_B, self.plane_strain, layer)
    }
}
