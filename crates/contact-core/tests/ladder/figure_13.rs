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
        branch.increments = Some(if n == 0 { 30 } else { 8 });
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

/// On `n` cells along x and a number along y.
fn stressed(ratio: f64, (n, across): (usize, usize)) -> Stressed {
    let mut scene = scene(ratio, across);
    let length = scene.grid.extent().0;
    (scene.grid.nx, scene.grid.dx) = (n, length / n as f64);
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

/// On `n` and 2 `n` cells along x; those along y, fewer, matter to a thousandth.
fn on_two_grids(ratio: f64, n: usize) -> [Stressed; 2] {
    let grids = [n, 2 * n].map(|n| stressed(ratio, (n, 64)));
    let [coarse, fine] = &grids;
    // Below the surface both grids agree, on it the samples climb to the cusp.
    let change = coarse.below / fine.below - 1.0;
    assert!(change.abs() < 2e-3, "E1/E2 = {ratio}: {change:.1e}");
    println!(
        "E1/E2 = {ratio}: {:?}, below the surface {:.4}, on it {:.4} to {:.4}",
        fine.largest, fine.below, coarse.surface, fine.surface
    );
    grids
}

/// In the compliant coating, in its middle.
#[test]
fn a_compliant_coating_is_stressed_most_in_its_middle() {
    let [coarse, fine] = on_two_grids(0.5, 64);
    let (_, _, at) = fine.largest;
    assert!(at.layer == 0 && (0.3..0.6).contains(&at.z), "{at:?}");
    assert!(fine.below > 1.1 * limit(coarse.surface, fine.surface));
}

/// On the free surface, at the trailing rim, by a few hundredths. Samples underestimate a cusp, the
/// more the coarser they are, and so does what [`contact_core::fields::rims`] makes of them: up to
/// 128 cells along x it is 0.005 p_H below the stress in the middle of the coating, at 256 it is
/// 0.002 above, at 512 0.007 (0.7213 and 0.7268 against 0.7198), and the samples tend to 0.02 above.
#[test]
fn a_stiff_coating_is_stressed_most_on_the_free_surface() {
    let [coarse, fine] = on_two_grids(2.0, 128);
    let (value, x, at) = fine.largest;
    assert!(at.layer == 0 && at.z == 0.0, "{at:?}");
    // A cell from the rim of the contact, which the coating draws in from a_H.
    assert!((-0.94..-0.90).contains(&x), "x = {x}");
    assert!(value > fine.below && fine.surface > coarse.surface);
    let top = limit(coarse.surface, fine.surface);
    assert!(top > value && top > 1.015 * fine.below, "{top}");
}

/// At the interface, on the side of the coating.
#[test]
fn a_stiffer_coating_is_stressed_most_at_the_interface() {
    let [coarse, fine] = on_two_grids(4.0, 64);
    let (_, _, at) = fine.largest;
    assert!(at.layer == 0 && (at.z - 1.0).abs() < 1e-9, "{at:?}");
    assert!(fine.below > 1.05 * limit(coarse.surface, fine.surface));
}
