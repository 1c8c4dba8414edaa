//! The intermediate loop (figure 2 of the paper): pressure and shear in turn.

mod alternation;
mod mixing;

pub(crate) use alternation::friction_bound;
pub use alternation::{
    CoupledInfo, CoupledParams, CoupledWorkspace, IncrementProblem, SlipDatum, coupled,
};
