//! Time of whole load paths, kernels included after the first.
#![allow(missing_docs)]

mod rig;

use std::sync::Arc;

use contact_core::estimate::choose_increments;
use contact_core::march::solve;
use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use rig::{increments, paper_scene, stage};

fn march(c: &mut Criterion) {
    let mut group = stage(c, "march");
    group.sampling_mode(SamplingMode::Flat);
    let path = increments([20, 20, 40, 40, 40, 40]);
    for (name, n, ratio) in [
        ("coated/200_increments/64", 64, 2.0),
        ("coated/200_increments/128", 128, 2.0),
        ("similar/200_increments/64", 64, 1.0),
    ] {
        let settings = [
            format!("grid.n={n}"),
            format!("body2.coatings.0.E.E_substrate={ratio:.1}"),
        ];
        let scene = paper_scene(&[&settings, &path[..]].concat());
        group.bench_function(name, |b| {
            b.iter(|| solve(&scene, &mut ()).expect("a solution"));
        });
    }
}

/// Scenes per second of a study: increments chosen, the path run.
fn scenes(c: &mut Criterion) {
    let mut group = stage(c, "scenes");
    group.sampling_mode(SamplingMode::Flat);
    group.throughput(Throughput::Elements(1));
    for n in [32, 64] {
        let mut settings = vec![format!("grid.n={n}")];
        settings.extend((0..6).map(|branch| format!("path.{branch}.increments=\"auto\"")));
        let scene = paper_scene(&settings);
        group.bench_function(format!("coated/chosen/{n}"), |b| {
            b.iter(|| {
                let chosen = choose_increments(&scene, &Arc::default()).expect("a path");
                solve(&chosen, &mut ()).expect("a solution")
            });
        });
    }
}

criterion_group!(benches, march, scenes);
criterion_main!(benches);
