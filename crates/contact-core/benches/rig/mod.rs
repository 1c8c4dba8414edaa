//! What the benches share: the paper's scene with other settings, and how long to measure.
#![allow(dead_code)]

use std::time::Duration;

use contact_core::Scene;
use contact_core::march::{March, State};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};

/// The paper's scene with the settings given, as on the command line of `fret`.
pub(crate) fn paper_scene(settings: &[String]) -> Scene {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenes/coated_fretting.toml"
    );
    Scene::from_file(file, settings).expect("the paper's scene")
}

/// Settings that give the branches of the paper's path so many increments.
pub(crate) fn increments(counts: [usize; 6]) -> Vec<String> {
    let of_branch = |(branch, count)| format!("path.{branch}.increments={count}");
    counts.iter().enumerate().map(of_branch).collect()
}

/// The state after that many increments of a scene.
pub(crate) fn state_after(scene: &Scene, increments: usize) -> State {
    let mut march = March::new(scene).expect("a scene");
    for _ in 0..increments {
        let increment = march.advance().expect("an increment");
        increment.expect("a solution");
    }
    march.state().clone()
}

/// A stage of the pipeline; every bench in it takes about two seconds, the first part of which
/// lets the processor raise its clock.
pub(crate) fn stage<'a>(c: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = c.benchmark_group(name);
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(700))
        .measurement_time(Duration::from_millis(1200));
    group
}
