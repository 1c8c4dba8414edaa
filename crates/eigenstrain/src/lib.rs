//! A layered half-space with eigenstrains: what stress and what displacement of the surface they and
//! the tractions on it cause.
//!
//! ```text
//! sigma = C : (eps(u) - e),   div sigma = 0,   sigma_iz = -t_i at z = 0,   u -> 0 below
//! ```
//!
//! with z into the body, tension positive, layers bonded, and t the traction on the surface (a
//! pressure is t_z > 0). Fields are trigonometric polynomials in x and y on the cells, and in z
//! quadratic elements with two Gauss points, where eigenstrain and stress stand ([`Mesh`]). For each
//! wave number the equations are a block tridiagonal system in z ([`column`](crate)); sums over the
//! wave numbers are free of periodic images ([`waves`](crate)). Both directions use the same
//! matrices, so that t . u\[e\] = sigma\[t\] : e to rounding (reciprocity).
//!
//! Components are xx, yy, zz, xy, xz, yz, tensor components of the strain (e_xy, not 2 e_xy).

#![forbid(unsafe_code)]

mod column;
mod error;
mod factors;
mod mesh;
mod operator;
mod sweep;
mod transform;
mod waves;

pub use column::surface_compliance;
pub use error::Error;
pub use mesh::{Cells, Layer, Mesh, PLANES_PER_ELEMENT};
pub use operator::{Answer, Operator, Sources};

/// Components of a symmetric tensor.
pub const COMPONENTS: usize = 6;
