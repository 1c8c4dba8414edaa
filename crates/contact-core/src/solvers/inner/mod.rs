//! The inner loops (figure 3 of the paper): pressure for known shear, shear for known pressure.

mod admissible;
mod contact_shear;
mod limit;
mod newton_system;
mod normal;
mod projected_gradient;
mod shear;
mod shear_gradient;
mod tangent;
mod tangential;

pub(super) use admissible::make_admissible;
pub(super) use limit::{Sliding, compute_sliding, exceeds, is_full};
pub use normal::{NormalInfo, NormalParams, NormalProblem, NormalWorkspace, solve_normal};
pub(crate) use normal::{assess_gap, scale_pressure};
pub(super) use shear::first_shift;
pub use shear::{TangentialInfo, TangentialParams, TangentialProblem};
pub(super) use shear_gradient::shear_gradient;
pub use tangential::{TangentialWorkspace, newton_step, solve_tangential};
