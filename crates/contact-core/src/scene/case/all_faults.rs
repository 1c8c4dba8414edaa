//! All faults of a scene file: a refused value is replaced by a valid one, and the file is read
//! again.

use toml::{Table, Value};

use super::document::{apply, steps};
use super::fault::Fault;
use super::measure::is_measure;
use crate::scene::Scene;

/// Largest number of faults that are reported, and of readings of a file.
const MAX_FAULTS: usize = 50;

/// Valid values for keys that are missing or refused, by name: none makes another value wrong. A
/// refused key that is not in this list is removed.
const REPLACEMENTS: [(&str, &str); 21] = [
    ("schema", "1"),
    ("title", "\"\""),
    (
        "body1",
        "{ shape = { sphere = { R = 0.01 } }, E = 2e11, nu = 0.3 }",
    ),
    ("body2", "{ shape = \"flat\", E = 2e11, nu = 0.3 }"),
    ("friction", "{ mu = 0.5 }"),
    ("grid", "{ n = 32, extent = 1e-3 }"),
    ("path", "[{ W = 10 }]"),
    ("shape", "{ sphere = { R = 0.01 } }"),
    ("material", "\"steel_4340\""),
    ("E", "2e11"),
    ("nu", "0.3"),
    ("thickness", "1e-6"),
    ("mu", "\"stick\""),
    ("n", "32"),
    ("extent", "1e-3"),
    ("spacing", "1e-5"),
    ("W", "10"),
    ("R", "0.01"),
    ("cycles", "1000"),
    ("k", "1e-14"),
    ("alpha", "1e-14"),
];

/// Names of sections, which stand at the root of a file.
const SECTIONS: [&str; 5] = ["body1", "body2", "friction", "grid", "path"];

/// Names of the path whose range depends on other values.
const DEPENDENT: [&str; 3] = ["T_x", "T_y", "M_z"];

/// Finds all faults of a document after the first, and the doubts about its valid numbers; `read`
/// returns the scene or its first fault.
pub(super) fn find_all_faults(
    root: &Table,
    first: Fault,
    read: impl Fn(&Table) -> Result<Scene, Fault>,
) -> (Vec<Fault>, Vec<String>) {
    let mut root = root.clone();
    let (mut faults, mut replaced) = (Vec::<Fault>::new(), Vec::<String>::new());
    let mut fault = first;
    for _ in 0..MAX_FAULTS {
        if replaced.contains(&fault.key) {
            break;
        }
        replaced.push(fault.key.clone());
        let was_replaced = replace_refused_value(&mut root, &fault);
        if faults.is_empty() || is_independent(&fault) {
            faults.push(fault);
        }
        if !was_replaced {
            break;
        }
        match read(&root) {
            Ok(scene) => return (faults, doubts(&scene, &replaced)),
            Err(next) => fault = next,
        }
    }
    (faults, Vec::new())
}

/// Whether a fault is found whatever the replaced values beside it are.
fn is_independent(fault: &Fault) -> bool {
    if !fault.is_of_meaning {
        return true;
    }
    let path = steps(&fault.key);
    match path[..] {
        ["path", .., name] => path.len() > 2 && !DEPENDENT.contains(&name),
        ["body1" | "body2" | "friction" | "kernel" | "wear", .., name] => name != "shape",
        ["solver", name] => name != "path_grid",
        _ => false,
    }
}

/// Replaces the refused value by a valid one, so that reading goes on to the next fault; false if there is
/// none.
fn replace_refused_value(root: &mut Table, fault: &Fault) -> bool {
    let mut path = steps(&fault.key);
    // One of several numbers, or the number of a measure: all of them.
    let inner = |step: &&str| is_measure(step) || step.parse::<usize>().is_ok();
    while path.len() > 1 && path.last().is_some_and(inner) {
        path.pop();
    }
    let Some((name, table)) = path.split_last() else {
        return false;
    };
    if fault.is_unknown {
        let Some(table) = table_at(root, table) else {
            return false;
        };
        if let (Some(value), Some(nearest)) = (table.remove(*name), &fault.nearest)
            && !table.contains_key(nearest)
        {
            table.insert(nearest.clone(), value);
        }
        return true;
    }
    if let Some(value) = replacement(&path) {
        return apply(root, &format!("{}={value}", path.join("."))).is_ok();
    }
    let Some(parent) = table_at(root, table) else {
        return false;
    };
    let removed = parent.remove(*name).is_some();
    let emptied_table = Some(table).filter(|_| parent.is_empty());
    // A table of which nothing is left is missing as a whole.
    if let Some(value) = emptied_table.and_then(replacement) {
        return apply(root, &format!("{}={value}", table.join("."))).is_ok();
    }
    removed
}

/// A valid value for a faulty key, so that the next fault of the file is found; none for a section.
fn replacement(path: &[&str]) -> Option<&'static str> {
    let name = path.last()?;
    if path.len() > 1 && SECTIONS.contains(name) {
        return None;
    }
    let entry = REPLACEMENTS.iter().find(|(key, _)| key == name);
    entry.map(|(_, value)| *value)
}

/// The table at the end of a path of keys; none where the path leads elsewhere.
fn table_at<'t>(root: &'t mut Table, path: &[&str]) -> Option<&'t mut Table> {
    let Some((first, steps_below)) = path.split_first() else {
        return Some(root);
    };
    let mut node = root.get_mut(*first)?;
    for step in steps_below {
        node = match node {
            Value::Table(table) => table.get_mut(*step)?,
            Value::Array(array) => array.get_mut(step.parse::<usize>().ok()?)?,
            _ => return None,
        };
    }
    node.as_table_mut()
}

/// Warnings about single values of the scene, without those that were replaced (`mended`).
fn doubts(scene: &Scene, mended: &[String]) -> Vec<String> {
    let is_original = |doubt: &String| {
        let key = doubt.split([' ', '=']).next().unwrap_or_default();
        let is_replaced = |of: &String| key.starts_with(of.as_str()) || of.starts_with(key);
        !mended.iter().any(is_replaced)
    };
    scene
        .doubts_of_values()
        .into_iter()
        .filter(is_original)
        .collect()
}
