//! Where the coated body is stressed most: figure 13 of the paper.
//!
//! With E1/E2 = 2 two places compete, the middle of the coating and the trailing rim on the free
//! surface, where sampled values are low by the square root of the cell.

#![allow(clippy::unwrap_used)]

use contact_core::convolution::Tractions;
use contact_core::fields::{Line, Section, Side, depths, maximum, von_mises};
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

/// Von Mises stress over p_H on y = 0 at the end of the path: its largest value on the surface,
/// and the largest below half a cell with x and z over a_H and the layer.
fn largest(ratio: f64, n: usize) -> (f64, [f64; 3], usize) {
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
    let mises = stress.map_axis(Axis(0), |s| von_mises(&std::array::from_fn(|c| s[c])));
    let x: Vec<f64> = (0..scene.grid.nx).map(|i| scene.grid.x(i)).collect();
    let shallow = depths.iter().take_while(|d| d.z < 0.05 * hertz.a).count();
    let surface = mises.row(0).iter().copied().fold(0.0, f64::max);
    let below = mises.slice_move(s![shallow.., ..]);
    let m = maximum(&below, &depths[shallow..], &x).unwrap();
    (
        surface / hertz.p0,
        [
            m.value / hertz.p0,
            m.place[0] / hertz.a,
            m.depth.z / hertz.a,
        ],
        m.depth.layer,
    )
}

/// At the rim of the contact the surface stress has a cusp, and its samples fall short of the top
/// with the square root of the cell: this is what two grids, one twice as fine, tend to.
fn limit(coarse: f64, fine: f64) -> f64 {
    fine + (fine - coarse) / (2.0_f64.sqrt() - 1.0)
}

#[test]
fn the_most_stressed_place_moves_with_the_coating() {
    let [soft, hard, harder] = [0.5, 2.0, 4.0].map(|ratio| [64, 128].map(|n| largest(ratio, n)));
    for [coarse, fine] in [&soft, &hard, &harder] {
        // Below the surface both grids agree.
        assert!(
            (coarse.1[0] / fine.1[0] - 1.0).abs() < 2e-3,
            "{coarse:?} {fine:?}"
        );
    }
    let surface = |[coarse, fine]: &[(f64, [f64; 3], usize); 2]| limit(coarse.0, fine.0);
    // In the compliant coating, in its middle.
    let (_, [value, _, z], layer) = soft[1];
    assert!(
        layer == 0 && (0.3..0.6).contains(&z) && value > 1.1 * surface(&soft),
        "{soft:?}"
    );
    // On the free surface, at the trailing rim.
    assert!(surface(&hard) > hard[1].1[0], "{hard:?}");
    // At the interface, on the side of the coating.
    let (_, [value, _, z], layer) = harder[1];
    assert!(
        layer == 0 && (z - 1.0).abs() < 1e-9 && value > 1.05 * surface(&harder),
        "{harder:?}"
    );
}
