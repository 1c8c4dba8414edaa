//! Stage 2: RESPONSE of a body to tractions on its surface.
//!
//! [`Stack`] knows the frequency response of any number of bonded layers; [`influence_coefficients`]
//! turns it into the displacements that unit traction on one cell causes.

mod bessel;
mod cell;
mod coefficients;
mod depth_frf;
pub(crate) mod gauss;
mod half_space;
mod half_space_stress;
mod layered_frf;
mod matrix;
mod radial_table;
mod stress;
mod surface;

pub use coefficients::{InfluenceCoefficients, Quadrant};
pub use depth_frf::FrequencyResponse;
pub use half_space_stress::StressResponse;
pub use layered_frf::{RadialResponse, Stack};
pub use rustfft::num_complex::Complex64;
pub use stress::{StressCoefficients, stress_at, stress_coefficients};

use crate::error::Error;
use crate::scene::{Body, Grid, KernelSettings};

/// The surface coefficients of a body on a grid.
///
/// A rigid body gives zeros, a homogeneous one the closed form; with `shortcut_equal_layers` also
/// one whose layers all equal its substrate.
pub fn influence_coefficients(
    body: &Body,
    grid: &Grid,
    settings: &KernelSettings,
    shortcut_equal_layers: bool,
) -> Result<InfluenceCoefficients, Error> {
    let mut stack = Stack::new(body);
    if shortcut_equal_layers && body.is_homogeneous() {
        stack.layers.clear();
    }
    let (coefficients, estimate) = surface::surface_coefficients(&stack, grid);
    surface::check(estimate, settings.tolerance)?;
    Ok(coefficients)
}
