//! Fields on the cells of a contact: sweeps over them, packing, lever arms, neighbours.
//!
//! A field holds one value per cell that is solved for, in row-major (nx, ny) order; of a
//! mirror-symmetric scene the half y > 0 ([`Mirror`](crate::plan::Mirror)).

mod arms;
mod lattice;
mod packing;
mod sweep;
mod vector;

pub use arms::{Arms, Drive};
pub(crate) use arms::{add, inverse, product};
pub use lattice::Lattice;
pub(crate) use packing::ContactCells;
pub(crate) use sweep::{Fields, largest, set, sums, survey, sweep};
pub use vector::size;
pub(crate) use vector::{CHUNK, add_scaled, both, copy, copy_to, dot, set_cells, sum};
