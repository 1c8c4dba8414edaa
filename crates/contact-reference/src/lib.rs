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

#![forbid(unsafe_code)]

mod cattaneo_mindlin;
mod coated_indentation;
mod coupled_indentation;
pub mod domain;
mod goodman;
mod hamilton;
mod layered_response;
mod lubkin;
mod mindlin_shear;
mod springs;
mod thin_layer;

pub use cattaneo_mindlin::{CattaneoMindlin, tangential_modulus};
pub use coated_indentation::{CoatedIndentation, coated_indentation};
pub use contact_core::hertz::{
    EllipticIntegrals, Hertz, HertzEllipse, LineContact, PlaneStress, elliptic_integrals, hertz,
    hertz_ellipse, line_contact, mcewen_pressure, mcewen_shear,
};
pub use contact_core::scene::dundurs_beta;
pub use coupled_indentation::{CoupledIndentation, coupled_indentation};
pub use goodman::{goodman_rate, goodman_stick_ratio};
pub use hamilton::{HertzStress, Stress};
pub use layered_response::layered_normal_response;
pub use lubkin::Lubkin;
pub use mindlin_shear::mindlin_shear_displacement;
pub use springs::Springs;
pub use thin_layer::{
    ThinLayerContact, confined_modulus, thin_compressible_layer, thin_incompressible_layer,
};
