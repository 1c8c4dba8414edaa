//! Height maps, `.npy` and `.csv`.

use std::fs;

use contact_core::scene::{FileOfNumbers, Scene, SurfaceMap};
use ndarray::Array2;
use ndarray_npy::WriteNpyExt;
use proptest::prelude::*;

use crate::mutate::{apply, change};

const SCENE: &str = r#"
schema = 1
body1 = { shape.height_map = { spacing = 1e-4, file = "NAME" }, E = 2e11, nu = 0.3 }
body2 = { shape = "flat", E = 2e11, nu = 0.3 }
friction.mu = 0.1
grid = { n = 8, extent = 5e-4 }
path = [{ W = 10.0, increments = 1 }]
"#;

fn told() -> FileOfNumbers {
    FileOfNumbers {
        spacing: Some((1e-4, 1e-4)),
        ..FileOfNumbers::default()
    }
}

/// A header that says what it likes.
fn lie() -> impl Strategy<Value = Vec<u8>> {
    let shape = prop_oneof!["\\([0-9]{1,20}, ?[0-9]{1,20}\\)", "\\([0-9, ]{0,9}\\)"];
    let descr = prop_oneof![
        Just("<f8"),
        Just(">f8"),
        Just("<f4"),
        Just("|O"),
        Just("<c16")
    ];
    let data = prop::collection::vec(any::<u8>(), 0..400);
    (shape, descr, any::<bool>(), 0..4_u8, data).prop_map(|(shape, descr, order, version, data)| {
        let mut bytes = npy(descr, order, &shape, version);
        bytes.extend(data);
        bytes
    })
}

/// The beginning of a `.npy` file.
fn npy(descr: &str, fortran_order: bool, shape: &str, version: u8) -> Vec<u8> {
    let order = if fortran_order { "True" } else { "False" };
    let mut header =
        format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}");
    while (header.len() + 11) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend([version, 0]);
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.into_bytes());
    bytes
}

/// Heights kept as Python objects are pickled, which is a program: nobody runs it.
#[test]
fn heights_that_are_pickled_are_refused() {
    let folder = crate::folder();
    let file = folder.path().join("z.npy");
    let mut bytes = npy("|O", false, "(2, 2)", 1);
    bytes.extend(b"\x80\x02cposix\nsystem\nU\x04true\x85R.");
    fs::write(&file, bytes).unwrap();
    let error = SurfaceMap::from_file(&file, &told()).map(|_| ());
    let error = error.unwrap_err();
    crate::one_sentence(&error);
    assert!(error.to_string().contains("z.npy"), "{error}");
}

fn changed(good: Vec<u8>) -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(change(), 1..4).prop_map(move |changes| {
        let mut bytes = good.clone();
        for change in &changes {
            apply(&mut bytes, change);
        }
        bytes
    })
}

#[test]
#[ignore = "slow"]
fn height_maps() {
    let z = Array2::from_shape_fn((7, 6), |(i, j)| {
        -1e-6 * ((i as f64 - 3.0).powi(2) + (j as f64 - 2.5).powi(2))
    });
    let mut npy = Vec::new();
    z.write_npy(&mut npy).unwrap();
    let rows = z.rows().into_iter().map(|row| {
        let row: Vec<_> = row.iter().map(ToString::to_string).collect();
        row.join(", ") + "\n"
    });
    let csv: String = rows.collect();
    let junk = || prop::collection::vec(any::<u8>(), 0..300);
    let files = prop_oneof![
        changed(npy).prop_map(|bytes| ("z.npy", bytes)),
        lie().prop_map(|bytes| ("z.npy", bytes)),
        junk().prop_map(|bytes| ("z.npy", bytes)),
        changed(csv.into_bytes()).prop_map(|bytes| ("z.csv", bytes)),
        junk().prop_map(|bytes| ("z.csv", bytes)),
    ];
    let folder = crate::folder();
    let path = folder.path().join("scene.toml");
    crate::fuzz("height maps", files, |(name, bytes)| {
        let file = folder.path().join(name);
        fs::write(&file, bytes).unwrap();
        match SurfaceMap::from_file(&file, &told()) {
            Ok(map) => assert!(map.values.len() <= bytes.len(), "more heights than bytes"),
            Err(error) => crate::one_sentence(&error),
        }
        fs::write(&path, SCENE.replace("NAME", name)).unwrap();
        match Scene::from_file(&path, &[]) {
            Ok(scene) => scene.h_init().iter().all(|h| h.is_finite()),
            Err(error) => {
                crate::one_sentence(&error);
                false
            }
        }
    });
}
