//! Time to compute kernels: what a scene waits for before its first increment.
#![allow(missing_docs)]

mod rig;

use std::hint::black_box;

use contact_core::kernels::{clear_cache, influence_coefficients, stress_coefficients};
use contact_core::scene::{Body, Coating, Elastic, Grid, KernelMethod, KernelSettings, Shape};
use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };
/// The contact radius of the paper's scene \[m\].
const A_H: f64 = 4.890_973e-4;

/// Layers of one contact radius in all, their moduli up and down.
fn body(layers: usize) -> Body {
    let coating = |i: usize| Coating {
        material: Elastic {
            E: 210e9 * (2.0 + 0.1 * (i % 7) as f64),
            nu: 0.2 + 0.01 * (i % 5) as f64,
        },
        thickness: A_H / layers as f64,
    };
    Body {
        substrate: STEEL,
        coatings: (0..layers).map(coating).collect(),
        bonds: Vec::new(),
        plastic: Vec::new(),
        residual: Vec::new(),
        hardness: f64::INFINITY,
        shape: Shape::Flat,
        bulk: contact_core::scene::Bulk::default(),
    }
}

fn grid(n: usize) -> Grid {
    Grid::centred(2.4 * A_H, n).expect("a positive extent")
}

fn surface(c: &mut Criterion) {
    let mut group = rig::stage(c, "kernels");
    group.sampling_mode(SamplingMode::Flat);
    for (name, layers, n) in [
        ("homogeneous/256", 0, 256),
        ("coated/256", 1, 256),
        ("20_layers/256", 20, 256),
        ("coated/1024", 1, 1024),
    ] {
        let (body, grid) = (body(layers), grid(n));
        let settings = KernelSettings::default();
        group.bench_function(name, |b| {
            b.iter(|| {
                clear_cache();
                influence_coefficients(black_box(&body), &grid, &settings, true, None)
            });
        });
    }
    for (name, lambda, aliases) in [
        ("inverse_fft_2/256", 2, 0),
        ("inverse_fft_8/256", 8, 0),
        ("inverse_fft_8_aliases_1/256", 8, 1),
    ] {
        let (body, grid) = (body(1), grid(256));
        let settings = KernelSettings {
            method: KernelMethod::InverseFft { lambda, aliases },
            ..KernelSettings::default()
        };
        group.bench_function(name, |b| {
            b.iter(|| {
                clear_cache();
                influence_coefficients(black_box(&body), &grid, &settings, true, None)
            });
        });
    }
    group.finish();
}

fn stress(c: &mut Criterion) {
    let mut group = rig::stage(c, "kernels");
    group.sampling_mode(SamplingMode::Flat);
    for (name, z) in [
        ("stress/coating/256", 0.5 * A_H),
        ("stress/substrate/256", 1.5 * A_H),
    ] {
        let (body, grid) = (body(1), grid(256));
        group.bench_function(name, |b| {
            b.iter(|| stress_coefficients(black_box(&body), &grid, z, None, None));
        });
    }
    group.finish();
}

criterion_group!(kernels, surface, stress);
criterion_main!(kernels);
