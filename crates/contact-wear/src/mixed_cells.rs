//! Errors by cells that are in part aerated, or at the border of a bare layer.
//!
//! A cell has one pressure and one coefficient. In a cell of the aerated share s it is
//! `k = k_s + (k_a - k_s) s`. Where worn surfaces fit each other the pressure goes as 1/k, with r = k_a/k_s the
//! starved part of the cell bears r times as much as the aerated part. The cell bears
//!
//! ```text
//! p [s + (1 - s) r] [s + (1 - s)/r] = p [1 + s (1 - s) (r - 1)^2/r]
//! ```
//!
//! instead of p, so that the surfaces recede more slowly:
//!
//! ```text
//! dw/w = sum_cells p s (1 - s) (r - 1)^2/r / sum_cells p.
//! ```
//!
//! A cell belongs to one layer, and to the contact, as a whole: their borders are known to half a cell. Half of a
//! cell more changes the mean coefficient of friction mu_m by
//!
//! ```text
//! dmu = 1/2 p_c (mu_c - mu_m) / sum_cells p
//! ```
//!
//! on both sides of a border. Cells that mirror each other err alike, at most four of them:
//! `mu_error = 2 sqrt(sum dmu^2)/mu_m`.

use super::law::{BodyWear, Law};

/// Cells that may err alike.
const ALIKE: f64 = 4.0;

/// Error of the depth that wears off under a pressure, over it, by cells that are in part `aerated`.
pub(crate) fn depth_error(bodies: &[BodyWear; 2], p: &[f64], aerated: &[f64]) -> f64 {
    let laws = bodies.iter().flat_map(|body| &body.laws);
    let excess = laws.map(|law| excess(&**law)).fold(0.0, f64::max);
    let total: f64 = p.iter().sum();
    if aerated.is_empty() || excess == 0.0 || total <= 0.0 {
        return 0.0;
    }
    let cells = p.iter().zip(aerated);
    let mixed: f64 = cells
        .map(|(p, s)| p * (s * (1.0 - s) * excess).min(1.0))
        .sum();
    (mixed / total).min(1.0)
}

/// (r - 1)^2/r of a law, r being the ratio of its coefficients in air and without oxygen.
fn excess(law: &dyn Law) -> f64 {
    if !law.depends_on_air() {
        return 0.0;
    }
    let starved = law.starved_part(0.5);
    let r = (1.0 - starved) / starved.max(f64::MIN_POSITIVE);
    if r > 0.0 {
        (r - 1.0).powi(2) / r
    } else {
        f64::MAX
    }
}

/// The contact as its friction meets it: cells of `rows` along y.
pub(crate) struct FrictionOfCells<'a> {
    pub(crate) rows: usize,
    /// Integral of the pressure over the slip in a cycle \[Pa m\].
    pub(crate) ways: &'a [f64],
    pub(crate) mu: &'a [f64],
    /// Bare layer.
    pub(crate) layer: &'a [usize],
}

impl FrictionOfCells<'_> {
    /// Error of the mean coefficient of friction, over it, by the borders of layers and contact; zero
    /// where a single layer is bare.
    pub(crate) fn error(&self) -> f64 {
        let total: f64 = self.ways.iter().sum();
        let pressed = |c: usize| self.ways[c] > 0.0;
        let mut layers = (0..self.ways.len())
            .filter(|c| pressed(*c))
            .map(|c| self.layer[c]);
        let Some(first) = layers.next() else {
            return 0.0;
        };
        if layers.all(|layer| layer == first) {
            return 0.0;
        }
        let mean = self
            .ways
            .iter()
            .zip(self.mu)
            .map(|(w, mu)| w * mu)
            .sum::<f64>()
            / total;
        let rows = self.rows;
        let neighbours = |c: usize| {
            let inside = [
                c >= rows,
                c + rows < self.ways.len(),
                !c.is_multiple_of(rows),
                !(c + 1).is_multiple_of(rows),
            ];
            let cells = [c.wrapping_sub(rows), c + rows, c.wrapping_sub(1), c + 1];
            let pairs = inside.into_iter().zip(cells);
            pairs.filter(|(inside, _)| *inside).map(|(_, cell)| cell)
        };
        let differs = |c: usize, next: usize| !pressed(next) || self.layer[next] != self.layer[c];
        let border = (0..self.ways.len())
            .filter(|&c| pressed(c) && neighbours(c).any(|next| differs(c, next)));
        let squares = border.map(|c| (0.5 * self.ways[c] * (self.mu[c] - mean) / total).powi(2));
        (ALIKE * squares.sum::<f64>()).sqrt() / mean
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{FrictionOfCells, depth_error};
    use crate::{Aerated, BodyWear, DissipatedEnergy};

    #[test]
    fn a_cell_that_is_half_aerated_bears_too_little() {
        let law = |alpha: f64| DissipatedEnergy {
            alpha,
            threshold: 0.0,
        };
        let body = BodyWear::with_law(Aerated {
            law: Arc::new(law(4e-14)),
            starved_law: Arc::new(law(1e-14)),
            coefficients: [4e-14, 1e-14],
        });
        // A strip that has worn to fit: p goes as 1/k, k being 4, 2.5 and 1.
        let k = [4.0, 4.0, 2.5, 1.0, 1.0];
        let p = k.map(|k| 1.0 / k);
        let aerated = [1.0, 1.0, 0.5, 0.0, 0.0];
        let exact: f64 = 2.5 / 4.0 + 2.5;
        let error = depth_error(&[body, BodyWear::default()], &p, &aerated);
        let cells: f64 = p.iter().sum();
        assert!((error - (exact - cells) / cells).abs() < 1e-12);
        let plain = BodyWear::with_law(law(1e-14));
        assert_eq!(
            depth_error(&[plain, BodyWear::default()], &p, &aerated),
            0.0
        );
    }

    #[test]
    fn friction_errs_at_borders_of_layers() {
        let (ways, mu) = (
            [0.0, 4.0, 1.0, 1.0, 4.0, 0.0],
            [0.1, 0.1, 0.5, 0.5, 0.1, 0.1],
        );
        let cells = |layer: &[usize]| {
            FrictionOfCells {
                rows: 1,
                ways: &ways,
                mu: &mu,
                layer,
            }
            .error()
        };
        let mean = 1.8 / 10.0;
        let squares: f64 =
            2.0 * (0.5 * 4.0 * 0.08 / 10.0_f64).powi(2) + 2.0 * (0.5 * 0.32 / 10.0_f64).powi(2);
        let exact = 2.0 * squares.sqrt() / mean;
        assert!((cells(&[0, 0, 1, 1, 0, 0]) - exact).abs() < 1e-12);
        assert_eq!(cells(&[0; 6]), 0.0);
    }
}
