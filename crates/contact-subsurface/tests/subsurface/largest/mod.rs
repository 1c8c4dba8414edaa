//! Largest stresses below solved contacts, by default, against independent solutions: how far off
//! they are and whether their errors say so.

#![allow(clippy::unwrap_used, clippy::print_stdout, non_snake_case)]

mod random;

use contact_core::convolution::Tractions;
use contact_core::march::{Fields, March};
use contact_core::scene::{
    Body, Coating, Elastic, Friction, Grid, LoadPath, Scene, Settings, Shape,
};
use contact_reference::{HertzStress, LineContact, hertz, line_contact};
use contact_subsurface::{
    Extremum, Line, Measure, Points, Probe, Search, Section, Side, States, Zone, borders,
    default_depths, find_measure,
};
use serde_json::Value;

use crate::branch_ends::solved;

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };
const R: f64 = 0.01;

fn tractions(fields: &Fields) -> Tractions<'_> {
    Tractions {
        q_x: fields.q_x.as_slice(),
        q_y: fields.q_y.as_slice(),
        p: fields.p.as_slice(),
    }
}

/// The largest value on y = 0 in body 2, in a layer or in all, as the command line and Python give
/// it.
fn largest(scene: &Scene, fields: &Fields, of: &str, layer: Option<usize>) -> Extremum {
    in_layer(scene, fields, of, (scene.hertz().unwrap().a, layer))
}

/// The same of a contact about as large as `a`.
fn on_section(scene: &Scene, fields: &Fields, of: &str, a: f64) -> Extremum {
    in_layer(scene, fields, of, (a, None))
}

fn in_layer(
    scene: &Scene,
    fields: &Fields,
    of: &str,
    (a, layer): (f64, Option<usize>),
) -> Extremum {
    let (body, grid) = (&scene.body2, &scene.grid);
    let states = [tractions(fields)];
    let stick = [fields.stick.as_slice().unwrap()];
    let states = States {
        stick: Some(&stick),
        ..States::from(&states)
    };
    let line = Line::AlongX(0.0);
    let search = Search::new(body, Side::Body2, grid, Some(line), &states).unwrap();
    let section = Section::new(body, Side::Body2, grid, line, states).unwrap();
    let depths = default_depths(body, a, 2.0 * a, 1.0).unwrap();
    let x: Vec<f64> = (0..grid.nx).map(|i| grid.x(i)).collect();
    let probe = Probe::find(of, "of").unwrap();
    let samples = find_measure(of)
        .unwrap()
        .on_lines(&section.stress(&depths).unwrap()[0]);
    let found = search.find_on_section(&probe, &samples.view(), (&depths, &x), layer);
    found.unwrap().unwrap()
}

fn scene(shape: Shape, lower: Body, mu: f64, grid: Grid, path: LoadPath) -> Scene {
    Scene {
        title: "largest".into(),
        body1: Body::homogeneous(STEEL, shape),
        body2: lower,
        friction: Friction::coulomb(mu),
        grid,
        path,
        settings: Settings::default(),
    }
}

/// A cylinder on a flat in plane strain, and its contact.
fn cylinder(mu: f64, n: usize, path: LoadPath) -> (Scene, LineContact) {
    let E_star = STEEL.E / 2.0 / (1.0 - STEEL.nu * STEEL.nu);
    let line = line_contact(R, E_star, 1e5);
    let shape = Shape::Cylinder {
        R,
        length: f64::INFINITY,
        angle: 0.0,
    };
    let grid = Grid::strip(2.6 * line.a, n, 1.0).unwrap();
    let flat = Body::homogeneous(STEEL, Shape::Flat);
    (scene(shape, flat, mu, grid, path), line)
}

/// s_xx on the surface under the shear q0 sqrt(1 - (x - e)^2/a^2), over q0.
fn under_hertz_shear(x: f64, e: f64, a: f64) -> f64 {
    let s = (x - e) / a;
    let beyond = (s * s - 1.0).max(0.0).sqrt();
    -2.0 * (s - s.signum() * beyond)
}

/// s_xx at both rims of a line contact, on first loading, after a reversal and with a bulk stress
/// in phase, within half a per cent of p_H on 64 to 1024 cells.
#[test]
fn rims_of_line_contacts_are_right_on_every_grid() {
    let (mu, W) = (0.6, 1e5);
    for bulk in [0.0, 0.1] {
        for n in [64, 65, 100, 128, 256, 512, 1024] {
            // The force and the bulk stress go up and back: the new slip zone is a tenth of the
            // half-width at one rim.
            let T = 0.6 * mu * W;
            let sigma = |line: &LineContact| bulk * 4.0 * mu * line.p0;
            let (bare, line) = cylinder(mu, n, LoadPath::start());
            let (s, back) = (sigma(&line), 1.0);
            let path = LoadPath::start()
                .normal(W, 1)
                .change_to(|to| (to.T_x, to.sigma_B) = (T, s), 1)
                .change_to(
                    |to| (to.T_x, to.sigma_B) = ((1.0 - back) * T, (1.0 - back) * s),
                    1,
                );
            let scene = Scene { path, ..bare };
            let ends = solved(&scene);
            let a = line.a;
            // A stick zone of the half-width c about e takes mu p0 c/a sqrt(1 - (x - e)^2/c^2) off
            // the shear mu p.
            let (c, e) = (a * (1.0_f64 - 0.6).sqrt(), a * bulk);
            let (c_2, e_2) = (
                a * (1.0_f64 - 0.6 * back / 2.0).sqrt(),
                a * bulk * back / 2.0,
            );
            let part = |x: f64, c: f64, e: f64| {
                under_hertz_shear(x, 0.0, a) - c / a * under_hertz_shear(x, e, c)
            };
            let first = |x: f64| mu * part(x, c, e);
            let second = |x: f64| first(x) - 2.0 * mu * part(x, c_2, e_2);
            let exact: [&dyn Fn(f64) -> f64; 2] = [&first, &second];
            for (branch, exact) in exact.into_iter().enumerate() {
                let fields = &ends[branch + 1];
                let states = [tractions(fields)];
                let stick = [fields.stick.as_slice().unwrap()];
                let rims = borders(&scene.grid, &states[0], Some(stick[0]), None).unwrap();
                let rims: Vec<_> = rims.iter().filter(|b| b.zone == Zone::Contact).collect();
                assert_eq!(rims.len(), 2, "{rims:?}");
                let states = States {
                    stick: Some(&stick),
                    ..States::from(&states)
                };
                let points = Points::new(&scene.body2, Side::Body2, &scene.grid, states).unwrap();
                let top = contact_subsurface::Depth { z: 0.0, layer: 0 };
                let mut off = [0.0; 2];
                for (off, rim) in off.iter_mut().zip(rims) {
                    let stress = points.stress(&[(rim.x, 0.0, top)]).unwrap()[0][0];
                    *off = stress[0] / line.p0 - exact(rim.x.signum() * a);
                }
                println!(
                    "bulk {bulk}, n = {n}, branch {}: rims off by {off:.4?} p_H",
                    branch + 1
                );
                let m = largest(&scene, fields, "s_xx", None);
                let right = [-a, a].map(exact).into_iter().fold(0.0, f64::max);
                if right > 0.2 {
                    let error = m.value / line.p0 - right;
                    println!("    largest {m:?}, off by {error:.4}");
                    assert!(error.abs() < 5e-3, "n = {n}: {m:?}");
                }
                assert!(off.iter().all(|o| o.abs() < 5e-3), "n = {n}: {off:?}");
            }
        }
    }
}

/// On a layer a few cells thick the square of the pressure bends next to the rim, outwards on soft
/// layers, inwards on hard ones: the rims are those of a grid eight times as fine.
#[test]
fn rims_on_layers_are_right_within_an_eighth_of_a_cell() {
    let n = 128;
    for (ratio, thickness) in [0.3, 0.5, 1.5, 4.0].into_iter().flat_map(|ratio| {
        let thicknesses = [0.04, 0.05, 0.08];
        thicknesses.map(|thickness| (ratio, thickness))
    }) {
        for k in 0..4 {
            let rims = [n, 8 * n].map(|n| {
                let (mut scene, line) = cylinder(0.0, n, LoadPath::start().normal(1e5, 1));
                let extent = 2.8 + 0.017 * f64::from(k);
                scene.grid = Grid::strip(extent * line.a, n, 1.0).unwrap();
                scene.body2.coatings = vec![Coating {
                    material: Elastic::new(ratio * STEEL.E, 0.25).unwrap(),
                    thickness: thickness * line.a,
                }];
                let fields = solved(&scene).remove(0);
                let rims = borders(&scene.grid, &tractions(&fields), None, None).unwrap();
                assert!(rims.len() == 2 && rims.iter().all(|rim| rim.within_cell));
                (rims[1].x, scene.grid.dx)
            });
            let [(rim, cell), (right, _)] = rims;
            let off = (rim - right) / cell;
            println!("E1/E2 = {ratio}, h = {thickness} a, {k}: off by {off:.3} cells");
            let allowed = if thickness < 0.06 { 0.06 } else { 0.125 };
            assert!(
                off.abs() < allowed,
                "E1/E2 = {ratio}, h = {thickness} a: {off}"
            );
        }
    }
}

/// A sphere on a coated flat without friction, against a dual integral equation and Hankel
/// quadrature.
#[test]
fn coated_spheres_agree_with_hankel_quadrature() {
    let file: Value =
        serde_json::from_str(include_str!("../../data/largest_stress_coated.json")).unwrap();
    let truths = file["cases"].as_array().unwrap();
    let slice = std::env::var("LARGEST").map_or(3, |n| n.parse().unwrap());
    for truth in truths.iter().take(slice) {
        let number = |key: &str| truth[key].as_f64().unwrap();
        let rigid = truth["rigid"].as_bool().unwrap();
        let upper = if rigid { Elastic::RIGID } else { STEEL };
        let h = hertz(R, upper, STEEL, 50.0);
        for n in [64, 128] {
            let coating = Coating {
                material: Elastic::new(number("ratio") * STEEL.E, number("nu")).unwrap(),
                thickness: number("h") * h.a,
            };
            let lower = Body {
                coatings: vec![coating],
                ..Body::homogeneous(STEEL, Shape::Flat)
            };
            let extent = 2.6 * number("a").max(1.0) * h.a;
            let grid = Grid::centred(extent, n).unwrap();
            let mut scene = scene(
                Shape::Sphere { R },
                lower,
                0.0,
                grid,
                LoadPath::start().normal(50.0, 1),
            );
            scene.body1.substrate = upper;
            let fields = solved(&scene).remove(0);
            for of in ["von_mises", "s_1"] {
                for layer in [None, Some(0)] {
                    let right = match layer {
                        None => truth[of][0].as_f64().unwrap(),
                        Some(layer) => truth[format!("{of}_layers")][layer][0].as_f64().unwrap(),
                    };
                    let m = largest(&scene, &fields, of, layer);
                    let (value, said) = (m.value / h.p0, m.error.total() / h.p0);
                    let off = value - right;
                    println!(
                        "E1/E2 = {}, h = {} a, n = {n}, {of}, {layer:?}: {value:.4} +- {said:.4}, right {right:.4}, off by {:.2} %",
                        number("ratio"),
                        number("h"),
                        100.0 * off / right
                    );
                    let tight = if n == 128 { 0.02 } else { 0.05 };
                    assert!(off.abs() <= f64::max(tight * right, 1.5 * said), "{m:?}");
                }
            }
        }
    }
}

/// A bare sphere pressed and sliding, on even and odd grids.
#[test]
fn a_bare_sphere_is_right_on_every_grid() {
    for mu in [0.0, 0.3] {
        let W = 50.0;
        let h = hertz(R, STEEL, STEEL, W);
        let closed = HertzStress {
            a: 1.0,
            nu: STEEL.nu,
        };
        for of in ["von_mises", "s_1"] {
            let measure: &Measure = find_measure(of).unwrap();
            let right = highest(|x, z| (measure.value)(&closed.sliding(1.0, mu, (x, 0.0, z))));
            for n in [32, 45, 64, 101, 128] {
                let flat = Body::homogeneous(STEEL, Shape::Flat);
                let grid = Grid::centred(2.47 * h.a, n).unwrap();
                let path = LoadPath::start().normal(W, 1);
                let scene = scene(Shape::Sphere { R }, flat, mu, grid, path);
                let mut fields = solved(&scene).remove(0);
                // It slides: the shear of like bodies does not change the pressure.
                fields.q_x = mu * &fields.p;
                fields.stick.fill(mu == 0.0);
                let m = largest(&scene, &fields, of, None);
                let (value, said) = (m.value / h.p0, m.error.total() / h.p0);
                println!("mu = {mu}, n = {n}, {of}: {value:.4} +- {said:.4}, right {right:.4}");
                assert!(
                    (value - right).abs() <= f64::max(0.02 * right, 1.5 * said),
                    "{m:?}"
                );
            }
        }
    }
}

/// The largest value of a closed form below a contact of radius 1.
fn highest(f: impl Fn(f64, f64) -> f64) -> f64 {
    let (mut best, mut at, mut step) = (f64::MIN, (0.0, 0.5), 0.04);
    for i in -40..=40 {
        for k in 0..40 {
            let (x, z) = (f64::from(i) * 0.05, 1e-9 + f64::from(k) * 0.04);
            if f(x, z) > best {
                (best, at) = (f(x, z), (x, z));
            }
        }
    }
    while step > 1e-7 {
        let beside = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)];
        let tried = beside.map(|(x, z)| (at.0 + x, (at.1 + z).max(1e-9)));
        match tried.into_iter().find(|at| f(at.0, at.1) > best) {
            Some(better) => (best, at) = (f(better.0, better.1), better),
            None => step /= 2.0,
        }
    }
    best
}

/// Lengths in another unit, forces with it: the same stress.
#[test]
fn the_unit_of_length_does_not_matter() {
    let values = |n: usize| {
        [1.0, 1e-3, 1e3].map(|unit: f64| {
            let W = 50.0 * unit * unit;
            let h = hertz(R * unit, STEEL, STEEL, W);
            let coating = Coating {
                material: Elastic { E: 630e9, nu: 0.25 },
                thickness: 0.06 * h.a,
            };
            let lower = Body {
                coatings: vec![coating],
                ..Body::homogeneous(STEEL, Shape::Flat)
            };
            let path = LoadPath::start().normal(W, 1).tangential(&[0.2 * W], 2);
            let grid = Grid::centred(2.6 * h.a, n).unwrap();
            let shape = Shape::Sphere { R: R * unit };
            let scene = scene(shape, lower, 0.4, grid, path);
            let fields = solved(&scene).pop().unwrap();
            largest(&scene, &fields, "von_mises", None).value
        })
    };
    for n in [20, 21, 32] {
        let [one, small, large] = values(n);
        println!("n = {n}: {one:e} {small:e} {large:e}");
        assert!((small / one - 1.0).abs() < 1e-6 && (large / one - 1.0).abs() < 1e-6);
    }
}
