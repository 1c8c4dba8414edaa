//! Displacements of line contacts are relative to the points at the distance of the grid's length,
//! whatever the layers.

use contact_core::kernels::influence_coefficients;
use contact_core::scene::{Body, Coating, Elastic, Grid, KernelSettings, Shape};

use super::STEEL;

#[test]
fn the_displacement_vanishes_at_the_length_of_the_grid() {
    let a = 1e-3;
    let of = |layers: &[(f64, f64, f64)], length: f64, n: usize| {
        let mut body = Body::homogeneous(STEEL, Shape::Flat);
        let layer = |&(E, nu, h): &(f64, f64, f64)| Coating {
            material: Elastic { E, nu },
            thickness: h,
        };
        body.coatings = layers.iter().map(layer).collect();
        let grid = Grid::strip(length, n, 1.0).expect("a grid");
        influence_coefficients(&body, &grid, &KernelSettings::default(), true, None)
            .expect("coefficients")
    };
    let (length, n) = (2.4 * a, 64);
    let stacks: [&[(f64, f64, f64)]; 5] = [
        &[],
        &[(840e9, 0.3, a)],
        &[(840e9, 0.3, 0.1 * a)],
        &[(2e9, 0.45, 0.5 * a)],
        &[(400e9, 0.2, 0.02 * a), (20e9, 0.35, 3.0 * a)],
    ];
    for layers in stacks {
        let (short, long) = (of(layers, length, n), of(layers, 2.0 * length, 2 * n));
        for (one, other) in [
            (&short.zz, &long.zz),
            (&short.xx, &long.xx),
            (&short.yy, &long.yy),
        ] {
            // Both differ by a constant.
            let shift = one[(0, 0)] - other[(0, 0)];
            let there = (other[(n, 0)] + shift) / one[(0, 0)];
            assert!(there.abs() < 2e-3, "{layers:?}: {there}");
        }
    }
}
