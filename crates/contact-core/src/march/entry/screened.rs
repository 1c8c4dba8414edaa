//! Response of cells outside the contact to pressure on each other while the surface in the contact
//! is fixed.

use std::f64::consts::{FRAC_2_PI, PI};

use super::neighbours::Neighbour;
use crate::kernels::Quadrant;
use crate::scene::Grid;

/// Lower bound of d: its value for a cell surrounded by contact.
const NEAREST: f64 = 0.35;
/// Lower bound of S_nn/C_nn, for cells far longer than wide; for square ones S_nn/C_nn is 0.74 at
/// `NEAREST`.
const LEAST: f64 = 0.5;

/// The response u_z of a cell m to pressure on a cell n, both outside, over the response of a cell
/// to its own pressure without a contact:
///
/// ```text
/// S_mn/C_nn = (C_mn/C_nn) (2/pi) arctan(2 (d_m d_n)^(1/2)/r),
/// ```
///
/// r being their distance and d their distances from the edge. The factor of C_mn belongs to the
/// potential of a point charge in the plane of a conducting half-plane (Sommerfeld 1897), exact for
/// kernels ~ 1/r and used for all others. For m = n, S_nn/C_nn = 1 - 1/(pi d P), P = integral of
/// 1/r over the cell. In plane strain the image C((d_m^(1/2) + d_n^(1/2))^2) is subtracted from the
/// kernel C(r). Unit of length: the cell.
pub(super) struct Screened {
    /// 1/(pi P)
    own: f64,
    /// Ratio C(r)/C(0) in plane strain at r = 0, 1, 2, ...
    along: Vec<f64>,
}

impl Screened {
    /// Prepares the screened responses for the kernel C_zz on a grid \[m/Pa\].
    pub(super) fn new(grid: &Grid, kernel: &Quadrant) -> Self {
        let ratio = (grid.dx / grid.dy).sqrt();
        let potential = 2.0 * (ratio * ratio.powi(-2).asinh() + ratio.powi(2).asinh() / ratio);
        let along = kernel.column(0).into_iter().map(|c| c / kernel[(0, 0)]);
        Self {
            own: 1.0 / (PI * potential),
            along: if grid.plane_strain {
                along.collect()
            } else {
                Vec::new()
            },
        }
    }

    /// S_nn/C_nn: how much less a cell yields since the contact beside it is held, `root` being d^(1/2) of the
    /// cell.
    pub(super) fn self_response(&self, root: f64) -> f64 {
        let d = (root * root).max(NEAREST);
        let image = if self.along.is_empty() {
            self.own / d
        } else {
            self.line_response(4.0 * d)
        };
        (1.0 - image).max(LEAST)
    }

    /// S_mn/C_nn of two neighbouring cells beside the held contact, `roots` being their d^(1/2).
    pub(super) fn screened_response(&self, near: &Neighbour, roots: [f64; 2]) -> f64 {
        let [m, n] = roots.map(|root| root.max(NEAREST.sqrt()));
        if self.along.is_empty() {
            near.response * FRAC_2_PI * (2.0 * m * n / near.distance()).atan()
        } else {
            near.response - self.line_response((m + n).powi(2))
        }
    }

    /// C(r)/C(0) in plane strain, r >= 1; linear in the logarithm of r.
    fn line_response(&self, r: f64) -> f64 {
        let last = self.along.len() - 1;
        let k = (r as usize).clamp(1, last.max(1));
        let at = |k: usize| self.along[k.min(last)];
        let part = (r / k as f64).ln() / (1.0 / k as f64).ln_1p();
        at(k) + part.clamp(0.0, 1.0) * (at(k + 1) - at(k))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use ndarray::{Array2, Axis};

    use super::Screened;
    use crate::kernels::{Quadrant, influence_coefficients};
    use crate::linear_system::solve;
    use crate::march::entry::neighbours::Neighbours;
    use crate::march::entry::view::{REACH, View};
    use crate::plan::Mirror;
    use crate::scene::{Body, Elastic, Grid, KernelSettings, Shape};

    /// C_zz of a half-space \[m/Pa\].
    pub(in crate::march::entry) fn half_space(grid: &Grid) -> Quadrant {
        let body = Body::homogeneous(Elastic::new(1.0, 0.3).unwrap(), Shape::Flat);
        let settings = KernelSettings::default();
        influence_coefficients(&body, grid, &settings, true, None)
            .unwrap()
            .zz
    }

    /// The response of all cells to all \[m/Pa\].
    pub(in crate::march::entry) fn of_all(grid: &Grid, kernel: &Quadrant) -> Array2<f64> {
        let cells = grid.nx * grid.ny;
        Array2::from_shape_fn((cells, cells), |(n, m)| {
            let [n, m] = [n, m].map(|n| (n / grid.ny, n % grid.ny));
            kernel[(n.0.abs_diff(m.0), n.1.abs_diff(m.1))]
        })
    }

    /// The first cells are held: then the Schur complement of the others, up to two
    /// away.
    fn off_from_elimination(grid: &Grid, held: usize) -> f64 {
        let kernel = half_space(grid);
        let response_matrix = of_all(grid, &kernel);
        let cells = Neighbours::new(grid, Mirror::None, REACH, &kernel);
        let screened = Screened::new(grid, &kernel);
        let (of_held, rest) = response_matrix.view().split_at(Axis(0), held);
        let (inside, to_others) = of_held.split_at(Axis(1), held);
        let (_, others) = rest.split_at(Axis(1), held);
        let forces = solve(&inside.to_owned(), &to_others.to_owned());
        let remaining = &others - &to_others.t().dot(&forces);
        let root = |n: usize| View::from_cell(n, &cells, |m| m < held).map(|view| view.root());
        let mut worst: f64 = 0.0;
        for n in held..response_matrix.nrows() {
            // At the ends of the rows the edge ends.
            let inside = grid.ny == 1 || (8..grid.ny - 8).contains(&(n % grid.ny));
            let Some(at) = root(n).filter(|_| inside) else {
                continue;
            };
            for near in cells
                .neighbours_within(n, 2)
                .filter(|near| near.cell >= held)
            {
                let Some(to) = root(near.cell) else { continue };
                let response = if near.cell == n {
                    screened.self_response(at)
                } else {
                    screened.screened_response(&near, [to, at])
                };
                let exact = remaining[(near.cell - held, n - held)];
                worst = worst.max(
                    (response_matrix[(0, 0)] * response - exact).abs()
                        / remaining[(n - held, n - held)],
                );
            }
        }
        worst
    }

    #[test]
    fn strips_beside_a_contact_respond_as_elimination_says() {
        let off = off_from_elimination(&Grid::strip(1.0, 46, 1.0).unwrap(), 40);
        assert!(off < 0.08, "off by {off:e}");
    }

    /// The edge has a step where the last held column ends. Cells make less of a continuum's edge
    /// than strips.
    #[test]
    fn cells_beside_a_contact_respond_as_elimination_says() {
        let off = off_from_elimination(&Grid::centred(1.0, 22).unwrap(), 18 * 22 + 11);
        assert!(off < 0.1, "off by {off:e}");
    }
}
