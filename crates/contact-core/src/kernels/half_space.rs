//! Closed-form coefficients of a homogeneous half-space (Boussinesq, Cerruti over a rectangle).

use std::f64::consts::PI;

use super::{InfluenceCoefficients, Quadrant};
use crate::error::Error;
use crate::scene::{Body, Grid, KernelSettings};

/// Coefficients of a body on a grid.
pub fn influence_coefficients(
    body: &Body,
    grid: &Grid,
    _settings: &KernelSettings,
    shortcut_equal_layers: bool,
) -> Result<InfluenceCoefficients, Error> {
    if !(body.coatings.is_empty() || shortcut_equal_layers && body.is_homogeneous()) {
        return Err(Error::invalid(
            "coatings",
            body.coatings.len(),
            "none: homogeneous bodies only",
        ));
    }
    let (G, nu) = (body.substrate.G(), body.substrate.nu);
    let (a, b) = (grid.dx / 2.0, grid.dy / 2.0);
    let over_cell = |f: &dyn Fn(f64, f64) -> f64| {
        Quadrant::from_shape_fn((grid.nx, grid.ny), |(i, j)| {
            let (x, y) = (i as f64 * grid.dx, j as f64 * grid.dy);
            f(x + a, y + b) - f(x - a, y + b) - f(x + a, y - b) + f(x - a, y - b)
        })
    };
    let log_atan = |x: f64, y: f64| y * x.hypot(y).ln() + x * (y / x).atan();
    let x_sinh = |x: f64, y: f64| x * (y / x.abs()).asinh();
    let i_1 = over_cell(&|x, y| x_sinh(x, y) + x_sinh(y, x));
    let i_xx = over_cell(&|x, y| x_sinh(y, x));
    let i_yy = over_cell(&|x, y| x_sinh(x, y));
    let i_xy = over_cell(&|x, y| -x.hypot(y));
    let i_x = over_cell(&|x, y| log_atan(x, y));
    let i_y = over_cell(&|x, y| log_atan(y, x));
    let c = if body.substrate.is_rigid() {
        0.0
    } else {
        1.0 / (2.0 * PI * G)
    };
    let coupling = -c * (1.0 - 2.0 * nu) / 2.0;
    Ok(InfluenceCoefficients {
        xx: (&i_1 * (1.0 - nu) + i_xx * nu) * c,
        yy: (&i_1 * (1.0 - nu) + i_yy * nu) * c,
        zz: i_1 * ((1.0 - nu) * c),
        xy: i_xy * (nu * c),
        xz: i_x * coupling,
        yz: i_y * coupling,
    })
}
