//! Stage 2: RESPONSE of a body to tractions on its surface.
//!
//! [`Stack`] has the frequency response of any number of bonded layers.
//! [`influence_coefficients`] turns it into the displacements that unit traction on one cell
//! causes, by the method of the [`KernelSettings`]; [`stress_coefficients`] does so for the stress
//! at any depth.

mod bessel;
mod cache;
mod cell;
mod coefficients;
mod convert;
mod depth_frf;
mod depth_kernel;
mod depth_tables;
mod displacement;
mod graded;
mod half_space;
mod half_space_displacement;
mod half_space_stress;
mod inverse_fft;
mod layered_frf;
mod line;
mod matrix;
mod quantity;
mod radial_table;
mod rows;
mod sampled_frf;
mod stress;
mod surface;

pub use cache::clear_cache;
pub use cell::Cell;
pub(crate) use coefficients::norm;
pub use coefficients::{InfluenceCoefficients, Quadrant};
pub use convert::{Conversion, SurfaceFrf, convert};
pub use depth_frf::FrequencyResponse;
pub use depth_kernel::{DepthKernel, SharedCorners};
pub use depth_tables::depth_tables_made;
pub use displacement::Displacement;
pub use graded::{Graded, Profile};
pub use half_space_stress::StressResponse;
pub use layered_frf::{RadialResponse, Stack};
pub use quantity::Quantity;
pub use radial_table::{Hankel, RadialTable};
pub use rustfft::num_complex::Complex64;
pub(crate) use sampled_frf::SampledFrf;
pub use stress::{
    Stress, StressCoefficients, check_not_rigid, stress_coefficients, stress_of_cell_at,
};

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::error::Error;
use crate::memory::fits;
use crate::plan::KernelSet;
use crate::scene::{Body, Grid, KernelMethod, KernelSettings};

/// Memory of the coefficients of a body per cell while they are computed: nine quadrants, twice
/// \[bytes\].
const NUMBERS: f64 = 18.0 * 8.0;

/// The surface coefficients of a body on a grid, computed once per process (cached).
///
/// A rigid body gives zeros. A homogeneous body needs no conversion whatever the method: its
/// closed form is used; with `shortcut_equal_layers` also for a body whose layers all equal its
/// substrate. [`KernelMethod::FrequencyDomain`] convolves without coefficients; here it gives
/// the coefficients of the default method.
///
/// On a grid in plane strain the cells are strips, infinitely long along y: displacements are relative
/// to the points at the grid's length from the load, since a line load has no absolute ones.
///
/// Fails when `stop` is raised, if there is one: [`Error::Interrupted`] after increment 0.
pub fn influence_coefficients(
    body: &Body,
    grid: &Grid,
    settings: &KernelSettings,
    shortcut_equal_layers: bool,
    stop: Option<&AtomicBool>,
) -> Result<InfluenceCoefficients, Error> {
    let set = KernelSet::All;
    let coefficients =
        coefficients_of_body(body, grid, settings, shortcut_equal_layers, set, stop)?;
    Ok(Arc::unwrap_or_clone(coefficients))
}

/// The coefficients of a pair of bodies, eq. (4) of the paper, for a set; of bodies with the
/// same layers they are computed once.
///
/// Fails when `stop` is raised, if there is one: [`Error::Interrupted`] after increment 0.
pub fn pair_coefficients(
    (body1, body2): (&Body, &Body),
    grid: &Grid,
    settings: &KernelSettings,
    shortcut_equal_layers: bool,
    set: KernelSet,
    stop: Option<&AtomicBool>,
) -> Result<InfluenceCoefficients, Error> {
    let coefficients_of =
        |body| coefficients_of_body(body, grid, settings, shortcut_equal_layers, set, stop);
    let coefficients2 = Arc::unwrap_or_clone(coefficients_of(body2)?);
    if body1.layers(shortcut_equal_layers) == body2.layers(shortcut_equal_layers) {
        return Ok(coefficients2.pair_of_equal_bodies());
    }
    Ok(coefficients2.pair(&*coefficients_of(body1)?))
}

/// The coefficients of one body for a `set`, from the cache or computed by the method of the settings. The
/// other arguments are described at [`influence_coefficients`].
fn coefficients_of_body(
    body: &Body,
    grid: &Grid,
    settings: &KernelSettings,
    shortcut_equal_layers: bool,
    set: KernelSet,
    stop: Option<&AtomicBool>,
) -> Result<Arc<InfluenceCoefficients>, Error> {
    body.check_alone()?;
    grid.check_alone()?;
    fits("the influence coefficients", NUMBERS * grid.cells() as f64)?;
    let bare = shortcut_equal_layers && body.is_homogeneous();
    let key = cache::Key::new(body, grid, settings, bare, set);
    if let Some(cached) = cache::get(&key) {
        return Ok(cached);
    }
    let never = AtomicBool::new(false);
    let stop = stop.unwrap_or(&never);
    let mut stack = Stack::new(body);
    if bare {
        stack.layers.clear();
        stack.bonds.clear();
    }
    let coefficients = match settings.method {
        _ if grid.plane_strain => line::line_coefficients(&stack, grid).keep_only(set),
        KernelMethod::InverseFft { lambda, aliases } if !stack.layers.is_empty() => {
            inverse_fft::inverse_fft(&stack, grid, (lambda, aliases), stop)?.keep_only(set)
        }
        _ => {
            let (coefficients, estimate) = surface::surface_coefficients(&stack, grid, set, stop)?;
            surface::check_estimate(estimate, settings.tolerance)?;
            coefficients
        }
    };
    let coefficients = Arc::new(coefficients);
    cache::insert(key, &coefficients);
    Ok(coefficients)
}
