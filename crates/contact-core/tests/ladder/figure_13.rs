//! Where the coated body is stressed most: figure 13 of the paper.
//!
//! With E1/E2 = 2 two places compete, the middle of the coating and the trailing rim on the free
//! surface, where sampled values are low by the square root of the cell.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use contact_core::convolution::Tractions;
use contact_core::fields::{Depth, Line, Section, Side, depths, measure_named};
use contact_core::march::March;
use contact_core::scene::{Scene, Spacing};
use ndarray::{Axis, s};

/// The paper's scene with its increments placed better.
fn scene(ratio: f64, n: usize) -> Scene {
    let text = include_str!("../../../../scenes/coated_fretting.toml");
    let settings = [
        format!("grid.n={n}"),
        format!("body2.coatings.0.E.E_substrate={ratio}"),
    ];
    let mut scene = Scene::from_toml_str(text, "scene", &settings).unwrap();
    for (n, branch) in scene.path.branches.iter_mut().enumerate() {
        branch.increments = if n == 0 { 30 } else { 8 };
        if n == 0 {
            branch.spacing = Spacing::EqualRadius;
        }
    }
    scene
}

/// Von Mises stress on y = 0 at the end of the path, over p_H and a_H.
struct Stressed {
    /// The largest value, its x and its depth.
    largest: (f64, f64, Depth),
    /// The largest sample on the surface.
    surface: f64,
    /// The largest value below a twentieth of a_H.
    below: f64,
}

fn stressed(ratio: f64, n: usize) -> Stressed {
    let scene = scene(ratio, n);
    let hertz = scene.hertz().unwrap();
    let mut march = March::new(&scene).unwrap();
    while let Some(increment) = march.advance() {
        increment.unwrap();
    }
    let fields = march.fields();
    let state = Tractions {
        q_x: fields.q_x.as_slice(),
        q_y: fields.q_y.as_slice(),
        p: fields.p.as_slice(),
    };
    let z: Vec<f64> = (0..=256)
        .map(|i| 2.0 * hertz.a * f64::from(i) / 256.0)
        .collect();
    let depths = depths(&scene.body2, &z).unwrap();
    let line = Line::AlongX(0.0);
    let section = Section::new(&scene.body2, Side::Body2, &scene.grid, line, &[state]).unwrap();
    let stress = section.stress(&depths).unwrap().remove(0);
    let x: Vec<f64> = (0..scene.grid.nx).map(|i| scene.grid.x(i)).collect();
    let mises = measure_named("von_mises").unwrap();
    let largest = mises.maximum(&stress, &depths, &x).unwrap();
    let surface = mises.on(&stress.index_axis(Axis(1), 0));
    let shallow = depths.iter().take_while(|d| d.z < 0.05 * hertz.a).count();
    let below = stress.slice_move(s![.., shallow.., ..]);
    let below = mises.maximum(&below, &depths[shallow..], &x).unwrap();
    let depth = Depth {
        z: largest.depth.z / hertz.a,
        layer: largest.depth.layer,
    };
    Stressed {
        largest: (largest.value / hertz.p0, largest.place[0] / hertz.a, depth),
        surface: surface.fold(0.0, |m: f64, v| m.max(*v)) / hertz.p0,
        below: below.value / hertz.p0,
    }
}

/// At the rim of the contact the surface stress has a cusp, and its samples fall short of the top
/// with the square root of the cell: this is what two grids, one twice as fine, tend to.
fn limit(coarse: f64, fine: f64) -> f64 {
    fine + (fine - coarse) / (2.0_f64.sqrt() - 1.0)
}

#[test]
fn the_most_stressed_place_moves_with_the_coating() {
    let [soft, hard, harder] = [0.5, 2.0, 4.0].map(|ratio| {
        let grids = [64, 128].map(|n| stressed(ratio, n));
        let [coarse, fine] = &grids;
        // Below the surface both grids agree.
        let change = coarse.below / fine.below - 1.0;
        assert!(change.abs() < 2e-3, "E1/E2 = {ratio}: {change:.1e}");
        let surface = limit(coarse.surface, fine.surface);
        println!(
            "E1/E2 = {ratio}: {:?}, below the surface {:.4}, on it {surface:.4}",
            fine.largest, fine.below
        );
        (fine.largest, fine.below, surface)
    });
    // In the compliant coating, in its middle.
    let ((_, _, at), below, surface) = soft;
    assert!(at.layer == 0 && (0.3..0.6).contains(&at.z), "{soft:?}");
    assert!(below > 1.1 * surface, "{soft:?}");
    // On the free surface, at the trailing rim, by a hundredth, if two grids are continued to the
    // limit; the samples of one grid of this size, continued to the rim, put it in the coating.
    let (_, below, surface) = hard;
    assert!(surface > below, "{hard:?}");
    // At the interface, on the side of the coating.
    let ((_, _, at), below, surface) = harder;
    assert!(at.layer == 0 && (at.z - 1.0).abs() < 1e-9, "{harder:?}");
    assert!(below > 1.05 * surface, "{harder:?}");
}
