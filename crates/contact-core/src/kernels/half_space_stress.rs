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

/// Stress per unit traction: rows xx, yy, zz, xy, xz, yz, columns q_x, q_y, p.
pub type StressResponse = [[f64; 3]; 6];

/// The stress at (x, y, z >= 0) from the corner of a quadrant under unit traction: rows xx, yy, zz, xy, xz, yz,
/// columns q_x, q_y, p. Lengths have any one unit. Cells are differences of four corners.
///
/// On the line of an edge the stress that a step of the traction causes is infinite like the
/// logarithm of the distance. There the distance is taken for `edge`, along x and along y in the
/// same unit.
pub(crate) fn corner(x: f64, y: f64, z: f64, edge: (f64, f64), nu: f64) -> StressResponse {
    let rho = (x * x + y * y + z * z).sqrt();
    let (xz2, yz2) = (x * x + z * z, y * y + z * z);
    let rho_plus_z = rho + z;
    // L_xx, L_yy, L_zz, L_xy, L_xz, L_yz.
    let vertex = (edge.0 * edge.0 + edge.1 * edge.1).sqrt();
    // l_xx = atan(y/x) - atan(y z/(x rho)) in one arc, and L is harmonic.
    let r2 = x * x + y * y;
    let l_zz = -angle_or_zero(x * y, z * rho);
    let (l_xx, l_yy) = if x == 0.0 || y == 0.0 {
        (0.0, 0.0)
    } else {
        let l_xx = (x * y * r2 / (rho_plus_z * (x * x * rho + y * y * z))).atan();
        (l_xx, -l_zz - l_xx)
    };
    let (l_xy, l_xz, l_yz) = (
        log_or_zero(rho_plus_z / vertex),
        log_of_sum(y, rho, xz2, edge.0),
        log_of_sum(x, rho, yz2, edge.1),
    );
    // z times the third derivatives.
    let quotient_or_zero = |numerator: f64, denominator: f64| {
        if numerator == 0.0 {
            0.0
        } else {
            numerator / denominator
        }
    };
    let z_xxz = -quotient_or_zero(z * x * y, rho * xz2);
    let z_yyz = -quotient_or_zero(z * x * y, rho * yz2);
    let z_zzz = -(z_xxz + z_yyz);
    let z_xyz = quotient_or_zero(z, rho);
    let z_xzz = -quotient_or_zero(z * z * y, rho * xz2);
    let z_yzz = -quotient_or_zero(z * z * x, rho * yz2);
    let z_xyy = quotient_or_zero(z * y, rho * rho_plus_z);
    let z_xxy = quotient_or_zero(z * x, rho * rho_plus_z);
    let z_xxx = -z_xyy - z_xzz;
    let z_yyy = -z_xxy - z_yzz;
    // Third derivatives of W.
    let (w_xxy, w_xyy) = (
        -quotient_or_zero(x, rho_plus_z),
        -quotient_or_zero(y, rho_plus_z),
    );
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

/// The ten radial functions of the stress under unit forces at the depth z > 0, s = r^2, in the
/// order and over the powers of r that [`super::stress`] adds up.
///
/// With D = rho + z and U = 2 nu W - z L as a function of s, under q_x (xx - yy)/2 and xy hold
/// 4 U_ss + 2 s U_sss in cos(theta) and 2 U_sss in cos(3 theta).
pub(crate) fn radial_functions(s: f64, z: f64, nu: f64) -> [f64; 10] {
    let rho2 = s + z * z;
    let rho = rho2.sqrt();
    let d = rho + z;
    let (r1, d1) = (1.0 / rho, 1.0 / d);
    let (r3, d2) = (r1 * r1 * r1, d1 * d1);
    let r5 = r3 * r1 * r1;
    let l_ss = -(2.0 * rho + z) * r3 * d2 / 4.0;
    let l_sss = (8.0 * rho2 + 9.0 * rho * z + 3.0 * z * z) * r5 * d2 * d1 / 8.0;
    let w_ss = r1 * d2 / 4.0;
    let w_sss = -(3.0 * rho + z) * r3 * d2 * d1 / 8.0;
    let (u_ss, u_sss) = (2.0 * nu * w_ss - z * l_ss, 2.0 * nu * w_sss - z * l_sss);
    let z3r5 = z * z * z * r5;
    [
        -3.0 * z3r5,
        1.5 * z3r5 - (1.0 + nu) * z * r3,
        2.0 * (1.0 - 2.0 * nu) * l_ss + 1.5 * z * r5,
        -3.0 * z * z * r5,
        -3.0 * z * z * r5,
        1.5 * z * z * r5 - (1.0 + nu) * r3,
        4.0 * u_ss + 2.0 * s * u_sss - r3,
        -2.0 * u_sss,
        1.5 * z * s * r5,
        -1.5 * z * r5,
    ]
    .map(|g| g / (2.0 * PI))
}

/// [`log_sum`] where rho is there already.
fn log_of_sum(y: f64, rho: f64, rho2_minus_y2: f64, edge: f64) -> f64 {
    if y != 0.0 && rho2_minus_y2 > 0.0 {
        let sum = y.abs() + rho;
        (0.5 * (sum * sum / rho2_minus_y2).ln()).copysign(y)
    } else {
        log_sum(y, rho2_minus_y2, edge)
    }
}

/// ln(v), zero at v = 0: there only differences between corners are finite.
pub(super) fn log_or_zero(v: f64) -> f64 {
    if v > 0.0 { v.ln() } else { 0.0 }
}

/// atan(n/d), zero where both vanish.
pub(super) fn angle_or_zero(n: f64, d: f64) -> f64 {
    if n == 0.0 { 0.0 } else { (n / d).atan() }
}

/// atan(n/d); zero for d = 0, the mean of its limits from both sides, so that on the border of a
/// loaded cell the surface stress is the mean of both sides.
pub(super) fn mean_angle(n: f64, d: f64) -> f64 {
    if d == 0.0 { 0.0 } else { (n / d).atan() }
}

/// ln(rho + y), up to a function of rho^2 - y^2 = `rho2_minus_y2` that cancels between corners. Where
/// rho^2 = y^2, only differences between corners with y of one sign are finite; for the others it is replaced
/// by `edge`^2, small against y^2.
pub(super) fn log_sum(y: f64, rho2_minus_y2: f64, edge: f64) -> f64 {
    if rho2_minus_y2 > 0.0 {
        (y / rho2_minus_y2.sqrt()).asinh()
    } else if y == 0.0 {
        0.0
    } else {
        y.signum() * (2.0 * y.abs() / edge).ln()
    }
}
