//! Cells across the zone of a contact that slips.

use crate::scene::Grid;

/// Counts the cells across the slip zone from contact area \[m^2\] and stick ratio: half of the strip of a
/// line contact that does not stick, else the ring between two circles of the areas of contact and stick
/// zone. Without contact there are none.
pub fn slip_cells(grid: &Grid, contact_area: f64, stick_ratio: f64) -> f64 {
    if contact_area <= 0.0 {
        return 0.0;
    }
    let touching = contact_area / grid.cell_area();
    if grid.plane_strain {
        0.5 * touching * (1.0 - stick_ratio)
    } else {
        (touching / std::f64::consts::PI).sqrt() * (1.0 - stick_ratio.max(0.0).sqrt())
    }
}
