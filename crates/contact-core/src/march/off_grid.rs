//! Contacts that reach the border of the grid.

use super::increment::Setup;
use crate::error::Error;
use crate::kernels::Stack;
use crate::scene::Scene;
use crate::solvers::Interface;

/// What a grid should be longer than the contact that is expected on it.
const CLEARANCE: f64 = 1.4;
/// What a grid should grow by where nothing is known but that it is too small.
const GROWTH: f64 = 1.4;

/// Fails if a cell at the border of the grid is in contact; that of a window is kept free.
pub(super) fn check(setup: &Setup<'_>, now: &Interface) -> Result<(), Error> {
    let (whole, grid) = (&setup.problem.scene.grid, &setup.geometry.grid);
    let (at_x, at_y) = (
        grid.nx == whole.nx,
        grid.ny == whole.ny && !grid.plane_strain,
    );
    let rows = setup.problem.plan.mirror.rows(grid.ny);
    let extent = whole.extent();
    let touched = (0..now.p.len()).filter(|&n| now.p[n] > 0.0).map(|n| {
        let (i, j) = (n / rows, n % rows);
        let end_x = at_x && (i == 0 || i + 1 == grid.nx);
        let end_y = at_y && (j + 1 == rows || (j == 0 && rows == grid.ny));
        let length = |touches: bool, extent: f64| if touches { extent } else { 0.0 };
        length(end_x, extent.0).max(length(end_y, extent.1))
    });
    let touched = touched.fold(0.0, f64::max);
    if touched == 0.0 {
        return Ok(());
    }
    let expected = CLEARANCE * 2.0 * expected_radius(&setup.problem.scene);
    let W = now.p.iter().sum::<f64>() * setup.problem.cell_area();
    Err(Error::OffGrid {
        increment: setup.state.increments + 1,
        W,
        extent_x: extent.0,
        extent_y: extent.1,
        needed: expected.max(GROWTH * touched),
    })
}

/// About the longer semi-axis of the contact under the largest load of the path \[m\]: Hertz's,
/// a^3 = 3 W R/(4 E*), with the modulus that a wave about as long as the contact meets,
/// 2/E* = sum of k C_33(k) at k = 1.5/a. Zero where the nominal shapes form no Hertz contact.
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
    // The radius goes with the cube root of the compliance, which falls with k: halfway steps
    // settle.
    for _ in 0..60 {
        a = (a * hertz.a * (compliance(1.5 / a) / uncoated).cbrt()).sqrt();
    }
    principal(scene, a)
}

/// The longer semi-axis of a contact of mean radius a \[m\]; in plane strain the half-width.
fn principal(scene: &Scene, a: f64) -> f64 {
    if scene.grid.plane_strain {
        return a;
    }
    // Of an ellipse, a_x/a_y is about (R_x/R_y)^(2/3).
    let (steep, shallow) = scene.principal_curvatures();
    a * (steep / shallow).cbrt()
}
