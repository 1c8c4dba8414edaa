//! Estimate of the contact radius before the solution.

use crate::kernels::Stack;
use crate::scene::Scene;

/// Estimate of the longer semi-axis of the contact under the largest load of the path \[m\], after
/// Hertz: a^3 = 3 W R/(4 E*), with the modulus of a wave about as long as the contact, 2/E* = sum
/// of k C_33(k) at k = 1.5/a. Zero where the nominal shapes form no Hertz contact.
pub(super) fn expected_radius(scene: &Scene) -> f64 {
    let Some(hertz) = scene.hertz() else {
        return 0.0;
    };
    let stacks: Vec<_> = [&scene.body1, &scene.body2]
        .into_iter()
        .filter(|b| !(b.substrate.is_rigid() && b.coatings.is_empty()))
        .map(Stack::new)
        .collect();
    let compliance = |k: f64| -> f64 { stacks.iter().map(|s| s.response(k).zz).sum() };
    let uncoated = 2.0 / hertz.E_star;
    let mut a = hertz.a;
    // a ~ compliance^(1/3), and the compliance falls with k: a fixed-point iteration with averaging
    // converges.
    for _ in 0..60 {
        a = (a * hertz.a * (compliance(1.5 / a) / uncoated).cbrt()).sqrt();
    }
    principal(scene, a)
}

/// The longer semi-axis of the elliptical contact of mean radius a \[m\]; in plane strain the half-width a
/// itself.
fn principal(scene: &Scene, a: f64) -> f64 {
    if scene.grid.plane_strain {
        return a;
    }
    // Of an ellipse, a_x/a_y is about (R_x/R_y)^(2/3).
    let (steep, shallow) = scene.principal_curvatures();
    a * (steep / shallow).cbrt()
}
