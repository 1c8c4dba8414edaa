//! Mindlin: the displacement under a shear traction that has Hertz's shape.

use std::f64::consts::PI;

use contact_core::scene::Elastic;

/// Surface displacement (u_x, u_y) \[m\] inside r <= `a` of one half-space loaded by
/// q_x = `q0` sqrt(1 - r^2/a^2) on its surface, for any nu:
///
/// u_x = (pi q0/(32 G a)) \[4 (2 - nu) a^2 - (4 - 3 nu) x^2 - (4 - nu) y^2\],
/// u_y = (pi q0/(32 G a)) 2 nu x y.
///
/// R. D. Mindlin, J. Appl. Mech. 16 (1949) 259; K. L. Johnson, Contact Mechanics (1985), eq.
/// (3.91). The displacement is relative to infinity and along q_x where q0 > 0.
pub fn mindlin_shear_displacement(
    material: Elastic,
    q0: f64,
    a: f64,
    (x, y): (f64, f64),
) -> (f64, f64) {
    let nu = material.nu;
    let scale = PI * q0 / (32.0 * material.G() * a);
    let u_x = 4.0 * (2.0 - nu) * a * a - (4.0 - 3.0 * nu) * x * x - (4.0 - nu) * y * y;
    (scale * u_x, scale * 2.0 * nu * x * y)
}
