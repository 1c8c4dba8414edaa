//! Time of the stress below the surface, from tractions to components.
#![allow(missing_docs)]

mod rig;

use contact_core::convolution::Tractions;
use contact_core::fields::{Line, Section, Side, Slices, depths};
use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use rig::{paper_scene, stage};

fn stress(c: &mut Criterion) {
    let mut group = stage(c, "fields");
    group.sampling_mode(SamplingMode::Flat);
    for n in [64, 256] {
        let scene = paper_scene(&[format!("grid.n={n}")]);
        let (body, grid) = (&scene.body2, &scene.grid);
        let hertz = scene.hertz().expect("a Hertz contact");
        let p = grid.map(|x, y| hertz.p(x.hypot(y)));
        let q_x = scene.friction.mu * &p;
        let tractions = Tractions {
            q_x: q_x.as_slice(),
            q_y: None,
            p: p.as_slice(),
        };
        let to = |count: usize| -> Vec<f64> {
            let step = 2.0 * hertz.a / (count as f64 - 1.0);
            (0..count).map(|i| i as f64 * step).collect()
        };
        let of_section = depths(body, &to(64)).expect("depths");
        group.bench_function(format!("section/64_depths/{n}"), |b| {
            b.iter(|| {
                Section::new(body, Side::Body2, grid, Line::AlongX(0.0), &[tractions])
                    .and_then(|section| section.stress(&of_section))
                    .expect("a stress")
            });
        });
        let of_volume = depths(body, &to(8)).expect("depths");
        group.bench_function(format!("volume/8_depths/{n}"), |b| {
            b.iter(|| {
                Slices::new(body, Side::Body2, grid, &[tractions])
                    .and_then(|s| s.map_stress(&of_volume, |_, s| Ok(s[0][2].sum())))
                    .expect("a stress")
            });
        });
    }
}

criterion_group!(benches, stress);
criterion_main!(benches);
