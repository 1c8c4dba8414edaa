//! CONTACT TEMPERATURE: the surface temperature under the frictional heat of a cycle.
//!
//! Both bodies are half-spaces, each homogeneous or coated, with insulated surfaces outside the
//! contact. The heat of a cycle that repeats itself f times a second is a Fourier series in time;
//! each harmonic of angular frequency w = 2 pi n f is answered by the temperature
//!
//! ```text
//! K laplace(T) = i w C T,   -K dT/dz = q at z = 0,   T -> 0 far away
//! ```
//!
//! (H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed., Oxford 1959, chapters II
//! and X), so that the periodic state is exact: its mean is harmonic 0, and of slow or fast cycles
//! the quasi-steady or the one-dimensional state comes out by itself. The bodies share the heat so
//! that their surfaces agree in temperature wherever they touch.
//!
//! The sources rest on both bodies: slip is taken as small against the contact, as it is in
//! fretting.

#![forbid(unsafe_code)]

mod beyond;
mod coefficients;
mod conduction;
mod conductor;
mod cycle;
mod partition;
mod response;
mod temperature;

pub use conduction::Conduction;
pub use conductor::{Conductor, Layers};
pub use cycle::Cycle;
pub use partition::{Partition, partition};
pub use response::surface_response;
pub use temperature::{MOST_HARMONICS, Temperature, temperature};
