//! Stores that are damaged: what is read is what was written, what is resumed ends with the same
//! bits, or the error names the store and the file.

#![allow(clippy::unwrap_used, clippy::float_cmp)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::files::files;
use crate::splitmix::Draw;
use contact_core::march::{Increment, March, Observer, solve};
use contact_core::{Error, Scene};
use contact_store::{FIELDS, SCALARS, Store, StoreWriter, resume};

const SCENE: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 70e9, nu = 0.2 }
friction.mu = 0.3
grid = { n = [12, 10], extent = { a_H = 3.0 } }
path = [
    { W = 1000.0, increments = 2 },
    { T_x = { mu_W = 0.5 }, increments = 2 },
    { T_x = { mu_W = -0.5 }, increments = 2 },
]
"#;
/// Stores of each kind.
const STORES: usize = 150;

type Files = BTreeMap<PathBuf, Vec<u8>>;

/// Writes checkpoints, and stops after an increment.
struct Stop(StoreWriter, usize);

impl Observer for Stop {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        self.0.on_increment(march, increment)?;
        let increment = increment.index;
        if increment == self.1 {
            return Err(Error::Interrupted { increment });
        }
        Ok(())
    }

    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.0.on_end(march, failure)
    }
}

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    path
}

/// The files of a store of a run that stops after an increment, or not at all.
fn store(name: &str, after: usize) -> Files {
    let path = folder(name);
    let writer = StoreWriter::create(&path, false).unwrap();
    let mut writer = Stop(writer.with_interval(Duration::ZERO), after);
    let scene = Scene::from_toml_str(SCENE, "small.toml", &[]).unwrap();
    assert_eq!(solve(&scene, &mut writer).is_ok(), after == 0);
    files(&path)
}

/// Makes a folder hold these files alone. Those that differ are written in place: some file systems
/// find no room for a new file in a short time where many have just been removed.
fn lay_out(folder: &Path, wanted: &Files) {
    fs::create_dir_all(folder).unwrap();
    let present = files(folder);
    for name in present.keys().chain(wanted.keys()) {
        if present.get(name) != wanted.get(name) {
            put(folder, name, wanted);
        }
    }
}

/// Makes the file of a folder the one among `files`, or none.
fn put(folder: &Path, name: &Path, files: &Files) {
    let file = folder.join(name);
    match files.get(name) {
        Some(bytes) => {
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, bytes).unwrap();
        }
        None => fs::remove_file(file).unwrap(),
    }
}

/// Damages a file: it is gone, cut, longer, another one, or differs in a bit. Gives its name.
fn damage(files: &mut Files, draw: &mut Draw, among: &[PathBuf]) -> PathBuf {
    let mut below = |n: usize| (draw.next() * n as f64) as usize;
    let name = among[below(among.len())].clone();
    let other = files.values().nth(below(files.len())).unwrap().clone();
    let (kind, bytes) = (below(6), files.get_mut(&name).unwrap());
    match kind {
        0 => drop(files.remove(&name)),
        1 => bytes.truncate(below(bytes.len())),
        2 => bytes.extend([0; 3]),
        3 => *bytes = other,
        _ if bytes.is_empty() => bytes.push(1),
        _ => {
            let at = below(bytes.len());
            bytes[at] ^= 1 << below(8);
        }
    }
    name
}

/// The bits of all numbers that a store holds.
fn numbers(store: &Store) -> Result<Vec<u64>, Error> {
    let mut all = Vec::<f64>::new();
    let names = SCALARS.iter().map(|s| s.name);
    for name in names.chain(["x", "y", "saved_t", "saved_increment"]) {
        all.extend(store.column(name)?);
    }
    for saved in 0..store.saved() {
        for field in FIELDS {
            all.extend(store.field(field.name, saved)?);
        }
    }
    Ok(all.into_iter().map(f64::to_bits).collect())
}

/// An error that names the store, and the file or its array.
fn assert_named(error: &Error, store: &Path, file: &Path) {
    let text = error.to_string();
    let array = file.parent().filter(|p| *p != Path::new(""));
    let part = array.unwrap_or(file).display().to_string();
    assert!(text.contains(&store.display().to_string()), "{text}");
    assert!(text.contains(&part), "{}: {text}", file.display());
    assert!(!text.contains('\n'), "{text}");
}

#[test]
fn what_is_read_is_what_was_written() {
    let good = store("damage_good.zarr", 0);
    let expected = numbers(&Store::open(folder_of("damage_good.zarr")).unwrap()).unwrap();
    let names: Vec<_> = good.keys().cloned().collect();
    let path = folder("damage_read.zarr");
    lay_out(&path, &good);
    let (mut draw, mut refused) = (Draw(34), 0);
    for _ in 0..STORES {
        let mut bad = good.clone();
        let name = damage(&mut bad, &mut draw, &names);
        put(&path, &name, &bad);
        match Store::open_whole(&path) {
            Ok(store) => assert!(numbers(&store).unwrap() == expected, "{}", name.display()),
            Err(error) => {
                assert_named(&error, &path, &name);
                refused += 1;
            }
        }
        put(&path, &name, &good);
    }
    assert!(refused > STORES / 4, "{refused} of {STORES}");
    assert!(files(&path) == good, "reading has changed the store");
}

#[test]
fn what_is_resumed_ends_with_the_same_bits() {
    let whole = store("damage_whole.zarr", 0);
    let good = store("damage_stopped.zarr", 5);
    let names: Vec<_> = good.keys().cloned().collect();
    let central =
        |name: &&PathBuf| name.starts_with("checkpoint") || name.starts_with(".zmetadata");
    let central: Vec<_> = names.iter().filter(central).cloned().collect();
    let path = folder("damage_resumed.zarr");
    lay_out(&path, &good);
    let (mut draw, mut refused) = (Draw(35), 0);
    for n in 0..STORES {
        let mut bad = good.clone();
        let among = if n % 3 == 0 { &central } else { &names };
        let name = damage(&mut bad, &mut draw, among);
        put(&path, &name, &bad);
        match resume(&path, None) {
            Ok(Some(mut run)) => {
                run.march.run(run.increments, &mut run.writer).unwrap();
                // Of the metadata of the arrays only those that are consolidated count.
                let counts = |files: &Files| -> Files {
                    let counts =
                        |name: &Path| !name.ends_with(".zarray") && !name.ends_with(".zattrs");
                    let files = files.iter().filter(|(name, _)| counts(name));
                    files.map(|(n, b)| (n.clone(), b.clone())).collect()
                };
                assert!(
                    counts(&files(&path)) == counts(&whole),
                    "{}",
                    name.display()
                );
                lay_out(&path, &good);
            }
            Ok(None) => panic!("{}: the run was not done", name.display()),
            Err(error) => {
                assert_named(&error, &path, &name);
                assert!(files(&path) == bad, "{}: something changed", name.display());
                put(&path, &name, &good);
                refused += 1;
            }
        }
    }
    assert!(refused > STORES / 4, "{refused} of {STORES}");
}

fn folder_of(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}
