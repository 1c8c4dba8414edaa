//! Increments that do not converge whole.

#![allow(clippy::unwrap_used)]

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::march::{Increment, March, solve};
use contact_core::{Error, Scene};

const SCENE: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 70e9, nu = 0.2 }
friction.mu = 0.8
grid = { n = 20, extent = { a_H = 2.6 } }
# Else the contact grows in steps.
solver.cell_entry_correction = false
path = [
    { W = 1000.0, increments = 1 },
    { T_x = { mu_W = 0.95 }, increments = 1 },
    { T_x = { mu_W = -0.95 }, increments = 1 },
]
"#;

fn scene(settings: &[&str]) -> Scene {
    let settings: Vec<_> = settings.iter().map(|&s| s.to_owned()).collect();
    Scene::from_toml_str(SCENE, "jumps.toml", &settings).unwrap()
}

/// Few passes do for a piece of the way and not for the whole.
#[test]
fn an_increment_that_does_not_converge_is_solved_in_pieces() {
    let whole = solve(&scene(&[]), &mut ()).unwrap();
    assert!(whole.iter().all(|i| i.work.parts == 1));
    let tight = scene(&["skip.single_precision=false", "solver.max_iterations=3"]);
    let pieces = solve(&tight, &mut ()).unwrap();
    assert_eq!(pieces.len(), 3);
    let mut done = 0.0;
    for (i, (piece, whole)) in pieces.iter().zip(&whole).enumerate() {
        let place = |i: &Increment| (i.index, i.point.branch, i.point.ends_branch);
        assert_eq!(place(piece), (i + 1, i, true));
        let loads = |i: &Increment| [i.point.loads.W, i.point.loads.T_x];
        assert_eq!(
            loads(piece).map(f64::to_bits),
            loads(whole).map(f64::to_bits)
        );
        if piece.work.parts > 1 {
            assert!(piece.work.convolutions > whole.work.convolutions);
        }
        done += piece.energy.work;
        let missing = piece.energy.imbalance();
        assert!(
            missing.abs() < 10.0 * tight.tolerance() * done,
            "{missing:e} J of {done:e} J"
        );
    }
    // The first and the last are; the one between takes the passes that it has.
    let parts: Vec<_> = pieces.iter().map(|i| i.work.parts > 1).collect();
    assert_eq!(parts, [true, false, true]);
    // Pieces make a finer path, nearer to that of fine increments than the whole is.
    let finer = scene(&[
        "path.0.increments=32",
        "path.1.increments=32",
        "path.2.increments=32",
    ]);
    let finer = solve(&finer, &mut ()).unwrap();
    let ends = [31, 63, 95].map(|n| finer[n]);
    for ((pieces, whole), finer) in pieces.iter().zip(&whole).zip(&ends).skip(2) {
        let off = |i: &Increment| (i.motion.delta_x - finer.motion.delta_x).abs();
        assert!(
            off(pieces) < off(whole),
            "{:e} {:e}",
            off(pieces),
            off(whole)
        );
    }
}

#[test]
fn a_run_that_gives_up_keeps_the_last_good_state() {
    let mut march = March::new(&scene(&[])).unwrap();
    march.advance().unwrap().unwrap();
    let state = march.state().clone();
    march.stop_on(Arc::new(AtomicBool::new(true)));
    let error = march.advance().unwrap().unwrap_err();
    assert_eq!(error, Error::Interrupted { increment: 1 });
    assert_eq!(*march.state(), state);

    let error = solve(&scene(&["solver.max_iterations=1"]), &mut ()).unwrap_err();
    assert!(
        matches!(error, Error::NotConverged { increment: 1, .. }),
        "{error}"
    );
}
