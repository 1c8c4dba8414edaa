//! Check that the contact of a stroke stays on the grid, and on the stored worn depth of the body
//! that slides over it.

use contact_core::Error;
use contact_core::scene::Grid;

use super::shift::Shift;

/// Factor by which a grid should grow if the contact cannot be estimated.
const GRID_GROWTH: f64 = 1.4;

/// Fails if a cell with pressure p \[Pa\], or a depth that it wears, lies at the border of the
/// grid, or if its place on a shifted body is off the grid. The fields have `rows` cells per
/// column, the last at the border.
pub(super) fn check(grid: &Grid, rows: usize, p: &[f64], shifts: &[Shift]) -> Result<(), Error> {
    let pressed = || (0..p.len()).filter(|&n| p[n] > 0.0);
    let columns = pressed().fold(None, |range: Option<(usize, usize)>, n| {
        let i = n / rows;
        Some(range.map_or((i, i), |(low, high)| (low.min(i), high.max(i))))
    });
    let Some((low, high)) = columns else {
        return Ok(());
    };
    let is_at_y_border = |n: usize| {
        let j = n % rows;
        j + 1 == rows || (j == 0 && rows == grid.ny)
    };
    let is_off_grid = |shift: &Shift| {
        let [first, last] = shift.ends();
        low as f64 + first < 0.0 || high as f64 + last > (grid.nx - 1) as f64
    };
    let off_x = low == 0 || high + 1 == grid.nx || shifts.iter().any(is_off_grid);
    let off_y = !grid.plane_strain && pressed().any(is_at_y_border);
    if !off_x && !off_y {
        return Ok(());
    }
    let (extent_x, extent_y) = grid.extent();
    let touched = if off_x { extent_x } else { extent_y };
    Err(Error::OffGrid {
        increment: 0,
        W: p.iter().sum::<f64>() * grid.cell_area(),
        unit: grid.unit_of("N"),
        extent_x,
        extent_y,
        needed: GRID_GROWTH * touched,
    })
}
