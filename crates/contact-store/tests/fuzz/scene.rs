//! Scene files.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use contact_core::kernels::clear_cache;
use contact_core::march::March;
use contact_core::{Error, Scene};
use proptest::prelude::*;
use proptest::sample::select;

use crate::mutate::{apply, change};

/// Good scenes, between them most keys.
const SCENES: [&str; 3] = [
    r#"
schema = 1
title = "Coated"
[body1]
shape.sphere.R = 0.018
E = 210e9
nu = 0.3
[body2]
shape = "flat"
E = 70e9
nu = 0.2
[[body2.coatings]]
E = { E_substrate = 2.0 }
nu = 0.3
thickness = { a_H = 1.0 }
[friction]
mu = 0.3
[grid]
n = [9, 8]
extent = { a_H = 3.0 }
[[path]]
W = 1000.0
increments = 2
t = 0.1
spacing = "equal_radius"
[[path]]
T_x = { mu_W = 0.9 }
T_y = 10.0
increments = 2
"#,
    r#"
schema = 1
body1 = { shape = { cylinder = { R = 0.01, length = 0.0004, angle = 0.1 }, waviness = { amplitude = 1e-7, wavelength = 5e-5 } }, E = "rigid" }
body2 = { shape = { rough = { rms = 1e-7, hurst = 0.8, longest = 4e-4, shortest = 2e-4, seed = 3 } }, E = 210e9, nu = 0.3 }
friction.mu = 0.5
grid = { n = 10, spacing = [1e-4, 9e-5] }
path = [
    { delta_z = 1e-6, increments = 1 },
    { M_z = 1e-3, increments = 2 },
    { delta_x = 1e-7, phi_y = 1e-5, increments = 1 },
]
"#,
    r#"
schema = 1
body1 = { shape = { sum = [{ flat_punch = { radius = 5e-4, edge = 0.01 } }, { height_map = { spacing = 1e-3, z = [[0.0, 1e-6], [0.0, 0.0]] } }] }, E = 2e11, nu = 0.3 }
body2 = { shape = { ellipsoid = { R_x = 0.1, R_y = 0.2 } }, E = 1e9, nu = 0.4999 }
friction.mu = 0.1
grid = { n = 8, extent = 1.5e-3 }
path = [{ W = 0.1, increments = 1 }, { T_x = 0.009, increments = 1 }, { W = 0.0, T_x = 0.0, increments = 1 }]
kernel = { method = { inverse_fft = { lambda = 2, aliases = 1 } }, tolerance = 1e-8 }
solver = { preset = "spinu2020", tolerance = 1e-4, max_alternations = 20, max_iterations = 200 }
skip = { equal_layers = false, coupling = false, mirror = false }
output.save = [1, 2]
"#,
];

/// Cells and increments up to which a scene is solved.
const CELLS: usize = 400;
const INCREMENTS: usize = 8;

#[test]
#[ignore = "slow"]
fn scene_files() {
    for text in SCENES {
        assert!(take(text).unwrap(), "the scenes are good ones");
    }
    let texts = (select(&SCENES), prop::collection::vec(change(), 1..4));
    let texts = texts.prop_map(|(text, changes)| {
        let mut bytes = text.as_bytes().to_vec();
        for change in &changes {
            apply(&mut bytes, change);
        }
        String::from_utf8_lossy(&bytes).into_owned()
    });
    crate::fuzz("scene files", texts, |text| match take(text) {
        Ok(_) => true,
        Err(error) => {
            crate::a_sentence_each(&error);
            false
        }
    });
}

/// Reads a scene, writes it back, and solves it if it is small; whether it was.
fn take(text: &str) -> Result<bool, Error> {
    let scene = Scene::from_toml_str(text, "fuzz.toml", &[])?;
    let again = Scene::from_toml_str(&scene.to_toml(), "again.toml", &[]).unwrap();
    assert_eq!(again, scene);
    let plan = contact_core::plan::Plan::new(&scene);
    let small = scene.grid.cells() <= CELLS && scene.path.increments() <= INCREMENTS;
    if !(small && plan.memory(&scene) < crate::ANNOUNCED) {
        return Ok(false);
    }
    let stop = Arc::<AtomicBool>::default();
    let (done, watched) = channel::<()>();
    thread::scope(|scope| {
        let flag = stop.clone();
        scope.spawn(move || {
            let waited = watched.recv_timeout(Duration::from_secs(2));
            if let Err(RecvTimeoutError::Timeout) = waited {
                flag.store(true, Ordering::Relaxed);
            }
        });
        let solved = solve(&scene, &stop);
        drop(done);
        clear_cache();
        solved
    })
}

/// Whatever is solved is made of numbers.
fn solve(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<bool, Error> {
    let mut march = March::new(scene)?;
    march.stop_on(stop.clone());
    while let Some(increment) = march.advance() {
        let increment = increment?;
        let f = march.fields();
        for field in [&f.p, &f.q_x, &f.q_y, &f.u_x, &f.u_y, &f.u_z] {
            assert!(field.iter().all(|v| v.is_finite()), "{increment:?}");
        }
        assert!(increment.residuals.gap.is_finite() && increment.motion.delta_z.is_finite());
    }
    Ok(true)
}
