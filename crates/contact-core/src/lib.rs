//! Fretting contact of elastic bodies, homogeneous or coated.
//!
//! The unknowns are the pressure p and the shear tractions q = (q_x, q_y) on the contact plane.
//! With the relative surface displacement u = C * (q_x, q_y, p), the gap h = h_init + u_z - delta_z
//! and the slip increment ds = du - d(delta), each cell obeys
//!
//! ```text
//! p >= 0,  h >= 0,  p h = 0                     contact
//! |q| <= mu p,  ds = 0  where |q| < mu p,       stick
//! q = -mu p ds/|ds|  where ds != 0              slip
//! ```
//!
//! and the sums of the tractions balance the applied forces. Axes, signs and words are fixed in
//! `docs/conventions.md`. The modules stand in the order of the computation:
//!
//! [`scene`] -> [`plan`] -> [`kernels`] -> [`convolution`] -> [`cells`] -> [`zones`] ->
//! [`solvers`] -> [`march`] -> [`estimate`]. What follows from tractions stands in crates on this one:
//! `contact-subsurface` (stress), `contact-assess` (criteria, cracks), `contact-wear`,
//! `contact-heat` (temperature), `contact-store` (files), `contact-reference` (closed forms). The
//! method is from S. Spinu, Tribology in Industry 42 (2020) 131-145,
//! doi:10.24874/ti.2020.42.01.13 ("the paper"); where we left it, the module gives the reason.

#![forbid(unsafe_code)]

pub mod bisection;
pub mod cells;
pub mod convolution;
pub mod digits;
pub mod error;
pub mod estimate;
pub mod hertz;
pub mod kernels;
pub mod linear_system;
pub mod magnitude;
pub mod march;
mod material;
pub mod memory;
pub mod plan;
pub mod scene;
mod shown;
pub mod solvers;
pub mod stop;
pub mod yielding;
pub mod zones;

/// The page on the use as a dependency, whose examples compile and run.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/howto/rust.md")]
struct UseAsADependency;

pub use error::Error;
pub use scene::Scene;
pub use shown::{abridge, shown};
