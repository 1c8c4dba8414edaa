//! The places of a contact where the pressure has peaks: the middles of its asperities.

use contact_core::scene::Grid;

/// Most peaks.
const PEAKS: usize = 8;

/// The centres x, y \[m\] of the cells with the highest local maxima of the pressure, the highest first, at most
/// [`PEAKS`]; none where there is a single one, as between smooth bodies.
pub(super) fn pressure_peaks(grid: &Grid, p: &[f64]) -> Vec<[f64; 2]> {
    let (nx, ny) = (grid.nx, grid.ny);
    let is_peak = |n: usize| {
        let (i, j) = (n / ny, n % ny);
        let columns = i.saturating_sub(1)..(i + 2).min(nx);
        // Of equal neighbours the last one is the peak.
        p[n] > 0.0
            && columns
                .flat_map(|k| (j.saturating_sub(1)..(j + 2).min(ny)).map(move |l| k * ny + l))
                .all(|m| if m > n { p[m] < p[n] } else { p[m] <= p[n] })
    };
    let mut peaks: Vec<usize> = (0..nx * ny).filter(|n| is_peak(*n)).collect();
    if peaks.len() < 2 {
        return Vec::new();
    }
    peaks.sort_by(|a, b| p[*b].total_cmp(&p[*a]));
    peaks.truncate(PEAKS);
    peaks
        .into_iter()
        .map(|n| [grid.x(n / ny), grid.y(n % ny)])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_peak_is_no_asperity_and_plateaus_count_once() {
        let grid = Grid::centred(4.0, 4).unwrap();
        let mut p = vec![0.0; 16];
        p[5] = 2.0;
        p[6] = 2.0;
        assert!(pressure_peaks(&grid, &p).is_empty());
        p[15] = 1.0;
        let peaks = pressure_peaks(&grid, &p);
        assert_eq!(peaks, [[grid.x(1), grid.y(2)], [grid.x(3), grid.y(3)]]);
    }
}
