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
pub(crate) use arms::{add_vectors, inverse, product};
pub use lattice::Lattice;
pub(crate) use packing::ContactCells;
pub(crate) use sweep::{Fields, largest, set_fields, sums, sums_and_maxima, sweep};
pub use vector::length;
pub(crate) use vector::{CHUNK, add_scaled, copy, copy_to, dot, run_both, set_cells, sum};
