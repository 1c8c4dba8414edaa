//! Line contacts with layers and of dissimilar bodies in partial slip, worn until little changes
//! any more.
//!
//! Under unlike or unequally coated bodies the shear moves the surfaces apart and together: outside
//! the stick zone they touch by turns, on one side at each end of the stroke.

use contact_core::scene::{Body, Coating, Elastic, Grid, Scene};
use contact_wear::{Cycling, Jump, Jumps, WornThrough};

use crate::bench::{STEEL, archard, cylinder, pulled, run, scene, wear};

const MU: f64 = 0.6;
const R: f64 = 10e-3;
const W: f64 = 2e5;
/// Length of the grid over the half-width of the contact.
const EXTENT: f64 = 3.2;
const CYCLES: f64 = 1e6;

/// The layers' E over the steel's and thickness over a.
type Layer = (f64, f64);

/// A steel cylinder on a flat, with layers on one of them or both.
fn contact(amplitude: f64, flat: Elastic, layers: [Option<Layer>; 2], n: usize) -> Scene {
    let grid = |length| Grid::strip(length, n, 1.0).unwrap();
    let path = pulled(W, amplitude * MU * W, 6);
    let mut scene = scene(cylinder(R), grid(1e-3), path, MU);
    scene.body2.substrate = flat;
    let a = scene.hertz().unwrap().a;
    scene.grid = grid(EXTENT * a);
    let coat = |body: &mut Body, layer: Option<Layer>| {
        let coating = layer.map(|(stiffer, h)| Coating {
            material: Elastic {
                E: stiffer * STEEL.E,
                nu: 0.3,
            },
            thickness: h * a,
        });
        body.coatings.extend(coating);
    };
    coat(&mut scene.body1, layers[0]);
    coat(&mut scene.body2, layers[1]);
    scene
}

fn worn(scene: &Scene, jumps: Jumps) -> Vec<Jump> {
    let mut wear = wear([archard(5e-14), archard(5e-14)], CYCLES, Cycling::March);
    (wear.jumps, wear.worn_through) = (jumps, WornThrough::GoOn);
    run(scene, &wear).1
}

fn deepest(jump: &Jump) -> f64 {
    jump.depth[0].max(jump.depth[1])
}

/// Jumps as long as their tolerance allows wear what a thousand short explicit ones do, within the
/// errors of both, and nothing is left that would wear on.
#[test]
fn surfaces_that_touch_by_turns_wear_in_long_jumps_as_in_short_ones() {
    let light = Elastic { E: 70e9, nu: 0.33 };
    let on_flat = |amplitude, layer, n| contact(amplitude, STEEL, [None, Some(layer)], n);
    let scenes = [
        ("stiff layer", on_flat(0.5, (3.0, 0.1), 64), 0.03),
        ("thick stiff layer", on_flat(0.4, (2.5, 0.15), 48), 0.03),
        // One cell at the border, which sticks or wears: half a cell of 48 is a sixth of the depth.
        ("soft layer", on_flat(0.6, (0.5, 0.2), 48), 0.3),
        ("light flat", contact(0.4, light, [None, None], 48), 0.03),
    ];
    for (name, scene, bound) in scenes {
        let short = worn(&scene, Jumps::Explicit(1000));
        let long = worn(&scene, Jumps::Tolerance(0.01));
        let ([first, ..], [.., end], [.., right]) = (&long[..], &long[..], &short[..]) else {
            panic!("{name}: no jumps");
        };
        let off = deepest(end) / deepest(right) - 1.0;
        let left = end.dissipated_per_cycle / first.dissipated_per_cycle;
        println!(
            "{name}: {} jumps, depth off by {:.2} %, said {:.1} and {:.1} %; a cycle dissipates {:.3} % of the first",
            long.len(),
            100.0 * off,
            100.0 * end.depth_error,
            100.0 * right.depth_error,
            100.0 * left
        );
        let error = end.depth_error + right.depth_error;
        assert!(off.abs() <= error.min(bound), "{name}: {off}, {error}");
        assert!(left < 0.02, "{name}: {left}");
        assert!(long.len() < 600, "{name}: {} jumps", long.len());
    }
}

/// Where the shortfall mu p - |q| is no root at the border, as under layers late in life, the
/// border is known to half a cell, and `depth_error` has what that makes of the depth.
#[test]
fn the_error_of_the_depth_covers_what_the_cells_do() {
    let both = |amplitude, layer| move |n| contact(amplitude, STEEL, [Some(layer), Some(layer)], n);
    let cases: [(&str, &dyn Fn(usize) -> Scene); 3] = [
        ("stiff layers", &both(0.5, (3.0, 0.1))),
        ("thin layers", &both(0.6, (2.25, 0.06))),
        ("soft layers", &both(0.5, (0.5, 0.15))),
    ];
    for (name, of) in cases {
        let end = |n| worn(&of(n), Jumps::Tolerance(0.01)).pop().unwrap();
        let right = end(400);
        for n in [48, 64, 80, 100, 160] {
            let end = end(n);
            let off = deepest(&end) / deepest(&right) - 1.0;
            let error = end.depth_error + right.depth_error;
            println!(
                "{name}, {n} cells: depth off by {:+.1} %, said {:.1} %, of the truth {:.1} %",
                100.0 * off,
                100.0 * end.depth_error,
                100.0 * right.depth_error
            );
            assert!(off.abs() <= error, "{name}, {n} cells: {off}, {error}");
            assert!(end.depth_error < 20.0 / n as f64, "{name}, {n} cells");
        }
    }
    // Of bare and like bodies the border is known within its cell.
    let bare = worn(
        &contact(0.5, STEEL, [None, None], 80),
        Jumps::Tolerance(0.01),
    );
    assert!(bare.last().unwrap().depth_error < 0.05);
}
