//! The heat of a run as a cycle: temperatures of both surfaces that agree where the bodies touch,
//! warm by all the energy that friction took, and those of the bodies exchanged.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::scene::{Body, Grid, Scene};
use contact_heat::{Conductor, Cycle, Layers, Temperature, temperature};
use fastrand::Rng;
use ndarray::Array2;

use super::campaign::End;
use super::draw::ROLLED;

/// Every so many scenes are warmed by their friction.
const EVERY: u64 = 8;
/// Cells and harmonics at most.
const CELLS: usize = 96 * 96;
const HARMONICS: usize = 6;
/// Largest difference of temperatures that should be the same, over the largest rise: the solver
/// leaves 1e-9 in the root mean square.
const SAME: f64 = 1e-6;

/// Whether the heat of a scene is followed: not of one that rolls, whose sources would move.
pub(crate) fn is_warmed(seed: u64) -> bool {
    seed % EVERY == 3 && seed < ROLLED
}

/// Warms the bodies of a run; what is wrong, in words.
pub(crate) fn warmed(
    seed: u64,
    scene: &Scene,
    end: &End,
    stop: &Arc<AtomicBool>,
) -> Result<(), String> {
    let (grid, count) = (&scene.grid, end.dissipated.len());
    let last = end.dissipated.last().filter(|_| grid.cells() <= CELLS);
    let Some(last) = last.filter(|last| last.iter().any(|d| *d > 0.0)) else {
        return Ok(());
    };
    let rng = &mut Rng::with_seed(seed);
    let frequency = 10f64.powf(4.0 * rng.f64() - 2.0);
    let bodies = [&scene.body1, &scene.body2].map(|body| layers(rng, body));
    let heat: Vec<Array2<f64>> = (0..count)
        .map(|n| match n.checked_sub(1) {
            Some(before) => &end.dissipated[n] - &end.dissipated[before],
            None => end.dissipated[0].clone(),
        })
        .collect();
    let ends: Vec<f64> = (1..=count).map(|n| n as f64 / count as f64).collect();
    let contact = ndarray::Zip::from(last)
        .and(&end.fields.contact)
        .map_collect(|dissipated, touches| *dissipated != 0.0 || *touches);
    let cycle = Cycle {
        frequency,
        ends: &ends,
        heat: &heat,
        contact: &contact,
        jumps: false,
    };
    let answer = |bodies: [&Layers; 2]| -> Result<Temperature, String> {
        let told = |error: Error| format!("heat: {error}");
        temperature(bodies, [0.0; 2], grid, &cycle, HARMONICS.min(count), stop).map_err(told)
    };
    let [one, two] = &bodies;
    let (found, exchanged) = (answer([one, two])?, answer([two, one])?);
    let taken: f64 = end.increments.iter().map(|i| i.energy.dissipated).sum();
    audited(grid, &cycle, &found, frequency * taken)?;
    let hottest = most(&found.mean[0]).max(most(&found.mean[1]));
    for (n, field) in found.mean.iter().chain(&found.largest).enumerate() {
        let theirs = [&exchanged.mean, &exchanged.largest][n / 2];
        let off = most(&(field - &theirs[1 - n % 2]).mapv(f64::abs));
        let scale = hottest.max(most(field));
        if off > SAME * scale {
            return Err(format!(
                "heat: exchanged bodies differ by {off:e} of {scale:e}"
            ));
        }
    }
    Ok(())
}

/// All heat flows, warms, and as much as friction set free: `power` \[W\].
fn audited(grid: &Grid, cycle: &Cycle<'_>, found: &Temperature, power: f64) -> Result<(), String> {
    let [one, two] = &found.mean;
    let fields = [
        one,
        two,
        &found.largest[0],
        &found.largest[1],
        &found.heat,
        &found.flux,
    ];
    if !fields.iter().all(|f| f.iter().all(|v| v.is_finite())) {
        return Err("heat: not a number".into());
    }
    let flows = found.heat.sum() * grid.cell_area();
    if (flows - power).abs() > 1e-9 * power.abs() {
        return Err(format!("heat: {flows:e} W flow of {power:e} W"));
    }
    let hottest = most(one).max(most(two));
    let touching = cycle.contact.iter().zip(one.iter().zip(two));
    let apart = touching.filter(|(touches, _)| **touches);
    let apart = apart.fold(0.0_f64, |worst, (_, (a, b))| worst.max((a - b).abs()));
    if apart > SAME * hottest {
        return Err(format!(
            "heat: surfaces that touch differ by {apart:e} of {hottest:e}"
        ));
    }
    let coldest = -most(&-one).max(most(&-two));
    if coldest < -SAME * hottest {
        return Err(format!(
            "heat: friction cools by {coldest:e} of {hottest:e}"
        ));
    }
    for (mean, largest) in found.mean.iter().zip(&found.largest) {
        let below = most(&(mean - largest));
        if below > SAME * hottest {
            return Err(format!(
                "heat: the largest is {below:e} below the mean, {hottest:e}"
            ));
        }
    }
    Ok(())
}

fn most(field: &Array2<f64>) -> f64 {
    field.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// Conductors drawn for the layers of a body, from a plastic to copper.
fn layers(rng: &mut Rng, body: &Body) -> Layers {
    let mut conductor = || Conductor {
        conductivity: 10f64.powf(-0.5 + 3.1 * rng.f64()),
        heat_capacity: 1e6 * (1.0 + 3.0 * rng.f64()),
    };
    let conductors: Vec<_> = (0..=body.coatings.len()).map(|_| conductor()).collect();
    let thicknesses: Vec<f64> = body.coatings.iter().map(|c| c.thickness).collect();
    Layers::new(&conductors, &thicknesses, "body").unwrap()
}
