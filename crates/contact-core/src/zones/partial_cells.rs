//! Laws by which tractions vanish at the border of a zone, and the pressure continued to the rim of a contact.

use ndarray::Array2;

use super::level::Power;
use super::level::Told;
use crate::cells::Lattice;
use crate::plan::Mirror;
use crate::scene::Grid;

/// The laws of a stick zone's border, by the power of mu p - q . t that vanishes linearly.
pub(crate) const STICK: [Power; 2] = [Power::Two, Power::TwoThirds];
/// Of these that of a zone that shrinks; the other is that of one that grows.
pub(crate) const SHRINKS: usize = 0;

/// The pressure at the centres of the cells \[Pa\], shape (nx, ny), with that at the rim of the contact
/// continued from inside.
///
/// Cells at the rim carry what balances the others, a tenth more or less than the pressure at their
/// centres; without them the error of p falls from first to second order. The sum over the cells is
/// that of the load only to first order: balances need the pressure as it was solved for.
pub fn continued_pressure(p: &Array2<f64>, grid: &Grid) -> Array2<f64> {
    let lattice = Lattice::new(grid, Mirror::None);
    let contact: Vec<bool> = p.iter().map(|&p| p > 0.0).collect();
    let mut continued: Vec<f64> = p.iter().copied().collect();
    let rim = lattice.edges(&contact, [Told::ROOT], |_| {
        ([Power::Two], |n: usize| continued[n])
    });
    for (n, edge) in rim {
        if let Some(level) = edge.level {
            continued[n] = level.middle.max(0.0).sqrt();
        }
    }
    let kept = |i: usize, j: usize| continued[i * grid.ny + j];
    Array2::from_shape_fn((grid.nx, grid.ny), |(i, j)| kept(i, j))
}
