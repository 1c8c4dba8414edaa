//! Cycles, slow and fast, and what is refused.

use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

use contact_core::scene::Grid;
use contact_heat::{Conduction, Conductor, Cycle, Layers, temperature};
use ndarray::Array2;

use super::{A, STEEL, close, disc, grid, steel};

/// The heat q_0 (1 - cos 2 pi t) on a disc, in 40 increments.
fn pulsating(grid: &Grid, frequency: f64) -> (Vec<f64>, Vec<Array2<f64>>, Array2<bool>) {
    let shape = (grid.nx, grid.ny);
    let q = disc(grid).iter().map(|q| q.re).collect();
    let q = Array2::from_shape_vec(shape, q).expect("a number per cell");
    let ends: Vec<f64> = (1..=40).map(|n| f64::from(n) / 40.0).collect();
    let work = |t: f64| t - (2.0 * PI * t).sin() / (2.0 * PI);
    let heat = ends
        .iter()
        .map(|t| &q * ((work(*t) - work(t - 1.0 / 40.0)) / frequency));
    let contact = q.map(|q| *q > 0.0);
    (ends.clone(), heat.collect(), contact)
}

/// Slow cycles are quasi-steady, twice the mean when the heat is twice its mean; fast ones add the
/// swing of a plane wave, q/(K |s|).
#[test]
fn slow_and_fast_cycles() {
    let grid = grid(12);
    let diffusivity = STEEL.conductivity / STEEL.heat_capacity;
    let at = |frequency: f64| {
        let (ends, heat, contact) = pulsating(&grid, frequency);
        let cycle = Cycle {
            frequency,
            ends: &ends,
            heat: &heat,
            contact: &contact,
            jumps: false,
        };
        temperature(
            [&steel(), &steel()],
            [20.0, 20.0],
            &grid,
            &cycle,
            20,
            &AtomicBool::new(false),
        )
        .unwrap()
    };
    let half = 0.5;
    // Means over the increments and steps of constant heat each take sinc(pi/40) of the swing.
    let sampled = ((PI / 40.0).sin() / (PI / 40.0)).powi(2);

    let slow = at(1e-8 * diffusivity / (A * A));
    let mean = half * A / STEEL.conductivity;
    let centre = (grid.nx / 2, grid.ny / 2);
    close(slow.mean[0][centre] - 20.0, mean, 1e-3);
    close(slow.largest[0][centre] - 20.0, mean * (1.0 + sampled), 2e-3);
    let (hottest, _) = slow
        .peaks
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1))
        .unwrap();
    close(slow.instants[hottest], 0.5, 1e-12);

    let frequency = 1e3 * diffusivity / (A * A);
    let fast = at(frequency);
    close(fast.mean[1][centre] - 20.0, mean, 1e-3);
    let wave = (2.0 * PI * frequency / diffusivity).sqrt();
    let swing = half * sampled / (STEEL.conductivity * wave);
    close(fast.largest[1][centre] - fast.mean[1][centre], swing, 1e-3);
    close(fast.heat[centre], 1.0, 1e-12);
    close(fast.flux[centre], 0.5, 1e-12);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let said = |error: contact_core::Error| error.to_string();
    let bad = Conductor {
        conductivity: -1.0,
        ..STEEL
    };
    let text = said(Layers::new(&[bad], &[], "conductor1").unwrap_err());
    assert!(text.contains("conductor1[0].conductivity = -1"), "{text}");
    let text = said(Layers::new(&[STEEL], &[1e-6], "conductor2").unwrap_err());
    assert!(text.contains("2 layers"), "{text}");

    let strip = Grid::strip(1e-3, 16, 1e-3).unwrap();
    let text = said(Conduction::new(&steel(), &strip, 0.0).err().unwrap());
    assert!(text.contains("plane_strain"), "{text}");

    let grid = grid(2);
    let (ends, heat, contact) = pulsating(&grid, 1.0);
    let good = Cycle {
        frequency: 1.0,
        ends: &ends,
        heat: &heat,
        contact: &contact,
        jumps: false,
    };
    let refused = |cycle: &Cycle<'_>, bulk: f64, harmonics: usize| {
        let bodies = [&steel(), &steel()];
        said(
            temperature(
                bodies,
                [bulk, 0.0],
                &grid,
                cycle,
                harmonics,
                &AtomicBool::new(false),
            )
            .unwrap_err(),
        )
    };
    let nowhere = contact.map(|_| false);
    let mut backwards = ends.clone();
    backwards[3] = 0.01;
    let text = [
        refused(
            &Cycle {
                frequency: 0.0,
                ..good.clone()
            },
            0.0,
            1,
        ),
        refused(
            &Cycle {
                ends: &ends[1..],
                ..good.clone()
            },
            0.0,
            1,
        ),
        refused(
            &Cycle {
                ends: &backwards,
                ..good.clone()
            },
            0.0,
            1,
        ),
        refused(
            &Cycle {
                contact: &nowhere,
                ..good.clone()
            },
            0.0,
            1,
        ),
        refused(&good, f64::NAN, 1),
        refused(&good, 0.0, 1000),
    ];
    for (text, expected) in text.iter().zip([
        "frequency = 0",
        "ends = 39",
        "ends = [",
        "contact = no cell",
        "bulk temperature = NaN",
        "harmonics = 1000",
    ]) {
        assert!(text.contains(expected), "{text}");
    }
}
