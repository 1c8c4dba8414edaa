//! A run that is stopped and taken up again is the same run.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use contact_core::scene::{Friction, Grid, Scene, Shape};
use contact_store::{WearStore, resume_wear};
use contact_wear::{Cycling, Jumps, Wear, WearRun, WearState};

use crate::bench::{archard, cylinder, pulled, scene, to_and_fro, wear};
use crate::files::files;
use crate::splitmix::Draw;

fn cases() -> [(Scene, Wear); 2] {
    let line = Grid::strip(0.5e-3, 96, 1.0).unwrap();
    let slides = scene(cylinder(6e-3), line, to_and_fro(18.5e3, 20e-6, 3), 0.9);
    let laws = || [archard(2e-14), archard(3e-14)];
    let round = Grid::centred(0.5e-3, 16).unwrap();
    let sticks = scene(
        Shape::Sphere { R: 10e-3 },
        round,
        pulled(50.0, 20.0, 3),
        0.6,
    );
    let mut all = [
        (slides, wear(laws(), 3e3, Cycling::Sliding)),
        (sticks, wear(laws(), 1e5, Cycling::March)),
    ];
    all[1].1.jumps = Jumps::Number(5);
    all
}

fn to_end(mut run: WearRun) -> WearState {
    while let Some(jump) = run.advance() {
        jump.unwrap();
    }
    run.state().clone()
}

#[test]
fn a_run_taken_up_after_any_jump_ends_in_the_same_bits() {
    let mut draw = Draw(7);
    for (scene, wear) in cases() {
        let stop = Arc::default();
        let whole = to_end(WearRun::new(&scene, &wear, &stop).unwrap());
        for _ in 0..6 {
            let mut run = WearRun::new(&scene, &wear, &stop).unwrap();
            for _ in 0..(draw.next() * whole.jumps as f64) as usize {
                run.advance().unwrap().unwrap();
            }
            let bytes = postcard::to_stdvec(run.state()).unwrap();
            drop(run);
            let state: WearState = postcard::from_bytes(&bytes).unwrap();
            let resumed = to_end(WearRun::resume(&scene, &wear, state, &stop).unwrap());
            assert!(resumed == whole);
        }
    }
}

#[test]
fn a_store_taken_up_again_has_the_same_bytes() {
    let (scene, wear) = cases()[0].clone();
    let folder = tempfile::tempdir().unwrap();
    let stop = Arc::<AtomicBool>::default();
    let written = |name: &str, jumps: usize| {
        let mut run = WearRun::new(&scene, &wear, &stop).unwrap();
        let mut store = WearStore::create(folder.path().join(name), false).unwrap();
        for _ in 0..jumps {
            let Some(jump) = run.advance() else {
                store.finish(&run, "done").unwrap();
                return;
            };
            jump.unwrap();
            store.write(&mut run).unwrap();
        }
    };
    written("whole", usize::MAX);
    written("killed", 4);
    let killed = folder.path().join("killed");
    let (mut other, mut longer) = (scene.clone(), wear.clone());
    other.friction = Friction::coulomb(0.5);
    longer.cycles *= 2.0;
    for (scene, wear) in [(&other, &wear), (&scene, &longer)] {
        let refused = resume_wear(&killed, Some((scene, wear)), &stop)
            .err()
            .unwrap();
        assert!(
            refused.to_string().contains("belongs to another scene"),
            "{refused}"
        );
    }
    let (mut run, mut store) = resume_wear(&killed, Some((&scene, &wear)), &stop)
        .unwrap()
        .unwrap();
    while let Some(jump) = run.advance() {
        jump.unwrap();
        store.write(&mut run).unwrap();
    }
    store.finish(&run, "done").unwrap();
    let (whole, resumed) = (files(&folder.path().join("whole")), files(&killed));
    assert!(whole.keys().eq(resumed.keys()));
    for (name, bytes) in &whole {
        assert!(resumed[name] == *bytes, "{} differs", name.display());
    }
    assert!(resume_wear(&killed, None, &stop).unwrap().is_none());
}

#[test]
fn a_store_is_replaced_where_that_is_allowed() {
    let (scene, wear) = cases()[0].clone();
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("worn");
    let begin = |overwrite| {
        let mut run = WearRun::new(&scene, &wear, &Arc::default()).unwrap();
        run.advance().unwrap().unwrap();
        WearStore::create(&place, overwrite)?.write(&mut run)
    };
    begin(false).unwrap();
    let once = files(&place);
    begin(true).unwrap();
    assert!(files(&place) == once);
    let refused = begin(false).unwrap_err().to_string();
    assert!(refused.contains("--overwrite"), "{refused}");
    // Killed between the two steps that replace a store.
    std::fs::rename(&place, folder.path().join(".worn.replaced")).unwrap();
    assert!(resume_wear(&place, Some((&scene, &wear)), &Arc::default()).is_ok());
    assert!(files(&place) == once);
    // What is of no store is not thrown away.
    std::fs::write(place.join("notes.txt"), "").unwrap();
    let refused = begin(true).unwrap_err().to_string();
    assert!(refused.contains("notes.txt"), "{refused}");
}

#[test]
fn a_stopped_run_keeps_its_last_jump() {
    let (scene, wear) = cases()[0].clone();
    let stop = Arc::<AtomicBool>::default();
    let mut run = WearRun::new(&scene, &wear, &stop).unwrap();
    run.advance().unwrap().unwrap();
    let before = run.state().clone();
    stop.store(true, Ordering::Relaxed);
    assert!(matches!(
        run.advance(),
        Some(Err(contact_core::Error::Interrupted { .. }))
    ));
    assert!(*run.state() == before);
}
