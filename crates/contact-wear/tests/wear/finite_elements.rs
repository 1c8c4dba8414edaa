//! R. McColl, J. Ding, S. B. Leen, Wear 256 (2004) 1114-1127, at 185 N: a cylinder on a flat in
//! gross slip, the stroke as long as the contact, both bodies wearing. The data are those of
//! tests/data/wear.

use std::f64::consts::PI;

use contact_core::scene::{Elastic, Grid};
use contact_wear::{Cycling, Jumps};

use crate::bench::{STEEL, archard, cylinder, run, scene, to_and_fro, wear};

/// Stiffness per length of two half-planes between the contact, of half-width b at first, and a
/// depth d, where they are driven. Under a shear of the shape (b^2 - x^2)^(1/2) and the force Q per
/// length a half-plane gives way by `Q (1 - nu^2)/(pi E) [2 ln(2 d/b) + 1 + 1/(1 - nu)]` between
/// the middle of the contact and the point below it (as K. L. Johnson, Contact Mechanics (1985),
/// section 5.6, has it of a pressure).
fn series(d: f64, b: f64) -> f64 {
    let Elastic { E, nu } = STEEL;
    let gives = (1.0 - nu * nu) / (PI * E) * (2.0 * (2.0 * d / b).ln() + 1.0 + 1.0 / (1.0 - nu));
    1.0 / (2.0 * gives)
}

#[test]
fn both_bodies_wear_as_in_finite_elements() {
    let grid = Grid::strip(0.72e-3, 480, 1.0).unwrap();
    let (W, mu) = (18.5e3, 0.9);
    let mut scene = scene(cylinder(6e-3), grid, to_and_fro(W, 25e-6, 8), mu);
    scene.path.rig_stiffness = Some(series(6e-3, scene.hertz().unwrap().a));
    // Depth of the flat in um of two finite-element models, a mesh that moves and level sets.
    for (cycles, moved, level) in [(1e3, 0.372_697, 0.378), (18e3, 2.705_496, 2.713)] {
        let laws = [archard(1.9e-14), archard(2.9e-14)];
        let mut wear = wear(laws, cycles, Cycling::Sliding);
        wear.jumps = Jumps::Tolerance(0.02);
        let (run, jumps) = run(&scene, &wear);
        let last = jumps.last().unwrap();
        let depth = 1e6 * last.depth[1];
        println!("{cycles} cycles: {depth:.4} um in {} jumps", jumps.len());
        assert!((depth / moved - 1.0).abs() < 0.03 && (depth / level - 1.0).abs() < 0.03);
        if cycles < 18e3 {
            continue;
        }
        let area = 1e6 * last.volume[1];
        assert!(
            (area / 9.38e-4 - 1.0).abs() < 0.02,
            "worn area {area:e} mm^2"
        );
        let worn = run.block().worn2;
        let scar: Vec<f64> = (0..grid.nx)
            .filter(|&i| worn[(i, 0)] > 1e-9)
            .map(|i| 1e3 * grid.x(i))
            .collect();
        for (end, asked) in [(scar[0], -0.26), (scar[scar.len() - 1], 0.26)] {
            assert!((end - asked).abs() < 0.02, "the scar ends at {end} mm");
        }
        for line in include_str!("../../../../tests/data/wear/mccoll_finite_elements.csv").lines() {
            let row: Vec<f64> = line.split(',').filter_map(|v| v.parse().ok()).collect();
            let &[18_000.0, x, asked] = &row[..] else {
                continue;
            };
            let i = ((1e-3 * x - grid.x(0)) / grid.dx).round() as usize;
            let found = 1e6 * worn[(i, 0)];
            // Their elements are 0.03 mm wide.
            assert!(
                (found - asked).abs() < 0.1,
                "{found} um, not {asked} um at {x} mm"
            );
        }
    }
}
