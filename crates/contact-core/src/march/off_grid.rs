//! Contacts that reach the border of the grid.

use super::expected_radius::expected_radius;
use super::setup::Setup;
use crate::error::Error;
use crate::solvers::Interface;

/// Length of a sufficient grid over the length of the expected contact.
const CLEARANCE: f64 = 1.4;
/// Factor by which a grid is to grow where the contact cannot be estimated.
const GRID_GROWTH: f64 = 1.4;

/// Fails if a cell at the border of the grid is in contact; the border of a window is kept free.
pub(super) fn check(setup: &Setup<'_>, now: &Interface) -> Result<(), Error> {
    let (whole, grid) = (&setup.problem.scene.grid, &setup.geometry.grid);
    let (at_x, at_y) = (
        grid.nx == whole.nx,
        grid.ny == whole.ny && !grid.plane_strain,
    );
    let rows = setup.problem.plan.mirror.rows(grid.ny);
    let extent = whole.extent();
    let touched = (0..now.p.len()).filter(|&n| now.p[n] > 0.0).map(|n| {
        let (i, j) = (n / rows, n % rows);
        let end_x = at_x && (i == 0 || i + 1 == grid.nx);
        let end_y = at_y && (j + 1 == rows || (j == 0 && rows == grid.ny));
        let length = |touches: bool, extent: f64| if touches { extent } else { 0.0 };
        length(end_x, extent.0).max(length(end_y, extent.1))
    });
    let touched = touched.fold(0.0, f64::max);
    if touched == 0.0 {
        return Ok(());
    }
    let expected = CLEARANCE * 2.0 * expected_radius(&setup.problem.scene);
    let W = now.p.iter().sum::<f64>() * setup.problem.cell_area();
    Err(Error::OffGrid {
        increment: setup.state.increments + 1,
        W,
        unit: setup.problem.scene.grid.unit_of("N"),
        extent_x: extent.0,
        extent_y: extent.1,
        needed: expected.max(GRID_GROWTH * touched),
    })
}
