//! No run takes more memory than `fret check` announces.
//!
//! `FRET_MEMORY` is the number of cells along a side of the largest grids, `FRET_MEMORY_REPORT` the
//! document for the numbers.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "../../contact-core/tests/document/mod.rs"]
mod document;

use std::alloc::System;
use std::fmt::Write;
use std::sync::Arc;

use cap::Cap;
use contact_core::Scene;
use contact_core::estimate::{BranchEnds, ErrorMethod, choose_increments, error_bars, finest};
use contact_core::kernels::clear_cache;
use contact_core::march::solve;
use contact_core::plan::Plan;
use contact_store::StoreWriter;

#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, usize::MAX);

/// A coated contact with friction; its grid is nested.
const COATED: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 64, extent = { a_H = 2.4 } }
path = [{ W = 1000.0, increments = 2 }, { T_x = { mu_W = 0.5 }, increments = 2 }]
[body2]
shape = "flat"
E = 210e9
nu = 0.3
coatings = [{ E = { E_substrate = 2.0 }, nu = 0.3, thickness = { a_H = 1.0 } }]
"#;

/// Settings, and whether the errors of the cells are asked for.
const RUNS: [(&[&str], bool); 8] = [
    (&[], false),
    (&["skip.mirror=false"], false),
    (&["body2.coatings=[]"], false),
    (&["body2.coatings=[]", "skip.mirror=false"], false),
    (
        &["friction.mu=0.0", "path=[{ W = 1000.0, increments = 2 }]"],
        false,
    ),
    (
        &[
            "solver.path_tolerance=0.03",
            "path=[{ W = 1000.0 }, { T_x = { mu_W = 0.5 } }]",
        ],
        false,
    ),
    (&[], true),
    (
        &["kernel.method={ frequency_domain = { lambda = 2 } }"],
        false,
    ),
];

#[test]
fn a_run_takes_no_more_memory_than_announced() {
    let largest = std::env::var("FRET_MEMORY").map_or(256, |n| n.parse().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let mut scenes = Vec::new();
    for n in [64, 128, 256, 512, 1024]
        .into_iter()
        .filter(|n| *n <= largest)
    {
        for (settings, bars) in RUNS {
            let grid = format!("grid.n={n}");
            let settings: Vec<_> = settings
                .iter()
                .map(ToString::to_string)
                .chain([grid])
                .collect();
            let scene = Scene::from_toml_str(COATED, "coated.toml", &settings).unwrap();
            let memory = |scene: &Scene| Plan::new(scene).memory(scene);
            let finest = finest(&scene).filter(|_| bars);
            let announced = memory(&scene) + finest.as_ref().map_or(0.0, memory);
            scenes.push((announced, scene, bars, format!("`{}`", settings.join(" "))));
        }
    }
    let mut table =
        String::from("| scene | announced, MB | allocated at most, MB |\n|---|---|---|\n");
    // The allocator knows the peak since the beginning alone.
    scenes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut before, mut over) = (0.0, Vec::new());
    for (run, (announced, scene, bars, settings)) in scenes.into_iter().enumerate() {
        clear_cache();
        let mut writer = StoreWriter::create(folder.path().join(run.to_string()), false).unwrap();
        let mut ends = BranchEnds::new(&mut writer);
        let scene = choose_increments(&scene, &Arc::default()).unwrap();
        let increments = solve(&scene, &mut ends).unwrap();
        let tractions = ends.tractions;
        if bars {
            error_bars(
                &scene,
                &increments,
                &tractions,
                ErrorMethod::FinerGrid,
                &Arc::default(),
            )
            .unwrap();
        }
        let (taken, announced) = (MEMORY.max_allocated() as f64 / 1e6, announced / 1e6);
        if taken > before {
            let bars = if bars { ", error bars" } else { "" };
            let _ = writeln!(table, "| {settings}{bars} | {announced:.0} | {taken:.0} |");
        }
        before = taken;
        if taken > announced {
            over.push(settings);
        }
    }
    println!("{table}");
    assert!(over.is_empty(), "{over:?}");
    if let Ok(document) = std::env::var("FRET_MEMORY_REPORT") {
        document::insert(&document, "memory", &table);
    }
}
