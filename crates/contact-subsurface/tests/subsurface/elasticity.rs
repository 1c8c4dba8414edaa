//! What elasticity asks for: continuity across interfaces, Hooke's law, equilibrium.

use contact_core::scene::Grid;
use contact_subsurface::{Depth, Line, Points, Section, Side, depths};

use crate::{coated, states, tractions};

#[test]
fn what_must_be_continuous_across_interfaces_is() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let section =
        Section::new(&body, Side::Body2, &grid, Line::AlongX(0.4), &[states(&q)]).unwrap();
    let both = depths(&body, &[9.5, 12.0]).unwrap();
    assert_eq!(
        both.iter().map(|d| d.layer).collect::<Vec<_>>(),
        [0, 1, 1, 2]
    );
    let stress = section.stress(&both).unwrap().remove(0);
    let u = section.displacement(&both).unwrap().remove(0);
    let mut worst: f64 = 0.0;
    for upper in [0, 2] {
        for i in 0..grid.nx {
            for c in [2, 4, 5] {
                let jump = stress[(c, upper, i)] - stress[(c, upper + 1, i)];
                worst = worst.max(jump.abs());
                assert!(jump.abs() < 1e-9, "stress {c} at {upper}: {jump:.1e}");
            }
            for c in 0..3 {
                let jump = u[(c, upper, i)] - u[(c, upper + 1, i)];
                assert!(jump.abs() < 1e-9, "displacement {c} at {upper}: {jump:.1e}");
            }
        }
        let jump = (0..grid.nx).map(|i| (stress[(0, upper, i)] - stress[(0, upper + 1, i)]).abs());
        assert!(
            jump.fold(0.0, f64::max) > 1e-3,
            "s_xx jumps where moduli do"
        );
    }
    println!("s_zz, s_xz, s_yz across interfaces: {worst:.1e} of the traction");
}

/// Derivatives by central differences of two steps: the remainder falls as h^2, and Richardson's
/// combination of both leaves h^4.
#[test]
fn stress_obeys_hooke_and_equilibrium() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let points = Points::new(&body, Side::Body2, &grid, &[states(&q)]).unwrap();
    let lame = |layer: usize| {
        let m = body
            .coatings
            .get(layer)
            .map_or(body.substrate, |c| c.material);
        (2.0 * m.G() * m.nu / (1.0 - 2.0 * m.nu), m.G())
    };
    // Shallow and deep in the coating, in the second layer, in the substrate.
    for (z, layer) in [(4.0, 0), (8.8, 0), (10.7, 1), (15.0, 2)] {
        let at = [0.37, -1.12, z];
        let moved = |axis: usize, by: f64| {
            let mut p = at;
            p[axis] += by;
            (p[0], p[1], Depth { z: p[2], layer })
        };
        let slopes = |h: f64| {
            let places: Vec<_> = (0..3)
                .flat_map(|axis| [moved(axis, h), moved(axis, -h)])
                .collect();
            let s = points.stress(&places).unwrap().remove(0);
            let u = points.displacement(&places).unwrap().remove(0);
            let ds: [[f64; 6]; 3] = std::array::from_fn(|a| {
                std::array::from_fn(|c| (s[2 * a][c] - s[2 * a + 1][c]) / (2.0 * h))
            });
            let du: [[f64; 3]; 3] = std::array::from_fn(|a| {
                std::array::from_fn(|c| (u[2 * a][c] - u[2 * a + 1][c]) / (2.0 * h))
            });
            (ds, du)
        };
        let s = points
            .stress(&[(at[0], at[1], Depth { z, layer })])
            .unwrap()[0][0];
        let (lambda, G) = lame(layer);
        let errors = |h: f64| {
            let (ds, du) = slopes(h);
            let divergence = [
                ds[0][0] + ds[1][3] + ds[2][4],
                ds[0][3] + ds[1][1] + ds[2][5],
                ds[0][4] + ds[1][5] + ds[2][2],
            ];
            let volume = du[0][0] + du[1][1] + du[2][2];
            let hooke = [
                lambda * volume + 2.0 * G * du[0][0] - s[0],
                lambda * volume + 2.0 * G * du[1][1] - s[1],
                lambda * volume + 2.0 * G * du[2][2] - s[2],
                G * (du[0][1] + du[1][0]) - s[3],
                G * (du[0][2] + du[2][0]) - s[4],
                G * (du[1][2] + du[2][1]) - s[5],
            ];
            [divergence.to_vec(), hooke.to_vec()].concat()
        };
        let (coarse, fine) = (errors(0.2), errors(0.1));
        let largest = |e: &[f64]| e.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let ratio = largest(&coarse) / largest(&fine);
        println!("equilibrium and Hooke at z = {z}: with h halved the error falls by {ratio:.3}");
        assert!(
            (ratio - 4.0).abs() < 0.2,
            "z = {z}: falls by {ratio} with h halved"
        );
        let rest: Vec<f64> = coarse
            .iter()
            .zip(&fine)
            .map(|(c, f)| (4.0 * f - c) / 3.0)
            .collect();
        assert!(largest(&rest) < 1e-5, "z = {z}: {rest:?}");
    }
}
