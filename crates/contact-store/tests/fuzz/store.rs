//! Result stores and their checkpoints.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use contact_core::march::{Increment, March, Observer, solve};
use contact_core::plan::Plan;
use contact_core::{Error, Scene};
use contact_store::{FIELDS, SCALARS, Store, StoreWriter, resume};
use proptest::prelude::*;

use crate::files::files;
use crate::mutate::{Change, apply, change};

const SCENE: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 70e9, nu = 0.2 }
friction.mu = 0.3
grid = { n = [8, 6], extent = { a_H = 3.0 } }
path = [{ W = 1000.0, increments = 2 }, { T_x = { mu_W = 0.5 }, increments = 3 }]
"#;

/// Ends the run before its last increment, so that there is a checkpoint.
struct EndEarly(StoreWriter);

impl Observer for EndEarly {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        self.0.on_increment(march, increment)?;
        match increment.index {
            4 => Err(Error::Interrupted { increment: 4 }),
            _ => Ok(()),
        }
    }

    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.0.on_end(march, failure)
    }
}

/// A file is changed, or gone; a state may get a checksum that fits.
#[derive(Clone, Debug)]
struct Damage {
    file: usize,
    change: Option<Change>,
    fits: bool,
}

#[test]
#[ignore = "slow"]
fn result_stores() {
    let folder = crate::folder();
    let path = folder.path().join("good.zarr");
    let scene = Scene::from_toml_str(SCENE, "small.toml", &[]).unwrap();
    let writer = StoreWriter::create(&path, false).unwrap();
    let writer = writer.with_interval(Duration::ZERO);
    solve(&scene, &mut EndEarly(writer)).unwrap_err();
    let good = files(&path);
    assert!(read(&path).is_ok(), "the store is a good one");

    // What counts most is hit most: the metadata and the checkpoint.
    let names: Vec<_> = good.keys().cloned().collect();
    let central =
        |name: &PathBuf| name == Path::new(".zmetadata") || name.starts_with("checkpoint");
    let central: Vec<_> = (0..names.len()).filter(|&i| central(&names[i])).collect();
    let file = prop_oneof![prop::sample::select(central), 0..names.len()];
    let change = prop_oneof![8 => change().prop_map(Some), 1 => Just(None)];
    let damage = (file, change, any::<bool>()).prop_map(|(file, change, fits)| Damage {
        file,
        change,
        fits,
    });
    let damages = prop::collection::vec(damage, 1..4);
    let bad = folder.path().join("bad.zarr");
    crate::fuzz("result stores", damages, |damages| {
        let mut files = good.clone();
        for damage in damages {
            let name = &names[damage.file];
            match (&damage.change, files.get_mut(name)) {
                (Some(change), Some(bytes)) => {
                    apply(bytes, change);
                    if damage.fits && bytes.len() > 4 {
                        let end = bytes.len() - 4;
                        let crc = crc32fast::hash(&bytes[..end]).to_le_bytes();
                        bytes[end..].copy_from_slice(&crc);
                    }
                }
                _ => drop(files.remove(name)),
            }
        }
        if bad.exists() {
            fs::remove_dir_all(&bad).unwrap();
        }
        for (name, bytes) in &files {
            let file = bad.join(name);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, bytes).unwrap();
        }
        match read(&bad) {
            Ok(()) => true,
            Err(error) => {
                crate::one_sentence(&error);
                false
            }
        }
    });
}

/// Reads all there is, then goes on with the run.
fn read(path: &Path) -> Result<(), Error> {
    let store = Store::open(path)?;
    let mut outcome = Ok(());
    let mut note = |error: Error| {
        crate::one_sentence(&error);
        outcome = Err(error);
    };
    for name in SCALARS.iter().map(|s| s.name).chain(["x", "y", "saved_t"]) {
        let _ = store.column(name).map_err(&mut note);
    }
    for saved in 0..store.saved().min(8) {
        for field in FIELDS {
            let _ = store.field(field.name, saved).map_err(&mut note);
        }
    }
    let scene = store.scene();
    let small = scene.grid.cells() <= 400 && scene.path.increments() <= 20;
    if small
        && Plan::new(scene).memory(scene) < crate::ANNOUNCED
        && let Some(mut resumed) = resume(path, None)?
    {
        let increments = resumed.increments.clone();
        resumed.march.run(increments, &mut resumed.writer)?;
    }
    outcome
}
