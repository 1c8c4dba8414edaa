//! What holds for every wear scene, whatever its laws, strokes, layers and jumps.

use std::sync::Arc;

use contact_core::scene::{Coating, Elastic, Friction, Grid, Scene, Shape};
use contact_core::wear::{
    Archard, BodyWear, Cycling, DissipatedEnergy, Jumps, Wear, WearRun, WornThrough,
};

use crate::bench::{archard, cylinder, pulled, scene, to_and_fro, wear};
use crate::splitmix::Draw;

/// Steps through a run and checks every jump; `volume_per_energy` of body 1 and 2 where that is known.
fn audit(name: &str, scene: &Scene, wear: &Wear, volume_per_energy: Option<[f64; 2]>) {
    let mut run =
        WearRun::new(scene, wear, &Arc::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut last = run.block();
    let (mut volume, mut energy) = ([0.0; 2], 0.0);
    while let Some(jump) = run.advance() {
        let jump = jump.unwrap_or_else(|e| panic!("{name}: {e}"));
        let now = run.block();
        for (before, now) in [(&last.worn1, &now.worn1), (&last.worn2, &now.worn2)] {
            let grows = before
                .iter()
                .zip(now)
                .any(|(a, b)| !(b >= a && b.is_finite()));
            assert!(!grows, "{name}: something grows in jump {}", jump.index);
        }
        let W: f64 = now.p.sum() * scene.grid.cell_area();
        let asked = scene.path.branches[0].to.W;
        assert!(now.p.iter().all(|p| *p >= 0.0), "{name}: p < 0");
        assert!((W / asked - 1.0).abs() < 1e-6, "{name}: W = {W}");
        let sums = [now.worn1.sum(), now.worn2.sum()].map(|s| s * scene.grid.cell_area());
        for b in 0..2 {
            assert!((sums[b] - jump.volume[b]).abs() <= 1e-9 * sums[b], "{name}");
            if let Some(per) = volume_per_energy {
                let (lost, spent) = (jump.volume[b] - volume[b], jump.dissipated - energy);
                let off = (lost - per[b] * spent).abs();
                assert!(
                    off <= 1e-9 * jump.volume[b].max(lost),
                    "{name}: {lost:e} m^3, {spent:e} J"
                );
            }
        }
        (volume, energy, last) = (jump.volume, jump.dissipated, now);
    }
}

#[test]
fn worn_volume_is_alpha_times_the_energy_of_every_jump() {
    let energy = |alpha| {
        BodyWear::of(DissipatedEnergy {
            alpha,
            threshold: 0.0,
        })
    };
    let line = Grid::strip(0.5e-3, 128, 1.0).unwrap();
    let slides = scene(cylinder(6e-3), line, to_and_fro(18.5e3, 20e-6, 4), 0.9);
    let alphas = [2e-14, 3e-14];
    audit(
        "sliding",
        &slides,
        &wear(alphas.map(energy), 2e3, Cycling::Sliding),
        Some(alphas),
    );
    let laws = [archard(2e-14), archard(3e-14)];
    let per = alphas.map(|k| k / 0.9);
    audit(
        "Archard",
        &slides,
        &wear(laws, 2e3, Cycling::Sliding),
        Some(per),
    );
    let round = Grid::centred(0.5e-3, 16).unwrap();
    let mut sticks = scene(
        Shape::Sphere { R: 10e-3 },
        round,
        pulled(50.0, 20.0, 4),
        0.6,
    );
    let mut marched = wear(alphas.map(energy), 2e4, Cycling::March);
    marched.jumps = Jumps::Number(4);
    audit("march", &sticks, &marched, Some(alphas));
    // Unlike bodies, coupled.
    sticks.body1.substrate = Elastic { E: 400e9, nu: 0.2 };
    audit("coupled", &sticks, &marched, Some(alphas));
    marched.bodies = [archard(2e-14), archard(3e-14)];
    audit(
        "coupled, Archard",
        &sticks,
        &marched,
        Some(alphas.map(|k| k / 0.6)),
    );
}

#[test]
fn random_wear_is_sound() {
    let scenes = std::env::var("FRET_WEAR").map_or(24, |n| n.parse().unwrap());
    let mut draw = Draw(11);
    for i in 0..scenes {
        let (slides, flat) = (draw.next() < 0.8, draw.next() < 0.7);
        let W = draw.between(0.2, 5.0) * if flat { 1e4 } else { 20.0 };
        let mu = draw.between(0.05, 1.5);
        let n = [16, 24, 32][(3.0 * draw.next()) as usize];
        let grid = if flat {
            Grid::strip(1.2e-3, 3 * n, 1.0).unwrap()
        } else {
            Grid::centred(1.2e-3, n).unwrap()
        };
        let path = if slides {
            to_and_fro(
                W,
                draw.between(1e-7, 5e-5),
                1 + (4.0 * draw.next()) as usize,
            )
        } else {
            pulled(W, draw.between(0.1, 0.95) * mu * W, 2)
        };
        let shape = if flat {
            cylinder(6e-3)
        } else {
            Shape::Sphere { R: 10e-3 }
        };
        let mut scene = scene(shape, grid, path, mu);
        scene.friction = Friction::coulomb(mu);
        if draw.next() < 0.5 {
            let material = Elastic {
                E: draw.between(50e9, 600e9),
                nu: 0.1 + 0.3 * draw.next(),
            };
            scene.body2.coatings = vec![Coating {
                material,
                thickness: draw.between(1e-7, 1e-4),
            }];
        }
        let mut law = || {
            let size = draw.between(1e-16, 1e-12);
            match (4.0 * draw.next()) as usize {
                0 => BodyWear::default(),
                1 => BodyWear::of(Archard {
                    k: size,
                    threshold: draw.between(1e-9, 1e-6),
                }),
                2 => BodyWear::of(DissipatedEnergy {
                    alpha: size,
                    threshold: draw.between(1.0, 1e4),
                }),
                _ => archard(size),
            }
        };
        let mut bodies = [law(), law()];
        if bodies.iter().all(|b| b.laws.is_empty()) {
            bodies[1] = archard(1e-14);
        }
        // Until the scar is about as deep as the bodies have come together, at the most; then the same
        // cycles in jumps that are far too long.
        let cycling = if slides {
            Cycling::Sliding
        } else {
            Cycling::March
        };
        let mut wear = wear(bodies, draw.between(1.0, 1e3), cycling);
        wear.worn_through = WornThrough::GoOn;
        wear.jumps = match (3.0 * draw.next()) as usize {
            0 => Jumps::Number(1),
            1 => Jumps::Number(3),
            _ => Jumps::Tolerance(0.1),
        };
        audit(&format!("scene {i}"), &scene, &wear, None);
    }
}

#[test]
fn a_jump_that_is_far_too_long_is_as_sound_as_a_short_one() {
    let line = Grid::strip(1.2e-3, 96, 1.0).unwrap();
    let slides = scene(cylinder(6e-3), line, to_and_fro(18.5e3, 20e-6, 3), 0.9);
    let laws = [archard(2e-14), archard(3e-14)];
    let mut once = wear(laws, 1e5, Cycling::Sliding);
    once.jumps = Jumps::Number(1);
    let per = [2e-14, 3e-14].map(|k| k / 0.9);
    audit("one jump", &slides, &once, Some(per));
}
