//! Every fault of a scene file: a value that is refused gives way to one that could stand there, and
//! the file is read again.

use toml::{Table, Value};

use super::document::{apply, steps};
use super::fault::Fault;
use super::measure::is_name;
use crate::scene::Scene;

/// Most faults that are told, and most readings of a file.
const MOST: usize = 50;

/// What stands for a key that is missing or refused, by its name: nothing beside it becomes wrong. A
/// key without one is taken out.
const STAND_INS: [(&str, &str); 21] = [
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
const DEPEND: [&str; 3] = ["T_x", "T_y", "M_z"];

/// The faults of a document of which one is known, and the doubts of what is right in it; `read`
/// gives the scene or its first fault.
pub(super) fn every(
    root: &Table,
    first: Fault,
    read: impl Fn(&Table) -> Result<Scene, Fault>,
) -> (Vec<Fault>, Vec<String>) {
    let mut root = root.clone();
    let (mut faults, mut mended) = (Vec::<Fault>::new(), Vec::<String>::new());
    let mut fault = first;
    for _ in 0..MOST {
        if mended.contains(&fault.key) {
            break;
        }
        mended.push(fault.key.clone());
        let goes_on = mend(&mut root, &fault);
        if faults.is_empty() || is_its_own(&fault) {
            faults.push(fault);
        }
        if !goes_on {
            break;
        }
        match read(&root) {
            Ok(scene) => return (faults, doubts(&scene, &mended)),
            Err(next) => fault = next,
        }
    }
    (faults, Vec::new())
}

/// Whether a fault that is found beside stand-ins is one of its value, whatever stands beside it.
fn is_its_own(fault: &Fault) -> bool {
    if !fault.is_of_meaning {
        return true;
    }
    let path = steps(&fault.key);
    match path[..] {
        ["path", .., name] => path.len() > 2 && !DEPEND.contains(&name),
        ["body1" | "body2" | "friction" | "kernel" | "wear", .., name] => name != "shape",
        ["solver", name] => name != "path_grid",
        _ => false,
    }
}

/// Replaces what is refused; false if it cannot be.
fn mend(root: &mut Table, fault: &Fault) -> bool {
    let mut path = steps(&fault.key);
    // One of several numbers, or the number of a measure: all of them.
    let inner = |step: &&str| is_name(step) || step.parse::<usize>().is_ok();
    while path.len() > 1 && path.last().is_some_and(inner) {
        path.pop();
    }
    let Some((name, table)) = path.split_last() else {
        return false;
    };
    if let Some(nearest) = &fault.nearest {
        let Some(table) = table_at(root, table) else {
            return false;
        };
        let value = table.remove(*name);
        if let Some(value) = value.filter(|_| !table.contains_key(nearest)) {
            table.insert(nearest.clone(), value);
        }
        return true;
    }
    if let Some(value) = stand_in(&path) {
        return apply(root, &format!("{}={value}", path.join("."))).is_ok();
    }
    let Some(rest) = table_at(root, table) else {
        return false;
    };
    let found = rest.remove(*name).is_some();
    let above = Some(table).filter(|_| rest.is_empty());
    // A table of which nothing is left is missing as a whole.
    if let Some(value) = above.and_then(stand_in) {
        return apply(root, &format!("{}={value}", table.join("."))).is_ok();
    }
    found
}

/// What stands for a key, by its name.
fn stand_in(path: &[&str]) -> Option<&'static str> {
    let name = path.last()?;
    if path.len() > 1 && SECTIONS.contains(name) {
        return None;
    }
    let found = STAND_INS.iter().find(|(of, _)| of == name);
    found.map(|(_, value)| *value)
}

/// The table at the end of a path.
fn table_at<'t>(root: &'t mut Table, path: &[&str]) -> Option<&'t mut Table> {
    let Some((first, rest)) = path.split_first() else {
        return Some(root);
    };
    let mut at = root.get_mut(*first)?;
    for step in rest {
        at = match at {
            Value::Table(table) => table.get_mut(*step)?,
            Value::Array(array) => array.get_mut(step.parse::<usize>().ok()?)?,
            _ => return None,
        };
    }
    at.as_table_mut()
}

/// The doubts about single values that were read as they stand.
fn doubts(scene: &Scene, mended: &[String]) -> Vec<String> {
    let stands = |doubt: &String| {
        let key = doubt.split([' ', '=']).next().unwrap_or_default();
        let same = |of: &String| key.starts_with(of.as_str()) || of.starts_with(key);
        !mended.iter().any(same)
    };
    scene
        .doubts_of_values()
        .into_iter()
        .filter(stands)
        .collect()
}
