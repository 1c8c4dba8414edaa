//! Time of one solution: pressure alone, shear alone, and an increment of both.
//!
//! Each is an increment of a scene that needs nothing else: without friction there is no shear, and
//! where the bodies are similar and W is constant the pressure stays.
#![allow(missing_docs)]

mod rig;

use contact_core::Scene;
use contact_core::march::{Increment, March};
use criterion::measurement::WallTime;
use criterion::{BatchSize, BenchmarkGroup, Criterion, criterion_group, criterion_main};
use rig::{increments, paper_scene, stage, state_after};

/// Benches the increment of `scene` that follows `done` others; the march is made anew for each.
fn bench_increment(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    scene: &Scene,
    done: usize,
) {
    let state = state_after(scene, done);
    let march = || March::resume(scene, state.clone()).expect("a state of the scene");
    group.bench_function(name, |b| {
        b.iter_batched_ref(march, advance, BatchSize::PerIteration);
    });
}

fn advance(march: &mut March) -> Increment {
    let increment = march.advance().expect("an increment");
    increment.expect("a solution")
}

fn with(settings: &[String], n: usize, more: &[&str]) -> Scene {
    let grid = format!("grid.n={n}");
    let more = more.iter().map(ToString::to_string);
    paper_scene(
        &settings
            .iter()
            .cloned()
            .chain([grid])
            .chain(more)
            .collect::<Vec<_>>(),
    )
}

fn normal(c: &mut Criterion) {
    let mut group = stage(c, "normal");
    let one_each = increments([1; 6]);
    for n in [64, 256, 1024] {
        let scene = with(&one_each, n, &["friction.mu=0"]);
        bench_increment(&mut group, &format!("coated/{n}"), &scene, 0);
    }
}

fn tangential(c: &mut Criterion) {
    let mut group = stage(c, "tangential");
    let one_each = increments([1; 6]);
    let similar = ["body2.coatings.0.E.E_substrate=1"];
    for n in [64, 256, 1024] {
        let scene = with(&one_each, n, &similar);
        bench_increment(&mut group, &format!("similar/{n}"), &scene, 1);
    }
}

fn increment(c: &mut Criterion) {
    let mut group = stage(c, "increment");
    let tenth = increments([10, 10, 20, 20, 20, 20]);
    let plain = "solver.preset=\"spinu2020\"";
    for (name, n, more) in [
        ("64", 64, &[][..]),
        ("256", 256, &[]),
        ("spinu2020/64", 64, &[plain]),
    ] {
        let scene = with(&tenth, n, more);
        bench_increment(&mut group, &format!("indentation/{name}"), &scene, 5);
        bench_increment(&mut group, &format!("partial_slip/{name}"), &scene, 30);
    }
}

criterion_group!(solvers, normal, tangential, increment);
criterion_main!(solvers);
