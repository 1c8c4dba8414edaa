//! Construction of operators: for a scene and its plan, for a pair of bodies, for
//! pressure alone.

use std::sync::atomic::AtomicBool;

use super::{ApproximateInverse, CirculantInverse, DcFft, FrequencyDomain, SurfaceOperator};
use crate::error::Error;
use ndarray::Array2;

use crate::kernels::{InfluenceCoefficients, influence_coefficients};
use crate::plan::{Mirror, Plan};
use crate::scene::{Body, Grid, KernelMethod, Scene, Settings};

/// Builds u = C * q on a grid with the coefficients `pair`; fails when `stop` is raised.
pub(crate) fn surface_operator(
    scene: &Scene,
    plan: &Plan,
    grid: &Grid,
    pair: &InfluenceCoefficients,
    stop: &AtomicBool,
) -> Result<Box<dyn SurfaceOperator>, Error> {
    let single = plan.methods.single_precision;
    Ok(match scene.settings.kernel.method {
        KernelMethod::FrequencyDomain { lambda } => Box::new(FrequencyDomain::new_unless_stopped(
            (&scene.body1, &scene.body2),
            grid,
            lambda,
            plan.coupling,
            pair,
            stop,
        )?),
        _ => Box::new(DcFft::new_unless_stopped(
            pair,
            plan.mirror,
            plan.coupling,
            single,
            stop,
        )?),
    })
}

/// Builds the approximate inverse, where the plan has one; fails when `stop` is raised.
pub(crate) fn approximate_inverse(
    plan: &Plan,
    pair: &InfluenceCoefficients,
    stop: &AtomicBool,
) -> Result<Option<Box<dyn ApproximateInverse>>, Error> {
    if !plan.methods.preconditioner {
        return Ok(None);
    }
    let single = plan.methods.single_precision;
    let inverse = CirculantInverse::new_unless_stopped(pair, plan.mirror, single, stop)?;
    Ok(Some(Box::new(inverse)))
}

/// Builds u = C * q of a pair of bodies, all components in double precision; fails when `stop` is raised.
pub fn operator_of_bodies(
    (body1, body2): (&Body, &Body),
    grid: &Grid,
    settings: &Settings,
    stop: &AtomicBool,
) -> Result<Box<dyn SurfaceOperator>, Error> {
    let coefficients_of = |body| {
        let shortcut = settings.skip.equal_layers;
        influence_coefficients(body, grid, &settings.kernel, shortcut, Some(stop))
    };
    let pair = coefficients_of(body2)?.pair(&coefficients_of(body1)?);
    Ok(Box::new(DcFft::new_unless_stopped(
        &pair,
        Mirror::None,
        true,
        false,
        stop,
    )?))
}

/// Builds u_z = C_zz * p on the kept cells, in double precision; fails when `stop` is raised.
pub fn normal_operator(
    pair: &InfluenceCoefficients,
    mirror: Mirror,
    stop: &AtomicBool,
) -> Result<Box<dyn SurfaceOperator>, Error> {
    Ok(Box::new(DcFft::new_unless_stopped(
        pair, mirror, false, false, stop,
    )?))
}

/// Builds the convolution of a scalar field with even coefficients `c`, in place of p and u_z.
pub fn scalar_operator(c: Array2<f64>) -> Box<dyn SurfaceOperator> {
    let coefficients = InfluenceCoefficients {
        zz: c,
        ..InfluenceCoefficients::default()
    };
    Box::new(DcFft::new(&coefficients, Mirror::None, false))
}
