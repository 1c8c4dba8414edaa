//! Stress in a homogeneous half-space under uniform traction on a rectangle.
//!
//! With L = ln(rho + z), W = z L - rho (so that W_z = L), rho the distance and subscripts for
//! derivatives, Boussinesq's and Cerruti's stresses under unit forces are, times 2 pi,
//!
//! ```text
//!        under p                               under q_x
//! xx     -(1-2nu) L_xx - z L_xxz + 2nu L_zz    2(1+nu) L_xz + 2nu W_xxx - z L_xxx
//! yy     -(1-2nu) L_yy - z L_yyz + 2nu L_zz    2nu L_xz + 2nu W_xyy - z L_xyy
//! zz     L_zz - z L_zzz                        -z L_xzz
//! xy     -(1-2nu) L_xy - z L_xyz               L_yz + 2nu W_xxy - z L_xxy
//! xz     -z L_xzz                              L_zz - z L_xxz
//! yz     -z L_yzz                              -z L_xyz
//! ```
//!
//! (from the potentials of K. L. Johnson, Contact Mechanics (1985), eq. (3.2)-(3.6), and Hooke's
//! law), and those under q_y by exchange of x and y. Each derivative is replaced by a function
//! whose second derivative in x and y it is; the difference of that between the four corners is
//! the integral over the rectangle. Terms in x or y alone drop out and are left out.

use std::f64::consts::PI;

use super::cell::Cell;

/// Stress per unit traction: rows xx, yy, zz, xy, xz, yz, columns q_x, q_y, p.
pub type StressResponse = [[f64; 3]; 6];

/// The stress of one corner at (x, y, z) from it; z >= 0.
pub(crate) fn corner(x: f64, y: f64, z: f64, nu: f64) -> StressResponse {
    let rho = x.hypot(y).hypot(z);
    let (xz2, yz2) = (x * x + z * z, y * y + z * z);
    let along = rho + z;
    // L_xx, L_yy, L_zz, L_xy, L_xz, L_yz.
    let depth_angle = angle(x * y, z * rho);
    let l_xx = angle(y, x) - angle(y * z, x * rho);
    let l_yy = angle(x, y) - angle(x * z, y * rho);
    let l_zz = -depth_angle;
    let (l_xy, l_xz, l_yz) = (along.ln(), log_sum(y, xz2), log_sum(x, yz2));
    // z times the third derivatives.
    let over = |numerator: f64, denominator: f64| {
        if numerator == 0.0 {
            0.0
        } else {
            numerator / denominator
        }
    };
    let z_xxz = -over(z * x * y, rho * xz2);
    let z_yyz = -over(z * x * y, rho * yz2);
    let z_zzz = -(z_xxz + z_yyz);
    let z_xyz = over(z, rho);
    let z_xzz = -over(z * z * y, rho * xz2);
    let z_yzz = -over(z * z * x, rho * yz2);
    let z_xyy = over(z * y, rho * along);
    let z_xxy = over(z * x, rho * along);
    let z_xxx = -z_xyy - z_xzz;
    let z_yyy = -z_xxy - z_yzz;
    // Third derivatives of W.
    let (w_xxy, w_xyy) = (-x / along, -y / along);
    let (w_xxx, w_yyy) = (-w_xyy - l_xz, -w_xxy - l_yz);
    let (n, m) = (2.0 * nu, 1.0 - 2.0 * nu);
    let s = [
        [
            (2.0 + n) * l_xz + n * w_xxx - z_xxx,
            n * l_yz + n * w_xxy - z_xxy,
            -m * l_xx - z_xxz + n * l_zz,
        ],
        [
            n * l_xz + n * w_xyy - z_xyy,
            (2.0 + n) * l_yz + n * w_yyy - z_yyy,
            -m * l_yy - z_yyz + n * l_zz,
        ],
        [-z_xzz, -z_yzz, l_zz - z_zzz],
        [
            l_yz + n * w_xxy - z_xxy,
            l_xz + n * w_xyy - z_xyy,
            -m * l_xy - z_xyz,
        ],
        [l_zz - z_xxz, -z_xyz, -z_xzz],
        [-z_xyz, l_zz - z_yyz, -z_yzz],
    ];
    s.map(|row| row.map(|v| v / (2.0 * PI)))
}

/// The stress at depth z in the middle of the coordinates under unit traction on a cell.
pub(crate) fn under_cell(cell: &Cell, z: f64, nu: f64) -> StressResponse {
    let (x0, x1) = (cell.x - cell.half_x, cell.x + cell.half_x);
    let (y0, y1) = (cell.y - cell.half_y, cell.y + cell.half_y);
    let at = |x, y| corner(x, y, z, nu);
    difference(&at(x1, y1), &at(x0, y1), &at(x1, y0), &at(x0, y0))
}

/// (far - left) - (near - opposite) of the four corners.
pub(crate) fn difference(
    both: &StressResponse,
    low_x: &StressResponse,
    low_y: &StressResponse,
    low: &StressResponse,
) -> StressResponse {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| (both[i][j] - low_x[i][j]) - (low_y[i][j] - low[i][j]))
    })
}

/// atan(n/d), zero where both vanish.
fn angle(n: f64, d: f64) -> f64 {
    if n == 0.0 { 0.0 } else { (n / d).atan() }
}

/// ln(rho + y) up to a function of `rest` = rho^2 - y^2; where that vanishes, only differences
/// between y of one sign are finite.
fn log_sum(y: f64, rest: f64) -> f64 {
    if rest > 0.0 {
        (y / rest.sqrt()).asinh()
    } else if y == 0.0 {
        0.0
    } else {
        y.signum() * y.abs().ln()
    }
}
