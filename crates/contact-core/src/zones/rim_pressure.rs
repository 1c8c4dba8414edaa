//! The pressure at the centres of the cells that the rim of a contact goes through.

use ndarray::Array2;

use super::laws::Power;
use super::level::Stencil;
use crate::cells::Lattice;
use crate::plan::Mirror;
use crate::scene::Grid;

/// The pressure at the centres of the cells \[Pa\], shape (nx, ny), with the pressure at the rim of the
/// contact extrapolated from inside.
///
/// The solved pressure of cells at the rim differs by about a tenth from the pressure at their
/// centres, since it balances the load; with the extrapolated values the error of p is of second
/// instead of first order. Their sum equals the load only to first order: balances need the solved
/// pressure.
pub fn continue_pressure_to_rim(p: &Array2<f64>, grid: &Grid) -> Array2<f64> {
    let lattice = Lattice::new(grid, Mirror::None);
    let contact: Vec<bool> = p.iter().map(|&p| p > 0.0).collect();
    let mut continued: Vec<f64> = p.iter().copied().collect();
    let rim = lattice.edges(&contact, [Stencil::ROOT], |_| {
        ([Power::Two], |n: usize| continued[n])
    });
    for (n, edge) in rim {
        if let Some(level) = edge.level {
            continued[n] = level.middle.max(0.0).sqrt();
        }
    }
    Array2::from_shape_fn((grid.nx, grid.ny), |(i, j)| continued[i * grid.ny + j])
}
