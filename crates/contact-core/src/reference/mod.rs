//! Closed forms: the truths the numerical solution is measured against.
//!
//! They do not use the solvers. Each names its source; "derived" means derived here. Each is
//! checked against something independent of it (a quadrature of point-load solutions, a limit, an
//! energy balance) in its own tests or in `tests/reference.rs`.
//!
//! | contact | truth |
//! |---|---|
//! | pressed | [`hertz`], [`hertz_ellipse`], [`line_contact`] |
//! | pressed, then sheared or twisted | [`CattaneoMindlin`], [`Springs`], [`Lubkin`] |
//! | pressed with friction, dissimilar bodies | [`goodman_stick_ratio`], [`coupled_indentation`] |
//! | coated | [`coated_indentation`], [`layered_normal_response`], thin layers |
//! | below the surface | [`HertzStress`] (Hamilton), [`mcewen_pressure`], [`mcewen_shear`] |

mod cattaneo_mindlin;
mod coated_indentation;
mod coupled_indentation;
pub mod domain;
mod elliptic;
mod goodman;
mod hamilton;
mod hertz;
mod hertz_ellipse;
mod layered_response;
mod line_contact;
pub(crate) mod linear_system;
mod lubkin;
mod mindlin_shear;
mod quadrature;
mod springs;
mod thin_layer;

pub use crate::material::dundurs_beta;
pub use cattaneo_mindlin::{CattaneoMindlin, tangential_modulus};
pub use coated_indentation::{CoatedIndentation, coated_indentation};
pub use coupled_indentation::{CoupledIndentation, coupled_indentation};
pub use elliptic::{EllipticIntegrals, elliptic_integrals};
pub use goodman::{goodman_rate, goodman_stick_ratio};
pub use hamilton::{HertzStress, Stress};
pub(crate) use hertz::contact_modulus;
pub use hertz::{Hertz, hertz};
pub use hertz_ellipse::{HertzEllipse, hertz_ellipse};
pub use layered_response::layered_normal_response;
pub use line_contact::{LineContact, PlaneStress, line_contact, mcewen_pressure, mcewen_shear};
pub use lubkin::Lubkin;
pub use mindlin_shear::mindlin_shear_displacement;
pub use springs::Springs;
pub use thin_layer::{
    ThinLayerContact, confined_modulus, thin_compressible_layer, thin_incompressible_layer,
};
