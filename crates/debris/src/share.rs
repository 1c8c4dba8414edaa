//! The aerated share of a cell, counted within the cell.

use super::air::ACCURACY;
use super::region::{Region, Side};

/// Slope across half a cell, over the largest, below which a level does not vary in that direction.
const FLAT: f64 = 1e-6;

/// Computes the share of the area of each cell in which P is at least the `threshold`, both over the
/// ambient pressure. ln P is linear between the centres of the cells and to the border, where it is
/// zero. Open cells are aerated.
pub fn aerated_share(region: &Region, P: &[f64], threshold: f64) -> Vec<f64> {
    // P is known to ACCURACY times the threshold, and exactly in a line.
    let least = if region.lattice.rows == 1 {
        f64::MIN_POSITIVE
    } else {
        ACCURACY
    };
    let level = |n: usize| (P[n] / threshold).max(least).ln();
    let border = -threshold.ln();
    let shares = region.cells.iter().zip(&region.sides).map(|(&n, sides)| {
        let centre = level(n);
        let slope = |side: &Side| match *side {
            Side::Closed(k) => 0.5 * (level(region.cells[k]) - centre),
            Side::Border(theta) => 0.5 * (border - centre) / theta,
            Side::Sealed => 0.0,
        };
        let slopes: [f64; 4] = [0, 1, 2, 3].map(|k| slope(&sides[k]));
        let quarters = [(0, 2), (0, 3), (1, 2), (1, 3)];
        let sum: f64 = quarters
            .iter()
            .map(|&(a, b)| positive_part(centre, slopes[a], slopes[b]))
            .sum();
        0.25 * sum
    });
    region.scatter(&shares.collect::<Vec<f64>>(), 1.0)
}

/// The part of the unit square in which `level + a x + b y` is not negative.
fn positive_part(level: f64, a: f64, b: f64) -> f64 {
    let (lowest, highest) = (
        level + a.min(0.0) + b.min(0.0),
        level + a.max(0.0) + b.max(0.0),
    );
    if lowest >= 0.0 {
        return 1.0;
    }
    if highest < 0.0 {
        return 0.0;
    }
    let (steep, shallow) = if a.abs() >= b.abs() { (a, b) } else { (b, a) };
    let ramp = |t: f64| t.max(0.0);
    if shallow.abs() <= FLAT * steep.abs() {
        let level = level + 0.5 * shallow;
        return ((ramp(level + steep) - ramp(level)) / steep).clamp(0.0, 1.0);
    }
    let square = |t: f64| 0.5 * ramp(t) * ramp(t);
    let sum = square(level + a + b) - square(level + a) - square(level + b) + square(level);
    (sum / (a * b)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::positive_part;

    #[test]
    fn the_part_of_a_square_agrees_with_points_in_it() {
        let mut seed = 7_u64;
        let mut number = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
        };
        for _ in 0..50 {
            let (level, a, b) = (number(), 2.0 * number(), 2.0 * number() * number());
            let points = 400;
            let middle = |k: usize| (k as f64 + 0.5) / points as f64;
            let inside = (0..points * points)
                .filter(|k| level + a * middle(k / points) + b * middle(k % points) >= 0.0)
                .count() as f64;
            let exact = inside / (points * points) as f64;
            assert!((positive_part(level, a, b) - exact).abs() < 3e-3);
        }
        assert!((positive_part(0.5, -1.0, 0.0) - 0.5).abs() < 1e-15);
        assert_eq!(positive_part(-0.1, 0.0, 0.0), 0.0);
    }
}
