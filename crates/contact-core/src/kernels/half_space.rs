//! A homogeneous half-space: Boussinesq's and Cerruti's solutions over a rectangle.
//!
//! Under unit traction at a point, with r the distance and c = 1/(2 pi G),
//!
//! ```text
//! u_x(q_x) = c [(1 - nu)/r + nu x^2/r^3]      u_z(p) = c (1 - nu)/r
//! u_x(q_y) = c nu x y/r^3                     u_x(p) = -c (1 - 2 nu)/2 x/r^2
//! ```
//!
//! K. L. Johnson, Contact Mechanics (1985), eq. (3.19), (3.75). Over a rectangle each term is the
//! difference of a function of x and y between the four corners (A. E. H. Love, Phil. Trans. R.
//! Soc. A 228 (1929) 377-420); far away, where that difference would lose digits, a Gauss rule of
//! two or three nodes is exact to rounding.

use std::f64::consts::PI;

use super::cell::Cell;
use super::layered_frf::HalfSpace;
use crate::plan::KernelSet;

/// The six coefficients at one offset, in the order xx, yy, zz, xy, xz, yz.
pub(crate) type Six = [f64; 6];

/// The radial functions of a surface kernel at s = r^2: zz, (xx + yy)/2, the amplitude of
/// x^2 - y^2 in (yy - xx)/2, and the amplitude of x in -xz.
pub(crate) type Radial = [f64; 4];

/// Adds `weight` times the response at (x, y) to unit forces, from its radial functions g: xx, yy, zz, xy, xz,
/// yz.
pub(crate) fn add_kernel(sum: &mut Six, x: f64, y: f64, weight: f64, g: Radial) {
    let [zz, mean, deviation, odd] = g.map(|g| weight * g);
    let difference = (x * x - y * y) * deviation;
    sum[0] += mean - difference;
    sum[1] += mean + difference;
    sum[2] += zz;
    sum[3] -= 2.0 * x * y * deviation;
    sum[4] -= x * odd;
    sum[5] -= y * odd;
}

/// The radial functions of the surface displacement of a half-space under unit forces, at s = r^2: the normal
/// one, mean and deviation of the tangential ones, and the coupling.
pub(crate) fn radial_functions(material: &HalfSpace, s: f64) -> Radial {
    let HalfSpace { a, b, c, .. } = *material;
    let inverse_r = 1.0 / (2.0 * PI * s.sqrt());
    [
        a * inverse_r,
        f64::midpoint(a, c) * inverse_r,
        (a - c) / 2.0 * inverse_r / s,
        b / (2.0 * PI * s),
    ]
}

/// The closed form over a cell, for a set of the coefficients, the others zero; it loses about as
/// many digits as the cell is cells away.
pub(crate) fn integrate_over_cell(material: &HalfSpace, cell: &Cell, set: KernelSet) -> Six {
    let HalfSpace { a, b, c, .. } = *material;
    let corner_difference = |f: fn(f64, f64) -> f64| {
        let (x0, x1) = (cell.x - cell.half_x, cell.x + cell.half_x);
        let (y0, y1) = (cell.y - cell.half_y, cell.y + cell.half_y);
        ((f(x1, y1) - f(x0, y1)) - (f(x1, y0) - f(x0, y0))) / (2.0 * PI)
    };
    // Integrals of x^2/r^3, y^2/r^3 (their sum is the integral of 1/r), x y/r^3, x/r^2, y/r^2.
    let xx = corner_difference(y_asinh);
    let yy = corner_difference(|x, y| y_asinh(y, x));
    let inverse_r = xx + yy;
    if set == KernelSet::Normal {
        return [0.0, 0.0, a * inverse_r, 0.0, 0.0, 0.0];
    }
    let xy = corner_difference(|x, y| -x.hypot(y));
    let [x, y] = if set == KernelSet::All {
        [
            corner_difference(log_atan),
            corner_difference(|x, y| log_atan(y, x)),
        ]
    } else {
        [0.0; 2]
    };
    // (1 - nu)/G = a and nu/G = c - a.
    [
        a * inverse_r + (c - a) * xx,
        a * inverse_r + (c - a) * yy,
        a * inverse_r,
        (c - a) * xy,
        -b * x,
        -b * y,
    ]
}

/// y asinh(x/|y|): its second derivative in x and y is x^2/r^3.
fn y_asinh(x: f64, y: f64) -> f64 {
    if y == 0.0 {
        0.0
    } else {
        y * (x / y.abs()).asinh()
    }
}

/// y ln r + x atan(y/x): its second derivative in x and y is x/r^2.
fn log_atan(x: f64, y: f64) -> f64 {
    let log = if y == 0.0 { 0.0 } else { y * x.hypot(y).ln() };
    let angle = if x == 0.0 { 0.0 } else { x * (y / x).atan() };
    log + angle
}
