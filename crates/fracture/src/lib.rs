//! Cracks from a surface: stress intensity over a cycle, closure, growth, arrest.
//!
//! Plain stress histories in, numbers out: nothing here knows of contacts. Plane strain, half-plane
//! z > 0, x along the surface, z the depth; tension is positive, lengths are in m, stresses in Pa,
//! stress intensities in Pa m^0.5.
//!
//! A [`Path`] is the line of a crack, a [`Crack`] is that path with the dislocations that a state
//! of stress puts into it. The stress of the body *without* the crack is asked for at
//! [`Crack::points`]; [`Crack::intensity`] gives K with the faces free to pass through each other,
//! [`Faces`] follows a history with faces that touch, without or with friction. [`grow`] finds the
//! path; [`Curve`] is the cycle's K over the length of a crack, from which [`Curve::arrest`] and
//! [`Curve::life`] follow. [`ellipse_factor`] is an estimate for cracks with a curved front.
//!
//! The crack changes neither the loads nor where they act: K is linear in the stress.
//!
//! ```
//! use fracture::{Crack, Path};
//!
//! let crack = Crack::new(Path::straight(0.0, 1e-4, 0.0))?;
//! let tension = vec![[100e6, 0.0, 0.0]; crack.points().len()];
//! let k = crack.intensity(&tension)?;
//! let F = k.K_I / (100e6 * (std::f64::consts::PI * 1e-4).sqrt());
//! assert!((F - 1.1215).abs() < 1e-4 && k.K_II.abs() < 1e-3 * k.K_I);
//! # Ok::<(), fracture::Error>(())
//! ```

mod arrest;
mod closure;
mod crack;
mod curve;
mod direction;
mod dislocation;
mod ellipse;
mod error;
mod film;
mod friction;
mod grow;
mod influence;
mod jumps;
mod life;
mod lu;
mod path;
mod rule;
mod stress;
mod threshold;

pub use arrest::{Arrest, Verdict};
pub use closure::{Opening, State};
pub use crack::{Crack, Intensity};
pub use curve::{Curve, Extremes};
pub use direction::{Direction, kinked};
pub use ellipse::ellipse_factor;
pub use error::Error;
pub use film::Film;
pub use friction::Faces;
pub use grow::{End, Growing, Grown, Tip, grow};
pub use life::{Growth, Life, Rate};
pub use path::{Leg, Path};
pub use stress::{PlaneStress, Point, Traction};
pub use threshold::{LoadRatio, Threshold};
