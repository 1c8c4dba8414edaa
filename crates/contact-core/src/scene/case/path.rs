//! The load path of a scene file.

use toml::Value;

use super::fault::Fault;
use super::measure::{self, Measure};
use super::section::{Section, count};
use crate::scene::files::Files;
use crate::scene::{Branch, Increments, LoadPath, Loads, Prescribed, RigidMotion, Spacing};

/// The branches; loads that a branch does not name do not change.
/// In plane strain forces are those on a `width` \[m\].
pub(super) fn path(
    root: &Section<'_>,
    files: &Files<'_>,
    mu: f64,
    width: Option<f64>,
) -> Result<LoadPath, Fault> {
    let other_keys = [
        "sigma_B",
        "sigma_B1",
        "rolled",
        "increments",
        "t",
        "spacing",
        "path_error",
    ];
    let keys = [&RigidMotion::names()[..], &other_keys].concat();
    if let Some(Value::Table(_)) = root.get("path") {
        return measured_path(root, files);
    }
    let mut path = LoadPath::start();
    let (mut current, mut t) = (Loads::default(), 0.0);
    for section in root.sections("path", &keys)? {
        current = loads(&section, current, mu, width)?;
        let t_end = section.number_or("t", t + 1.0, &[])?;
        t = t_end;
        path = path.push_branch(Branch {
            to: current,
            increments: branch_increments(&section)?,
            spacing: section.choice(
                "spacing",
                &[
                    ("uniform", Spacing::Uniform),
                    ("equal_radius", Spacing::EqualRadius),
                    ("short_first", Spacing::ShortFirst),
                ],
            )?,
            t_end,
            path_error: section.number_if("path_error", &[])?,
        });
    }
    Ok(path)
}

/// Reads the number of increments of a branch; none where they are to be chosen.
fn branch_increments(section: &Section<'_>) -> Result<Option<usize>, Fault> {
    match section.get("increments") {
        None => Ok(None),
        Some(Value::String(auto)) if auto == "auto" => Ok(None),
        Some(n @ Value::Integer(_)) => count(&section.path("increments"), n, 1).map(Some),
        Some(other) => {
            let key = section.path("increments");
            Err(Fault::value(
                &key,
                other,
                "a whole number >= 1, or \"auto\"",
            ))
        }
    }
}

/// The loads and motions at the end of a branch that starts `at` some; what the branch does not name stays.
fn loads(section: &Section<'_>, at: Loads, mu: f64, width: Option<f64>) -> Result<Loads, Fault> {
    let mut to = at;
    for motion in RigidMotion::ALL {
        let (load, name) = (motion.load_name(), motion.name());
        let mu_W = [Measure::mu_W(mu * to.W)];
        let measures = match motion {
            RigidMotion::DeltaX | RigidMotion::DeltaY => &mu_W[..],
            _ => &[],
        };
        let prescribed = match (section.get(load), section.get(name)) {
            (Some(_), Some(_)) => {
                let key = section.path(name);
                let message = format!(
                    "{} and {key} are both given: the one follows from the other",
                    section.path(load)
                );
                return Err(Fault::new(key, message));
            }
            (Some(value), None) => {
                Prescribed::Load(measure::load(&section.path(load), value, measures, width)?)
            }
            (None, Some(_)) => Prescribed::Motion(section.number(name, "a motion", &[])?),
            (None, None) => continue,
        };
        to.prescribe(motion, prescribed);
    }
    let number = |key: &str, default: f64| section.number_or(key, default, &[]);
    Ok(Loads {
        sigma_B: number("sigma_B", at.sigma_B)?,
        sigma_B1: number("sigma_B1", at.sigma_B1)?,
        rolled: number("rolled", at.rolled)?,
        ..to
    })
}

/// Reads a measured load history from a file: a table of waypoints.
fn measured_path(root: &Section<'_>, files: &Files<'_>) -> Result<LoadPath, Fault> {
    let section = root.require_section("path", &["file", "increments", "drive"])?;
    let expected = "the name of a file of text";
    let (key, value) = (section.path("file"), section.require("file", expected)?);
    let name = value
        .as_str()
        .ok_or_else(|| Fault::value(&key, value, expected))?;
    let expected = "a whole number >= 1, { per_range = number }, or \"auto\"";
    let increments = match section.get("increments") {
        None => Increments::Each(1),
        Some(Value::String(auto)) if auto == "auto" => Increments::Chosen,
        Some(Value::Table(_)) => {
            let auto = section.require_section("increments", &["per_range"])?;
            Increments::PerRange(auto.count("per_range", 1)?)
        }
        Some(n @ Value::Integer(_)) => Increments::Each(count("path.increments", n, 1)?),
        Some(other) => return Err(Fault::value("path.increments", other, expected)),
    };
    let wrong = |e: &dyn std::fmt::Display| Fault::new(&key, format!("{key}: {e}"));
    let path = files.find(name).map_err(|e| wrong(&e))?;
    let drive = driving_columns(&section)?;
    LoadPath::from_csv(&path, increments, &drive).map_err(|e| wrong(&e))
}

/// Reads the names of the columns that drive, where a file has both a motion and its load.
fn driving_columns<'a>(section: &Section<'a>) -> Result<Vec<&'a str>, Fault> {
    let expected = "the name of a column in quotes, or a list of names";
    let Some(value) = section.get("drive") else {
        return Ok(Vec::new());
    };
    let names = match value {
        Value::Array(names) => names.iter().map(Value::as_str).collect(),
        name => name.as_str().map(|name| vec![name]),
    };
    names.ok_or_else(|| Fault::value(&section.path("drive"), value, expected))
}
