//! What holds for every wear scene, whatever its laws, strokes, layers and jumps.

use contact_core::scene::{Elastic, Grid, Scene, Shape};
use contact_wear::{BodyWear, Cycling, DissipatedEnergy, Jumps, Wear};

use crate::audit::Audit;
use crate::bench::{archard, cylinder, pulled, scene, to_and_fro, wear};

/// Steps through a run and checks every jump.
fn audit(name: &str, scene: &Scene, wear: &Wear, per_energy: Option<[f64; 2]>) {
    let jumps = Audit::new(name, scene, wear, per_energy).run(wear);
    jumps.unwrap_or_else(|e| panic!("{name}: {e}"));
}

#[test]
fn worn_volume_is_alpha_times_the_energy_of_every_jump() {
    let energy = |alpha| {
        BodyWear::with_law(DissipatedEnergy {
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
    // What stays in the contact changes the gap, not the balance.
    marched.debris_kept = 0.8;
    audit("debris", &sticks, &marched, Some(alphas));
    marched.debris_kept = 0.0;
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
fn a_jump_that_is_far_too_long_is_as_sound_as_a_short_one() {
    let line = Grid::strip(1.2e-3, 96, 1.0).unwrap();
    let slides = scene(cylinder(6e-3), line, to_and_fro(18.5e3, 20e-6, 3), 0.9);
    let laws = [archard(2e-14), archard(3e-14)];
    let mut once = wear(laws, 1e5, Cycling::Sliding);
    once.jumps = Jumps::Number(1);
    let per = [2e-14, 3e-14].map(|k| k / 0.9);
    audit("one jump", &slides, &once, Some(per));
}
