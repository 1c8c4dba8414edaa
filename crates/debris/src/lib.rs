//! The third body of a fretting contact: the oxygen that reaches it and the debris that it holds.
//!
//! Both obey a diffusion equation in the closed [`Region`] between the bodies:
//!
//! ```text
//! div(D grad P) = r P,                      P = P_air on the border      oxygen ([`diffuse_air`])
//! dh/dN = source + div(K grad h),           h = 0 on the border          debris ([`spread_bed`])
//! ```
//!
//! P is the partial pressure of oxygen, of which D/r = lambda^2 alone enters (P. Arnaud, S. Baydoun,
//! S. Fouvry, Tribol. Int. 161 (2021) 107077), h the volume of debris per area, and K its transport per
//! cycle. The five-point scheme is symmetric and of second order on borders that cut cells.
//! Arrays are plain, one number per cell, `cell = column * rows + row`.

#![forbid(unsafe_code)]

mod air;
mod bed;
mod conjugate_gradients;
mod fitted;
mod matrix;
mod region;
mod share;
mod solve;
mod tridiagonal;

pub use air::{ACCURACY, diffuse_air};
pub use bed::{Bed, MASS_ACCURACY, spread_bed};
pub use conjugate_gradients::NotConverged;
pub use region::{Lattice, Region};
pub use share::aerated_share;
