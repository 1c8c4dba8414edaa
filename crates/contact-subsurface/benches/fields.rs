//! Stress below the paper's contact: 256 x 256 tractions, kernels included.

#![allow(missing_docs, clippy::unwrap_used)]

#[path = "../tests/stressed/mod.rs"]
mod stressed;

use std::hint::black_box;

use contact_subsurface::{Line, Points, Section, Side, Slices};
use criterion::{Criterion, criterion_group, criterion_main};
use rayon::prelude::*;
use stressed::{Contact, coated};

fn section(c: &mut Criterion) {
    let mut group = c.benchmark_group("fields");
    group.sample_size(10);
    let Contact { body, grid, .. } = coated(256);
    let contact = coated(256);
    for (name, n) in [("section/256/1", 1), ("section/256/256", 256)] {
        let depths = contact.depths(n);
        group.bench_function(name, |b| {
            b.iter(|| {
                let line = Line::AlongX(0.0);
                let states = [contact.tractions()];
                let section = Section::new(black_box(&body), Side::Body2, &grid, line, &states);
                section.unwrap().stress(&depths)
            });
        });
    }
    let depths = contact.depths(3);
    group.bench_function("slices/256/3", |b| {
        b.iter(|| {
            let slices =
                Slices::new(black_box(&body), Side::Body2, &grid, &[contact.tractions()]).unwrap();
            depths
                .par_iter()
                .map(|depth| slices.stress(*depth).map(|s| s[0][2][(128, 128)]))
                .collect::<Result<Vec<_>, _>>()
        });
    });
    group.bench_function("points/256/1", |b| {
        let points =
            Points::new(black_box(&body), Side::Body2, &grid, &[contact.tractions()]).unwrap();
        b.iter(|| points.stress(&[(0.0, 0.0, depths[1])]));
    });
    group.finish();
}

criterion_group!(fields, section);
criterion_main!(fields);
