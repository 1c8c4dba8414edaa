//! Where the coated body is stressed most: figure 13 of the paper.
//!
//! With E1/E2 = 2 two places compete, the middle of the coating and the trailing rim on the free
//! surface.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use contact_core::convolution::Tractions;
use contact_core::march::March;
use contact_core::scene::{Scene, Spacing};
use contact_subsurface::{Depth, Line, Probe, Search, Section, Side, States, default_depths};

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

/// The largest von Mises stress on y = 0 at the end of the path, over p_H and a_H.
struct Stressed {
    /// On the surface: its value, x and error.
    surface: (f64, f64, f64),
    /// Below a twentieth of a_H: its value and depth.
    below: (f64, Depth),
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
    let states = [Tractions {
        q_x: fields.q_x.as_slice(),
        q_y: fields.q_y.as_slice(),
        p: fields.p.as_slice(),
    }];
    let stick = [fields.stick.as_slice().unwrap()];
    let states = States {
        stick: Some(&stick),
        ..States::from(&states)
    };
    let line = Line::AlongX(0.0);
    let x: Vec<f64> = (0..scene.grid.nx).map(|i| scene.grid.x(i)).collect();
    let (body, grid) = (&scene.body2, &scene.grid);
    let search = Search::new(body, Side::Body2, grid, Some(line), &states).unwrap();
    let section = Section::new(body, Side::Body2, grid, line, states).unwrap();
    let mises = [Probe::find("von_mises", "of").unwrap()];
    let largest = |depths: &[Depth]| {
        let found = section.probe(depths, &x, &mises, &search).unwrap();
        found[0].1.unwrap()
    };
    let chosen = default_depths(body, hertz.a, 2.0 * hertz.a, 1.0).unwrap();
    let deep = chosen.iter().position(|d| d.z > 0.05 * hertz.a).unwrap();
    let (on, below) = (largest(&chosen[..1]), largest(&chosen[deep..]));
    let z = below.depth.z / hertz.a;
    Stressed {
        surface: (
            on.value / hertz.p0,
            on.x / hertz.a,
            on.error.total() / hertz.p0,
        ),
        below: (below.value / hertz.p0, Depth { z, ..below.depth }),
    }
}

/// On `n` and 2 `n` cells along x, which agree; those along y, fewer, matter to a thousandth.
fn on_two_grids(ratio: f64, n: usize) -> Stressed {
    let [coarse, fine] = [n, 2 * n].map(|n| stressed(ratio, (n, 64)));
    println!(
        "E1/E2 = {ratio}: surface {:?}, {:?}, below {:?}, {:?}",
        coarse.surface, fine.surface, coarse.below, fine.below
    );
    let change = coarse.below.0 / fine.below.0 - 1.0;
    assert!(change.abs() < 2e-3, "E1/E2 = {ratio}: {change:.1e}");
    let change = (coarse.surface.0 - fine.surface.0).abs();
    assert!(
        change < 0.01 && change < coarse.surface.2,
        "E1/E2 = {ratio}: {change:.1e}"
    );
    fine
}

/// In the compliant coating, in its middle, by 9.7 %: on 512 cells along x 0.5445 p_H there and
/// 0.4965 p_H on the surface.
#[test]
fn a_compliant_coating_is_stressed_most_in_its_middle() {
    let Stressed {
        surface,
        below: (value, at),
    } = on_two_grids(0.5, 64);
    assert!(at.layer == 0 && (0.3..0.6).contains(&at.z), "{at:?}");
    assert!((surface.0 - 0.4965).abs() < surface.2, "{surface:?}");
    assert!(
        (value / surface.0 - 1.097).abs() < 5e-3,
        "{value} {surface:?}"
    );
}

/// On the free surface, at the trailing rim, by a few hundredths.
#[test]
fn a_stiff_coating_is_stressed_most_on_the_free_surface() {
    let Stressed { surface, below } = on_two_grids(2.0, 128);
    // At the rim of the contact, which the coating draws in from a_H.
    assert!((-0.94..-0.90).contains(&surface.1), "x = {}", surface.1);
    assert!(surface.0 - surface.2 > below.0, "{surface:?} {below:?}");
}

/// At the interface, on the side of the coating.
#[test]
fn a_stiffer_coating_is_stressed_most_at_the_interface() {
    let Stressed {
        surface,
        below: (value, at),
    } = on_two_grids(4.0, 64);
    assert!(at.layer == 0 && (at.z - 1.0).abs() < 1e-9, "{at:?}");
    assert!(value > 1.05 * surface.0);
}
