//! Time to write a result store: fields kept, and a checkpoint after every increment.
#![allow(missing_docs)]

#[path = "../../contact-core/benches/rig/mod.rs"]
mod rig;

use std::time::Duration;

use contact_core::march::{Increment, March, Observer};
use contact_store::StoreWriter;
use criterion::{BatchSize, Criterion, SamplingMode, criterion_group, criterion_main};
use rig::{increments, paper_scene, stage};

fn store(c: &mut Criterion) {
    let mut group = stage(c, "output");
    group.sampling_mode(SamplingMode::Flat);
    let folder = std::env::temp_dir().join(format!("contact-core-output-{}", std::process::id()));
    for n in [64, 256] {
        let settings = [vec![format!("grid.n={n}")], increments([1; 6])].concat();
        let scene = paper_scene(&settings);
        let mut march = March::new(&scene).expect("a scene");
        let solved = std::iter::from_fn(|| march.advance()).collect::<Result<Vec<Increment>, _>>();
        let solved = solved.expect("a solution");
        for (name, interval) in [
            ("6_branches", Duration::MAX),
            ("6_branches_and_checkpoints", Duration::ZERO),
        ] {
            let writer = || {
                let writer = StoreWriter::create(folder.join(format!("{n}.zarr")), true);
                writer.expect("a folder").with_interval(interval)
            };
            group.bench_function(format!("{name}/{n}"), |b| {
                b.iter_batched_ref(
                    writer,
                    |writer| {
                        for increment in &solved {
                            let written = writer.on_increment(&march, increment);
                            written.expect("room on the disk");
                        }
                        writer.on_end(&march, None).expect("room on the disk");
                    },
                    BatchSize::PerIteration,
                );
            });
        }
    }
    std::fs::remove_dir_all(&folder).expect("a folder of its own");
}

criterion_group!(benches, store);
criterion_main!(benches);
