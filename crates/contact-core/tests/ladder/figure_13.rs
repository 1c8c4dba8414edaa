//! Where the coated body is stressed most: figure 13 of the paper.

use contact_core::convolution::Tractions;
use contact_core::fields::{Line, Section, Side, depths, maximum, von_mises};
use contact_core::march::March;
use contact_core::scene::{Scene, Spacing};
use ndarray::Axis;

/// The paper's scene on a coarser grid, its increments placed better.
fn scene(ratio: f64) -> Scene {
    let text = include_str!("../../../../scenes/coated_fretting.toml");
    let settings = [
        "grid.n=96".to_owned(),
        format!("body2.coatings.0.E.E_substrate={ratio}"),
    ];
    let mut scene = Scene::from_toml_str(text, "scene", &settings).unwrap();
    for (n, branch) in scene.path.branches.iter_mut().enumerate() {
        branch.increments = if n == 0 { 40 } else { 10 };
        if n == 0 {
            branch.spacing = Spacing::EqualRadius;
        }
    }
    scene
}

/// Largest von Mises stress over p_H on y = 0 after the path, its x and z over a_H, its layer.
fn largest(ratio: f64) -> (f64, f64, f64, usize) {
    let scene = scene(ratio);
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
    let m = maximum(&mises, &depths, &x).unwrap();
    let (x, z) = (m.along / hertz.a, m.depth.z / hertz.a);
    (m.value / hertz.p0, x, z, m.depth.layer)
}

#[test]
fn the_most_stressed_place_moves_with_the_coating() {
    let [soft, hard, harder] = [0.5, 2.0, 4.0].map(largest);
    // In the compliant coating, below its surface.
    assert!(soft.3 == 0 && soft.2 > 0.05 && soft.2 < 0.95, "{soft:?}");
    // On the free surface.
    assert!(hard.2 < 1e-9, "{hard:?}");
    // At the interface, on the side of the coating.
    assert!(harder.3 == 0 && (harder.2 - 1.0).abs() < 1e-9, "{harder:?}");
}
