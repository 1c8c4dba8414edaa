//! Reading of the tables in `tests/data`.
#![allow(clippy::unwrap_used)]
#![allow(dead_code, reason = "each test file reads its own table")]

use contact_core::kernels::Complex64;
use contact_core::scene::{Body, Coating, Elastic, Shape};
use serde_json::Value;

/// The entries of a table.
pub(crate) fn load(name: &str) -> Vec<Value> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/");
    let text = std::fs::read_to_string(format!("{path}{name}")).unwrap();
    let mut table: Value = serde_json::from_str(&text).unwrap();
    match table["entries"].take() {
        Value::Array(entries) => entries,
        other => panic!("{name}: no entries but {other}"),
    }
}

pub(crate) fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap()
}

pub(crate) fn whole(value: &Value, key: &str) -> i64 {
    value[key].as_i64().unwrap()
}

/// Rows of numbers.
pub(crate) fn matrix(value: &Value) -> Vec<Vec<f64>> {
    let row = |row: &Value| {
        let row = row.as_array().unwrap().iter();
        row.map(|v| v.as_f64().unwrap()).collect()
    };
    value.as_array().unwrap().iter().map(row).collect()
}

/// The layered body of an entry.
pub(crate) fn body(entry: &Value) -> Body {
    let elastic = |v: &Value| Elastic::new(number(v, "E"), number(v, "nu")).unwrap();
    let coating = |v: &Value| Coating {
        material: elastic(v),
        thickness: number(v, "h"),
    };
    let layers = entry["layers"].as_array().unwrap();
    Body {
        substrate: elastic(&entry["substrate"]),
        coatings: layers.iter().map(coating).collect(),
        bonds: Vec::new(),
        plastic: Vec::new(),
        hardness: f64::INFINITY,
        residual: Vec::new(),
        shape: Shape::Flat,
        bulk: contact_core::scene::Bulk::default(),
    }
}

/// Largest difference from the table over its largest entry.
pub(crate) fn off(ours: &[[Complex64; 3]], entry: &Value, of: &str) -> f64 {
    let [re, im] = ["re", "im"].map(|part| matrix(&entry[format!("{of}_{part}")]));
    let (mut largest, mut worst): (f64, f64) = (0.0, 0.0);
    for (row, ours) in ours.iter().enumerate() {
        for (column, ours) in ours.iter().enumerate() {
            let theirs = Complex64::new(re[row][column], im[row][column]);
            largest = largest.max(theirs.norm());
            worst = worst.max((ours - theirs).norm());
        }
    }
    worst / largest
}
