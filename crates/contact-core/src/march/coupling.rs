//! How strongly pressure and shear of two bodies are coupled.

use std::f64::consts::TAU;

use crate::kernels::Stack;
use crate::scene::{Body, Scene};

/// Wave numbers at which the coupling of the bodies is evaluated.
const WAVES: u32 = 64;

/// Coupling: the normal displacement under shear over that under pressure, the largest of
///
/// ```text
/// |rz_1 - rz_2| / (zz_1 + zz_2)
/// ```
///
/// over the waves from the length of the grid down to two cells; for half-spaces Dundurs' beta, and
/// more for a soft incompressible layer.
pub(super) fn coupling(scene: &Scene) -> f64 {
    let bodies = [(1.0, &scene.body1), (-1.0, &scene.body2)];
    let rigid = |body: &Body| body.substrate.is_rigid() && body.coatings.is_empty();
    let elastic = bodies.into_iter().filter(|(_, body)| !rigid(body));
    let stacks: Vec<_> = elastic
        .map(|(sign, body)| (sign, Stack::new(body)))
        .collect();
    let (longest, shortest) = (scene.grid.extent().0, 2.0 * scene.grid.dx);
    let at = |part: f64| {
        let k = TAU / (longest * (shortest / longest).powf(part));
        let sums = stacks.iter().fold([0.0; 2], |[rz, zz], (sign, stack)| {
            let response = stack.response(k);
            [rz + sign * response.rz, zz + response.zz]
        });
        (sums[0] / sums[1]).abs()
    };
    (0..=WAVES)
        .map(|n| at(f64::from(n) / f64::from(WAVES)))
        .fold(0.0, f64::max)
}
