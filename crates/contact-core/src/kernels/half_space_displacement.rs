//! Displacement in a homogeneous half-space under uniform traction on a rectangle.
//!
//! In the notation of [`super::half_space_stress`], Boussinesq's and Cerruti's displacements under
//! unit forces are, times 4 pi G,
//!
//! ```text
//!        under p                        under q_x
//! u_x    -(1-2nu) L_x - z L_xz          2 L_z + 2nu W_xx - z L_xx
//! u_y    -(1-2nu) L_y - z L_yz          2nu W_xy - z L_xy
//! u_z    2(1-nu) L_z - z L_zz           (1-2nu) L_x - z L_xz
//! ```
//!
//! (K. L. Johnson, Contact Mechanics (1985), eq. (3.18), (3.75)), and those under q_y by exchange
//! of x and y. Corners as there.

use std::f64::consts::PI;

use super::half_space_stress::{angle_or_zero, log_or_zero, log_sum, mean_angle};
use super::layered_frf::HalfSpace;

/// Displacement per unit traction \[m/Pa\]: rows u_x, u_y, u_z, columns q_x, q_y, p.
pub(crate) type DisplacementResponse = [[f64; 3]; 3];

/// The displacement \[m/Pa times the unit of length\] at (x, y, z >= 0) from the corner of a quadrant under
/// unit traction: rows u_x, u_y, u_z, columns q_x, q_y, p. Cells are differences of four corners.
pub(crate) fn corner(x: f64, y: f64, z: f64, material: &HalfSpace) -> DisplacementResponse {
    let nu = material.nu;
    let rho = x.hypot(y).hypot(z);
    let l_xx = mean_angle(y, x) - mean_angle(y * z, x * rho);
    let l_yy = mean_angle(x, y) - mean_angle(x * z, y * rho);
    let l_zz = -angle_or_zero(x * y, z * rho);
    let (l_xy, l_xz, l_yz) = (
        log_or_zero(rho + z),
        log_sum(y, x * x + z * z, 1.0),
        log_sum(x, y * y + z * z, 1.0),
    );
    // At x = 0 or y = 0 the logarithms may have no limit, but their products with it do.
    let product_or_zero = |f: f64, v: f64| if f == 0.0 { 0.0 } else { f * v };
    let l_z = product_or_zero(x, l_xz) + product_or_zero(y, l_yz) + z * l_zz;
    let l_x = product_or_zero(y, l_xy) + product_or_zero(z, l_xz) + x * l_xx;
    let l_y = product_or_zero(x, l_xy) + product_or_zero(z, l_yz) + y * l_yy;
    let (w_xx, w_yy) = (
        z * l_xx - product_or_zero(x, l_xz),
        z * l_yy - product_or_zero(y, l_yz),
    );
    let w_xy = product_or_zero(z, l_xy) - rho;
    let (n, m) = (2.0 * nu, 1.0 - 2.0 * nu);
    let (z_xz, z_yz) = (product_or_zero(z, l_xz), product_or_zero(z, l_yz));
    let shear = n * w_xy - product_or_zero(z, l_xy);
    let u = [
        [2.0 * l_z + n * w_xx - z * l_xx, shear, -m * l_x - z_xz],
        [shear, 2.0 * l_z + n * w_yy - z * l_yy, -m * l_y - z_yz],
        [m * l_x - z_xz, m * l_y - z_yz, (2.0 - n) * l_z - z * l_zz],
    ];
    u.map(|row| row.map(|v| v * material.c / (4.0 * PI)))
}

/// The five radial functions of the displacement under unit forces at the depth z > 0, s = r^2:
/// u_z and the amplitude of x in u_x under p; under q_x the mean of u_x and u_y, the amplitude of
/// x^2 - y^2, and the amplitude of x in u_z.
pub(crate) fn radial_functions(s: f64, z: f64, material: &HalfSpace) -> [f64; 5] {
    let nu = material.nu;
    let rho = (s + z * z).sqrt();
    let d = rho + z;
    let (r1, r3) = (1.0 / rho, 1.0 / (rho * rho * rho));
    let l_ss = -(2.0 * rho + z) * r3 / (4.0 * d * d);
    let w_ss = r1 / (4.0 * d * d);
    let surface_term = (1.0 - 2.0 * nu) * r1 / d;
    [
        2.0 * (1.0 - nu) * r1 + z * z * r3,
        z * r3 - surface_term,
        (2.0 - nu) * r1 - z * z * r3 / 2.0,
        2.0 * (2.0 * nu * w_ss - z * l_ss),
        z * r3 + surface_term,
    ]
    .map(|g| g * material.c / (4.0 * PI))
}
