//! Time of whole load paths, kernels included after the first.
#![allow(missing_docs)]

mod rig;

use contact_core::march::solve;
use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
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

criterion_group!(benches, march);
criterion_main!(benches);
