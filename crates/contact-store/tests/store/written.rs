//! The result store: what a run leaves behind, whole at every moment.

// What is read back is what was written: equality is meant to the bit.
#![allow(clippy::float_cmp, clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use contact_core::march::{Fields, Increment, March, Observer, solve};
use contact_core::{Error, Scene};
use contact_store::{FIELDS, FieldView, SCALARS, Store, StoreWriter};

const SCENE: &str = r#"
schema = 1
title = "Small"
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = [16, 14], extent = { a_H = 3.0 } }
path = [
    { W = 1000.0, increments = 3 },
    { T_x = { mu_W = 0.5 }, increments = 4 },
    { T_x = { mu_W = -0.5 }, increments = 5 },
]
"#;

fn scene(settings: &[&str]) -> Scene {
    let settings: Vec<_> = settings.iter().map(|&s| s.to_owned()).collect();
    Scene::from_toml_str(SCENE, "small.toml", &settings).unwrap()
}

/// A path in the build folder that is free.
fn free(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    path
}

/// Writes the store, and keeps in memory what should be in it.
struct Witness {
    writer: StoreWriter,
    kept: Vec<(usize, Fields)>,
    stop_after: usize,
}

impl Observer for Witness {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        self.writer.on_increment(march, increment)?;
        let index = increment.index;
        if increment.point.ends_branch || index == self.stop_after {
            self.kept.push((index, march.fields()));
        }
        if index == self.stop_after {
            return Err(Error::Interrupted { increment: index });
        }
        Ok(())
    }

    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        self.writer.on_end(march, failure)
    }
}

fn witness(path: &Path, stop_after: usize) -> Witness {
    Witness {
        writer: StoreWriter::create(path, false).unwrap(),
        kept: Vec::new(),
        stop_after,
    }
}

/// Hertz's line contact, R = 0.02 m, W = 3e4 N/m: 4 W R/(pi E*) = a^2, p_H = 2 W/(pi a).
const LINE: &str = r#"
schema = 1
title = "Line"
body1 = { shape.cylinder.R = 0.02, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = [64, 1], extent = 3e-4, plane_strain = true }
path = [
    { W = 3e4, increments = 1 },
    { T_x = { mu_W = 0.5 }, increments = 2 },
]
"#;

#[test]
fn a_line_contact_is_in_units_per_metre_and_of_its_half_width() {
    let (R, W) = (0.02, 3e4);
    let E_star = 210e9 / (2.0 * (1.0 - 0.3 * 0.3));
    let a = (4.0 * W * R / (std::f64::consts::PI * E_star)).sqrt();
    let p_H = 2.0 * W / (std::f64::consts::PI * a);
    for (k, extent) in ["3e-4", "5e-4"].into_iter().enumerate() {
        let path = free(&format!("line{k}.zarr"));
        let settings = [format!("grid.extent={extent}")];
        let scene = Scene::from_toml_str(LINE, "line.toml", &settings).unwrap();
        solve(&scene, &mut witness(&path, 0)).unwrap();
        let store = Store::open(&path).unwrap();
        let last = |name: &str| *store.column(name).unwrap().last().unwrap();
        let cell = scene.grid.dx / a;
        assert!((last("half_width") / a - 1.0).abs() < 0.5 * cell);
        assert!((last("p_max") / p_H - 1.0).abs() < 0.5 * cell);
        assert_eq!(last("W"), W);
        assert!(store.column("contact_radius").is_err());
        // What describes the bodies does not depend on the grid.
        for (name, truth) in [("R", R), ("a_H", a), ("p_H", p_H)] {
            let told = store.attributes()[name].as_f64().unwrap();
            assert!((told / truth - 1.0).abs() < 1e-12, "{name} = {told}");
        }
        for (name, units) in [
            ("W", "N/m"),
            ("T_x", "N/m"),
            ("M_z", "N m/m"),
            ("dissipated", "J/m"),
            ("contact_area", "m^2/m"),
            ("half_width", "m"),
            ("p_max", "Pa"),
        ] {
            let text = fs::read_to_string(path.join(name).join(".zattrs")).unwrap();
            assert!(
                text.contains(&format!("\"units\": \"{units}\"")),
                "{name}: {text}"
            );
        }
    }
}

#[test]
fn on_a_strip_of_another_width_forces_are_those_on_it() {
    let path = free("width.zarr");
    let settings = ["grid.extent=[3e-4, 0.01]", "path.0.W=3e2"].map(str::to_owned);
    let scene = Scene::from_toml_str(LINE, "line.toml", &settings).unwrap();
    solve(&scene, &mut witness(&path, 0)).unwrap();
    let text = fs::read_to_string(path.join("W").join(".zattrs")).unwrap();
    assert!(text.contains("\"units\": \"N\""), "{text}");
    assert_eq!(Store::open(&path).unwrap().column("W").unwrap()[2], 3e2);
}

#[test]
fn everything_comes_back() {
    let path = free("everything.zarr");
    let scene = scene(&[]);
    let mut witness = witness(&path, 0);
    let increments = solve(&scene, &mut witness).unwrap();

    let store = Store::open(&path).unwrap();
    assert_eq!(store.status(), "done");
    let mut solved = scene.clone();
    solved.settings.solver.tolerance = Some(scene.tolerance());
    assert_eq!(*store.scene(), solved);
    assert_eq!(store.increments(), 12);
    for scalar in SCALARS {
        let expected: Vec<_> = increments
            .iter()
            .map(scalar.value)
            .map(f64::to_bits)
            .collect();
        let column = store.column(scalar.name).unwrap();
        let bits: Vec<_> = column.into_iter().map(f64::to_bits).collect();
        assert_eq!(bits, expected, "{}", scalar.name);
    }
    let ends: Vec<_> = witness
        .kept
        .iter()
        .map(|(index, _)| *index as f64)
        .collect();
    assert_eq!(ends, [3.0, 7.0, 12.0]);
    assert_eq!(store.column("saved_increment").unwrap(), ends);
    assert_eq!(store.column("saved_t").unwrap(), [1.0, 2.0, 3.0]);
    let x: Vec<_> = (0..16).map(|i| scene.grid.x(i)).collect();
    assert_eq!(store.column("x").unwrap(), x);
    assert_eq!(store.column("y").unwrap().len(), 14);
    for (i, (_, fields)) in witness.kept.iter().enumerate() {
        for field in FIELDS {
            let stored = store.field(field.name, i).unwrap();
            match (field.values)(fields) {
                FieldView::Real(f) => assert_eq!(stored, f, "{}", field.name),
                FieldView::Mask(f) => assert_eq!(stored.mapv(|v| v != 0.0), f, "{}", field.name),
            }
        }
    }
}

/// A field of zeros is a field like any other: no reader is left to guess what is missing.
#[test]
fn zeros_are_stored() {
    let path = free("zeros.zarr");
    let mut writer = StoreWriter::create(&path, false).unwrap();
    solve(
        &scene(&["friction.mu=0.0", "path.1.T_x=0", "path.2.T_x=0"]),
        &mut writer,
    )
    .unwrap();
    let store = Store::open(&path).unwrap();
    assert_eq!(store.field("q_x", 2).unwrap().sum(), 0.0);
    assert!(path.join("q_x/2.0.0").exists() && path.join("T_x/0").exists());
}

#[test]
fn a_run_that_is_stopped_keeps_everything_so_far() {
    let path = free("stopped.zarr");
    let mut witness = witness(&path, 9);
    let error = solve(&scene(&[]), &mut witness).unwrap_err();
    assert_eq!(error, Error::Interrupted { increment: 9 });

    let store = Store::open(&path).unwrap();
    assert_eq!(store.status(), "stopped after increment 9");
    assert_eq!(store.increments(), 9);
    assert_eq!(store.column("saved_increment").unwrap(), [3.0, 7.0, 9.0]);
    let last = &witness.kept.last().unwrap().1;
    assert_eq!(store.field("p", 2).unwrap(), last.p);
}

/// Whoever opens the store in the middle of a run finds it whole.
#[test]
fn the_store_can_be_read_while_it_grows() {
    struct Reader {
        writer: StoreWriter,
        path: PathBuf,
        seen: Vec<(usize, usize)>,
    }
    impl Observer for Reader {
        fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
            self.writer.on_increment(march, increment)?;
            let store = Store::open(&self.path)?;
            assert_eq!(store.status(), "running");
            assert_eq!(store.column("W")?.len(), store.increments());
            self.seen.push((store.increments(), store.saved()));
            Ok(())
        }
    }
    let path = free("growing.zarr");
    let mut reader = Reader {
        writer: StoreWriter::create(&path, false)
            .unwrap()
            .with_interval(Duration::ZERO),
        path,
        seen: Vec::new(),
    };
    solve(&scene(&["output.save=all"]), &mut reader).unwrap();
    let expected: Vec<_> = (1..=12).map(|n| (n, n)).collect();
    assert_eq!(reader.seen, expected);
}

#[test]
fn the_fields_asked_for_are_kept() {
    let saved = |save: &str| {
        let path = free("asked_for.zarr");
        let mut writer = StoreWriter::create(&path, false).unwrap();
        solve(&scene(&[save]), &mut writer).unwrap();
        Store::open(&path)
            .unwrap()
            .column("saved_increment")
            .unwrap()
    };
    assert_eq!(saved("output.save=[2, 5]"), [2.0, 5.0, 12.0]);
    assert_eq!(saved("output.save=all").len(), 12);
}

/// More increments than a chunk of scalars holds.
#[test]
fn long_paths_fill_several_chunks() {
    let path = free("long.zarr");
    let mut writer = StoreWriter::create(&path, false).unwrap();
    let scene = scene(&[
        "grid.n=8",
        "path.1.increments=1100",
        "path.2.increments=1000",
    ]);
    let increments = solve(&scene, &mut writer).unwrap();
    let expected: Vec<_> = increments.iter().map(|i| i.motion.delta_x).collect();
    assert_eq!(expected.len(), 2103);
    assert_eq!(
        Store::open(&path).unwrap().column("delta_x").unwrap(),
        expected
    );
}

#[test]
fn a_store_is_replaced_only_where_that_is_asked_for() {
    let path = free("replaced.zarr");
    let run = |overwrite, settings: &[&str]| {
        let mut writer = StoreWriter::create(&path, overwrite)?;
        solve(&scene(settings), &mut writer)
    };
    run(false, &[]).unwrap();
    let text = run(false, &[]).unwrap_err().to_string();
    assert!(
        text.contains("replaced.zarr: the result store exists"),
        "{text}"
    );
    assert!(text.contains("--overwrite"), "{text}");

    // A run that does not come to its first increment leaves the old store alone.
    run(true, &["grid.extent.a_H=0.5"]).unwrap_err();
    assert_eq!(Store::open(&path).unwrap().increments(), 12);

    run(true, &["path.2.increments=1"]).unwrap();
    assert_eq!(Store::open(&path).unwrap().increments(), 8);
    let leftovers = fs::read_dir(&path).unwrap();
    assert!(leftovers.count() > 40);
}

#[test]
fn what_is_no_store_is_never_replaced() {
    let path = free("folder");
    fs::create_dir_all(&path).unwrap();
    fs::write(path.join("thesis.tex"), "all of it").unwrap();
    let error = StoreWriter::create(&path, true).err().unwrap().to_string();
    assert!(error.contains("is not a result store"), "{error}");
    assert!(path.join("thesis.tex").exists());
}

#[test]
fn damage_is_named() {
    let path = free("damaged.zarr");
    let mut writer = StoreWriter::create(&path, false).unwrap();
    solve(&scene(&[]), &mut writer).unwrap();
    let chunk = fs::read(path.join("p/1.0.0")).unwrap();
    fs::write(path.join("p/1.0.0"), &chunk[..chunk.len() / 2]).unwrap();
    fs::write(path.join("W/0"), "nonsense").unwrap();
    fs::remove_file(path.join("T_x/0")).unwrap();
    let store = Store::open(&path).unwrap();
    assert!(store.field("p", 0).is_ok());
    let text = |error: Error| error.to_string();
    assert!(text(store.field("p", 1).unwrap_err()).contains("damaged.zarr: p: "));
    assert!(text(store.column("W").unwrap_err()).contains("damaged.zarr: W: "));
    assert!(text(store.column("T_x").unwrap_err()).contains("the file T_x/0 is missing"));
    assert!(text(store.column("p").unwrap_err()).contains("no column"));
    assert!(text(store.column("F").unwrap_err()).contains("holds no F"));

    let metadata = fs::read_to_string(path.join(".zmetadata")).unwrap();
    let other = metadata.replace("\"schema\": 3", "\"schema\": 9");
    fs::write(path.join(".zmetadata"), other).unwrap();
    let error = text(Store::open(&path).err().unwrap());
    assert!(
        error.contains("schema 9: this version reads schema 3"),
        "{error}"
    );
    let endless = metadata.replace("      12\n", "      1200000000000\n");
    fs::write(path.join(".zmetadata"), endless).unwrap();
    let error = text(Store::open(&path).err().unwrap());
    assert!(error.contains(".zmetadata is damaged"), "{error}");
    fs::write(path.join(".zmetadata"), &metadata[..metadata.len() / 2]).unwrap();
    let error = text(Store::open(&path).err().unwrap());
    assert!(error.contains(".zmetadata is damaged"), "{error}");
    let error = text(Store::open(free("nothing.zarr")).err().unwrap());
    assert!(error.contains("has no .zmetadata"), "{error}");
}

#[test]
fn an_unwritable_place_is_named() {
    let path = free("file");
    fs::write(&path, "in the way").unwrap();
    let mut writer = StoreWriter::create(path.join("run.zarr"), false).unwrap();
    let error = solve(&scene(&[]), &mut writer).unwrap_err().to_string();
    assert!(error.contains("run.zarr"), "{error}");
    fs::remove_file(&path).unwrap();
}
