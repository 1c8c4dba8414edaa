//! Where operators are made: those of a scene as its plan asks for them, of a pair of bodies, of
//! pressure alone.

use std::sync::atomic::AtomicBool;

use super::{ApproximateInverse, CirculantInverse, DcFft, FrequencyDomain, SurfaceOperator};
use crate::error::Error;
use ndarray::Array2;

use crate::kernels::{InfluenceCoefficients, influence_coefficients};
use crate::plan::{Mirror, Plan};
use crate::scene::{Body, Grid, KernelMethod, Scene, Settings};

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

/// u = C * q of a pair of bodies, all components in double precision; ends when `stop` is raised.
pub fn of_bodies(
    (body1, body2): (&Body, &Body),
    grid: &Grid,
    settings: &Settings,
    stop: &AtomicBool,
) -> Result<Box<dyn SurfaceOperator>, Error> {
    let of = |body| {
        let shortcut = settings.skip.equal_layers;
        influence_coefficients(body, grid, &settings.kernel, shortcut, Some(stop))
    };
    let pair = of(body2)?.pair(&of(body1)?);
    Ok(Box::new(DcFft::until(
        &pair,
        Mirror::None,
        true,
        false,
        stop,
    )?))
}

/// u_z = C_zz * p on the kept cells, in double precision; ends when `stop` is raised.
pub fn normal_operator(
    pair: &InfluenceCoefficients,
    mirror: Mirror,
    stop: &AtomicBool,
) -> Result<Box<dyn SurfaceOperator>, Error> {
    Ok(Box::new(DcFft::until(pair, mirror, false, false, stop)?))
}

/// The convolution of one scalar field with even coefficients `c`, as that of p to u_z.
pub fn scalar_operator(c: Array2<f64>) -> Box<dyn SurfaceOperator> {
    let one = InfluenceCoefficients {
        zz: c,
        ..InfluenceCoefficients::default()
    };
    Box::new(DcFft::new(&one, Mirror::None, false))
}
