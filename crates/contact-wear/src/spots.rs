//! The spots of a contact along the stroke: their size, and the error of the worn depth by their cells.
//!
//! In gross slip the volume is exact on any grid, V = k W s N. The depth is not: the pressure of a spot, and so
//! the profile that it wears, is known on the cells alone. While the deepest depth w grows by dw on spots of c
//! cells in their half-width, the cells leave the error
//!
//! ```text
//! CELLS dw/c^2,   c = sum p/(2 p_max)
//! ```
//!
//! of second order as the pressure itself, the sum being over the cells across a spot: c is its half-width under a
//! constant pressure and pi/4 of it under Hertz's. Wear widens the spots: what is worn later errs less. The constant
//! covers a scan of cylinders of 1 to 4 cells against 16, up to 1.5 times: strokes of 0.5 and 5 half-widths, depths of
//! 0.2 and 2 times the approach, either body.

/// Part of the load that is borne by spots at most as wide as the one that is taken.
const BORNE: f64 = 0.25;
/// Error of the deepest depth times the square of the cells in the half-width of a spot.
const CELLS: f64 = 0.15;

/// A spot along x in a row of cells.
#[derive(Clone, Copy, Default)]
struct Spot {
    cells: usize,
    load: f64,
    peak: f64,
}

/// The spots of a pressure with `rows` cells along y.
fn spots(p: &[f64], rows: usize) -> Vec<Spot> {
    let columns = p.len() / rows;
    let mut spots = Vec::new();
    for row in 0..rows {
        let mut spot = Spot::default();
        for i in 0..=columns {
            let p = p.get(i * rows + row).copied().unwrap_or(0.0);
            if i < columns && p > 0.0 {
                spot.cells += 1;
                spot.load += p;
                spot.peak = spot.peak.max(p);
            } else if spot.cells > 0 {
                spots.push(std::mem::take(&mut spot));
            }
        }
    }
    spots
}

/// The width for which spots at most as wide bear a quarter of the load; `least` without a spot.
fn quarter_width(mut spots: Vec<Spot>, width: impl Fn(&Spot) -> f64, least: f64) -> f64 {
    spots.sort_unstable_by(|a, b| width(a).total_cmp(&width(b)));
    let total: f64 = spots.iter().map(|spot| spot.load).sum();
    let mut borne = 0.0;
    let spot = spots.iter().find(|spot| {
        borne += spot.load;
        borne >= BORNE * total
    });
    spot.map_or(least, width)
}

/// Half-width along x of the spots of a pressure \[cells\], by the cells in contact.
pub(crate) fn half_width_in_cells(p: &[f64], rows: usize) -> f64 {
    quarter_width(spots(p, rows), |spot| 0.5 * spot.cells as f64, 0.5)
}

/// Error of the deepest depth by the cells \[m\], while it grows by `grown` \[m\] under the pressure p.
pub(crate) fn depth_error(grown: f64, p: &[f64], rows: usize) -> f64 {
    let c = quarter_width(spots(p, rows), |spot| 0.5 * spot.load / spot.peak, 0.5);
    CELLS * grown.max(0.0) / (c * c)
}

#[cfg(test)]
mod tests {
    use super::{depth_error, half_width_in_cells};

    #[test]
    fn the_spots_count_and_not_the_contact() {
        // Three spots of 2, 4 and 4 cells along x, in both rows.
        let row = [0, 1, 1, 0, 0, 2, 3, 3, 2, 0, 2, 3, 3, 2, 0];
        let p: Vec<f64> = row.iter().flat_map(|p| [f64::from(*p); 2]).collect();
        assert_eq!(half_width_in_cells(&p, 2), 2.0);
        assert_eq!(half_width_in_cells(&p[..8], 2), 1.0);
        assert_eq!(half_width_in_cells(&[0.0; 8], 2), 0.5);
        // The quarter of the load ends in a wide spot: 10/(2 * 3) cells.
        let c = 10.0 / 6.0;
        assert!((depth_error(4e-6, &p, 2) - 0.15 * 4e-6 / (c * c)).abs() < 1e-20);
        assert_eq!(depth_error(-1e-6, &p, 2), 0.0);
    }
}
