//! The operators of a scene, as its plan asks for them.

use std::sync::atomic::AtomicBool;

use super::{ApproximateInverse, CirculantInverse, DcFft, FrequencyDomain, SurfaceOperator};
use crate::error::Error;
use crate::kernels::InfluenceCoefficients;
use crate::plan::Plan;
use crate::scene::{Grid, KernelMethod, Scene};

/// u = C * q on a grid with the coefficients `pair` of that; ends when `stop` is raised.
pub(crate) fn surface_operator(
    scene: &Scene,
    plan: &Plan,
    grid: &Grid,
    pair: &InfluenceCoefficients,
    stop: &AtomicBool,
) -> Result<Box<dyn SurfaceOperator>, Error> {
    let single = plan.methods.single_precision;
    Ok(match scene.settings.kernel.method {
        KernelMethod::FrequencyDomain { lambda } => Box::new(FrequencyDomain::until(
            (&scene.body1, &scene.body2),
            grid,
            lambda,
            plan.coupling,
            pair,
            stop,
        )?),
        _ => Box::new(DcFft::until(
            pair,
            plan.mirror,
            plan.coupling,
            single,
            stop,
        )?),
    })
}

/// Its approximate inverse, where the plan has one; ends when `stop` is raised.
pub(crate) fn approximate_inverse(
    plan: &Plan,
    pair: &InfluenceCoefficients,
    stop: &AtomicBool,
) -> Result<Option<Box<dyn ApproximateInverse>>, Error> {
    if !plan.methods.preconditioner {
        return Ok(None);
    }
    let single = plan.methods.single_precision;
    let inverse = CirculantInverse::until(pair, plan.mirror, single, stop)?;
    Ok(Some(Box::new(inverse)))
}
