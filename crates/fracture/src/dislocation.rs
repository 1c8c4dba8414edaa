//! Stress of an edge dislocation below a free surface.
//!
//! With zeta = x + i z and Goursat's functions Phi, Psi a dislocation of strength B at zeta_0 in
//! the infinite plane has
//!
//! ```text
//! Phi_0 = B/(zeta - zeta_0),  Psi_0 = conj(B)/(zeta - zeta_0) + B conj(zeta_0)/(zeta - zeta_0)^2,
//! ```
//!
//! and the surface z = 0 is freed by Phi_1 = -(bar Phi_0 + zeta bar Phi_0' + bar Psi_0),
//! Psi_1 = -bar Phi_0 - Phi_1 - zeta Phi_1', bar f(zeta) = conj f(conj zeta) (Muskhelishvili's
//! continuation). On a line of direction exp(i b) s_nn - i s_tn = Phi + conj Phi +
//! exp(2 i b) (conj(zeta) Phi' + Psi). A strength B = D exp(i b) gives 2 D/(s - s') on its own
//! line, D = D_n + i D_t; the jump of displacement is (8 pi/E') times the integral of D, E' =
//! E/(1 - nu^2).
//!
//! D. A. Hills, P. A. Kelly, D. N. Dai, A. M. Korsunsky, Solution of Crack Problems (1996), ch.
//! 2, 4.

use num_complex::Complex64;

/// s_nn + i s_tn on a line of direction `along` (a unit number) at `at` under a dislocation of the
/// strength `B` at `source`, both below the surface.
pub(crate) fn traction(
    B: Complex64,
    source: Complex64,
    along: Complex64,
    at: Complex64,
) -> Complex64 {
    let d = (at - source).inv();
    let e = (at - source.conj()).inv();
    let (d2, e2) = (d * d, e * e);
    let e3 = e2 * e;
    let C = B.conj();
    // Conjugated continuations of Phi_0 and Psi_0, with their derivatives.
    let (f, f1, f2) = (C * e, -C * e2, C * e3 * 2.0);
    let g = B * e + C * source * e2;
    let g1 = -B * e2 - C * source * e3 * 2.0;
    let image = -(f + at * f1 + g);
    let image1 = -(f1 * 2.0 + at * f2 + g1);
    let phi = B * d + image;
    let phi1 = -B * d2 + image1;
    let psi = C * d + B * source.conj() * d2 - f - image - at * image1;
    (phi + phi.conj() + along * along * (at.conj() * phi1 + psi)).conj()
}
