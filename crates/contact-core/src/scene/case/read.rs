//! The values of a scene, in the order that their measures need: a_H needs the substrates, the
//! shapes and the loads; the coatings and the grid may be given in a_H.

use toml::{Table, Value};

use super::SCHEMA;
use super::files::Files;
use super::measure::{self, Measure};
use super::section::{Fault, Section, count, pair};
use super::shape::{shape, surface_map};
use crate::scene::{
    Body, Branch, Coating, Elastic, Friction, FrictionHistory, Given, Grid, History, Increments,
    KernelMethod, KernelSettings, LOADS, LoadPath, Loads, MOTIONS, Preset, SaveFields, Scene,
    Settings, SkipSettings, SolverSettings, Spacing,
};

pub(super) const ROOT: [&str; 12] = [
    "schema", "title", "body1", "body2", "friction", "grid", "path", "kernel", "solver", "skip",
    "output", "wear",
];
const BODY: [&str; 4] = ["shape", "E", "nu", "coatings"];

/// The whole scene, not yet checked for meaning.
pub(super) fn scene(table: &Table, files: &Files<'_>) -> Result<Scene, Fault> {
    let root = Section::root(table, &ROOT)?;
    let what = "1, the version of the scene file";
    match root.need("schema", what)? {
        Value::Integer(SCHEMA) => {}
        other => return Err(Fault::value("schema", other, what)),
    }
    let title = root.get("title").map_or(Ok(""), |value| {
        value
            .as_str()
            .ok_or_else(|| Fault::value("title", value, "a text in quotes"))
    })?;
    let bodies = [
        root.need_section("body1", &BODY)?,
        root.need_section("body2", &BODY)?,
    ];
    let friction = friction(&root, files)?;
    let mu = friction.mu;
    let mut scene = Scene {
        title: title.to_owned(),
        body1: uncoated(&bodies[0], files)?,
        body2: uncoated(&bodies[1], files)?,
        friction,
        grid: Grid {
            nx: 0,
            ny: 0,
            dx: 0.0,
            dy: 0.0,
            plane_strain: plane_strain(&root)?,
        },
        path: path(&root, files, mu)?,
        settings: settings(&root)?,
    };
    scene.body1.check("body1")?;
    scene.body2.check("body2")?;
    scene.friction.check(None)?;
    scene.path.check(&scene.friction)?;
    scene.check_magnitudes()?;

    let hertz = scene.hertz();
    let a_H = Measure::a_H(hertz.map(|h| h.a));
    let p_H = Measure::p_H(hertz.map(|h| h.p0));
    scene.body1.coatings = coatings(&bodies[0], &scene.body1, &[a_H, p_H])?;
    scene.body2.coatings = coatings(&bodies[1], &scene.body2, &[a_H, p_H])?;
    scene.grid = grid(&root, a_H)?;
    Ok(scene)
}

/// The friction law.
fn friction(root: &Section<'_>, files: &Files<'_>) -> Result<Friction, Fault> {
    let keys = ["mu", "mu_y", "kinetic", "map", "history"];
    let section = root.need_section("friction", &keys)?;
    let what = "a number >= 0, or \"stick\" for no slip";
    let mu = match section.need("mu", what)? {
        Value::String(word) if word == "stick" => f64::INFINITY,
        Value::String(_) => {
            return Err(Fault::value("friction.mu", section.need("mu", what)?, what));
        }
        _ => section.number("mu", what, &[])?,
    };
    if mu.is_infinite() && section.get("mu").is_some_and(|mu| !mu.is_str()) {
        let finite = "a finite number >= 0, or \"stick\" for no slip";
        return Err(Fault::value(
            "friction.mu",
            section.need("mu", what)?,
            finite,
        ));
    }
    let number = |key: &str| {
        let given = section
            .get(key)
            .map(|_| section.number(key, "a positive number", &[]));
        given.transpose()
    };
    let map = section.section("map", &["file", "z", "spacing"])?;
    Ok(Friction {
        mu,
        mu_y: number("mu_y")?,
        kinetic: number("kinetic")?,
        map: map.map(|map| surface_map(&map, files)).transpose()?,
        history: friction_history(&section)?,
    })
}

fn friction_history(friction: &Section<'_>) -> Result<Option<FrictionHistory>, Fault> {
    let Some(section) = friction.section("history", &["of", "table"])? else {
        return Ok(None);
    };
    let of = section.choice(
        "of",
        &[
            ("slip", History::Slip),
            ("dissipated", History::Dissipated),
            ("increment", History::Increment),
        ],
    )?;
    let what = "a list of pairs [history, factor]";
    let (key, value) = (section.path("table"), section.need("table", what)?);
    let wrong = || Fault::value(&key, value, what);
    let table = value.as_array().ok_or_else(wrong)?;
    let pairs = table.iter().map(|row| {
        let row = row
            .as_array()
            .filter(|row| row.len() == 2)
            .ok_or_else(wrong)?;
        let number = |i: usize| measure::number(&key, &row[i], &[]);
        Ok((number(0)?, number(1)?))
    });
    let table = pairs.collect::<Result<_, Fault>>()?;
    Ok(Some(FrictionHistory { of, table }))
}

fn uncoated(section: &Section<'_>, files: &Files<'_>) -> Result<Body, Fault> {
    let rigid = section.get("E").and_then(Value::as_str) == Some("rigid");
    let substrate = if rigid {
        Elastic {
            E: f64::INFINITY,
            nu: section.number_or("nu", Elastic::RIGID.nu, &[])?,
        }
    } else {
        Elastic {
            E: section.number("E", "a modulus in Pa, or \"rigid\"", &[])?,
            nu: section.number("nu", "Poisson's ratio", &[])?,
        }
    };
    Ok(Body::homogeneous(substrate, shape(section, files)?))
}

fn coatings(
    section: &Section<'_>,
    body: &Body,
    hertz: &[Measure; 2],
) -> Result<Vec<Coating>, Fault> {
    let [a_H, p_H] = *hertz;
    let moduli = [Measure::E_substrate(body.substrate.E), p_H];
    section
        .sections("coatings", &["E", "nu", "thickness"])?
        .iter()
        .map(|coating| {
            Ok(Coating {
                material: Elastic {
                    E: coating.number("E", "a modulus in Pa", &moduli)?,
                    nu: coating.number("nu", "Poisson's ratio", &[])?,
                },
                thickness: coating.number("thickness", "a length in m", &[a_H])?,
            })
        })
        .collect()
}

const GRID: [&str; 4] = ["n", "extent", "spacing", "plane_strain"];

fn plane_strain(root: &Section<'_>) -> Result<bool, Fault> {
    let section = root.need_section("grid", &GRID)?;
    section.flag_or("plane_strain", false)
}

/// Cells by number, and either the extent of the grid or the size of a cell.
fn grid(root: &Section<'_>, a_H: Measure) -> Result<Grid, Fault> {
    let section = root.need_section("grid", &GRID)?;
    let plane_strain = plane_strain(root)?;
    let n = section.need("n", "the number of cells, or two along x and y")?;
    let n = match n {
        Value::Integer(_) if plane_strain => (count("grid.n", n, 1)?, 1),
        n => pair(&section.path("n"), n, |key, value| count(key, value, 1))?,
    };
    let length = |key: &str, value: &Value| {
        let length = measure::number(key, value, &[a_H])?;
        if length > 0.0 && length.is_finite() {
            Ok(length)
        } else {
            Err(Fault::value(key, value, "a positive length in m"))
        }
    };
    let lengths = |name: &str| {
        let value = section.need(name, "a length in m, or two along x and y")?;
        // One length in plane strain: forces are reckoned per metre.
        if plane_strain && !value.is_array() {
            return Ok((length(&section.path(name), value)?, 1.0));
        }
        pair(&section.path(name), value, length)
    };
    let d = match (section.get("extent"), section.get("spacing")) {
        (Some(_), Some(_)) => {
            return Err(Fault::new(
                section.path("spacing"),
                "grid.extent and grid.spacing are both given: only one of them may be",
            ));
        }
        (None, Some(_)) => lengths("spacing")?,
        _ => {
            let (x, y) = lengths("extent")?;
            (x / n.0 as f64, y / n.1 as f64)
        }
    };
    Ok(Grid {
        nx: n.0,
        ny: n.1,
        dx: d.0,
        dy: d.1,
        plane_strain,
    })
}

/// The branches; loads that one does not name keep their value.
fn path(root: &Section<'_>, files: &Files<'_>, mu: f64) -> Result<LoadPath, Fault> {
    let own = [
        "sigma_B",
        "sigma_B1",
        "rolled",
        "increments",
        "t",
        "spacing",
        "path_error",
    ];
    let keys = [&LOADS[..], &MOTIONS[..], &own].concat();
    if let Some(Value::Table(_)) = root.get("path") {
        return measured(root, files);
    }
    let mut path = LoadPath::start();
    let (mut at, mut t) = (Loads::default(), 0.0);
    for section in root.sections("path", &keys)? {
        at = loads(&section, at, mu)?;
        let t_end = section.number_or("t", t + 1.0, &[])?;
        t = t_end;
        path = path.branch(Branch {
            to: at,
            increments: branch_increments(&section)?,
            spacing: section.choice(
                "spacing",
                &[
                    ("uniform", Spacing::Uniform),
                    ("equal_radius", Spacing::EqualRadius),
                ],
            )?,
            t_end,
            path_error: section
                .get("path_error")
                .map(|_| section.number("path_error", "a number", &[]))
                .transpose()?,
        });
    }
    Ok(path)
}

/// The increments of a branch, if they are given.
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

/// The loads and motions of a branch. Naming a load sets its motion free, naming a motion gives it.
fn loads(section: &Section<'_>, at: Loads, mu: f64) -> Result<Loads, Fault> {
    let (mut forces, mut motions) = (at.forces(), at.given.motions());
    for (k, (load, motion)) in LOADS.into_iter().zip(MOTIONS).enumerate() {
        let mu_W = [Measure::mu_W(mu * forces[0])];
        let measures = if load.starts_with('T') {
            &mu_W[..]
        } else {
            &[]
        };
        match (section.get(load), section.get(motion)) {
            (Some(_), Some(_)) => {
                let key = section.path(motion);
                let message = format!(
                    "{} and {key} are both given: the one follows from the other",
                    section.path(load)
                );
                return Err(Fault::new(key, message));
            }
            (Some(_), None) => {
                forces[k] = section.number(load, "a load", measures)?;
                motions[k] = None;
            }
            (None, Some(_)) => {
                forces[k] = 0.0;
                motions[k] = Some(section.number(motion, "a motion", &[])?);
            }
            (None, None) => {}
        }
    }
    let number = |key: &str, before: f64| section.number_or(key, before, &[]);
    let bodies = Loads {
        sigma_B: number("sigma_B", at.sigma_B)?,
        sigma_B1: number("sigma_B1", at.sigma_B1)?,
        rolled: number("rolled", at.rolled)?,
        ..at
    };
    Ok(bodies.with_forces(forces, Given::from_motions(motions)))
}

/// A measured history: a table of waypoints in a file.
fn measured(root: &Section<'_>, files: &Files<'_>) -> Result<LoadPath, Fault> {
    let section = root.need_section("path", &["file", "increments"])?;
    let what = "the name of a .csv file";
    let (key, value) = (section.path("file"), section.need("file", what)?);
    let name = value
        .as_str()
        .ok_or_else(|| Fault::value(&key, value, what))?;
    let what = "a whole number >= 1, or { per_range = number }";
    let increments = match section.get("increments") {
        None => Increments::Each(1),
        Some(Value::Table(_)) => {
            let auto = section.need_section("increments", &["per_range"])?;
            Increments::PerRange(auto.count("per_range", 1)?)
        }
        Some(n @ Value::Integer(_)) => Increments::Each(count("path.increments", n, 1)?),
        Some(other) => return Err(Fault::value("path.increments", other, what)),
    };
    let wrong = |e: &dyn std::fmt::Display| Fault::new(&key, format!("{key}: {e}"));
    let path = files.find(name).map_err(|e| wrong(&e))?;
    LoadPath::from_csv(&path, increments).map_err(|e| wrong(&e))
}

fn settings(root: &Section<'_>) -> Result<Settings, Fault> {
    let mut settings = Settings::default();
    if let Some(section) = root.section("kernel", &["method", "tolerance"])? {
        let default = settings.kernel;
        settings.kernel = KernelSettings {
            method: kernel_method(&section)?,
            tolerance: section.number_or("tolerance", default.tolerance, &[])?,
        };
    }
    let keys = [
        "preset",
        "tolerance",
        "entering",
        "turning",
        "path_tolerance",
        "max_alternations",
        "max_iterations",
    ];
    if let Some(section) = root.section("solver", &keys)? {
        let default = settings.solver;
        settings.solver = SolverSettings {
            preset: section.choice(
                "preset",
                &[("fast", Preset::Fast), ("spinu2020", Preset::Spinu2020)],
            )?,
            tolerance: section.number_if("tolerance", &[])?.or(default.tolerance),
            entering: section.flag_or("entering", default.entering)?,
            turning: section.flag_or("turning", default.turning)?,
            path_tolerance: section.number_or("path_tolerance", default.path_tolerance, &[])?,
            max_alternations: section.count_or("max_alternations", 1, default.max_alternations)?,
            max_iterations: section.count_or("max_iterations", 1, default.max_iterations)?,
        };
    }
    let rules = [
        "equal_layers",
        "coupling",
        "mirror",
        "digits",
        "far",
        "path",
    ];
    if let Some(section) = root.section("skip", &rules)? {
        let default = settings.skip;
        settings.skip = SkipSettings {
            equal_layers: section.flag_or("equal_layers", default.equal_layers)?,
            coupling: section.flag_or("coupling", default.coupling)?,
            mirror: section.flag_or("mirror", default.mirror)?,
            digits: section.flag_or("digits", default.digits)?,
            far: section.flag_or("far", default.far)?,
            path: section.flag_or("path", default.path)?,
        };
    }
    if let Some(section) = root.section("output", &["save"])? {
        settings.save = save(&section)?;
    }
    Ok(settings)
}

fn kernel_method(kernel: &Section<'_>) -> Result<KernelMethod, Fault> {
    let what = "\"hankel\", { inverse_fft = { lambda = 8, aliases = 0 } } or \
                { frequency_domain = { lambda = 8 } }";
    let key = kernel.path("method");
    let value = match kernel.get("method") {
        None => return Ok(KernelSettings::default().method),
        Some(Value::String(word)) if word == "hankel" => return Ok(KernelMethod::Hankel),
        Some(table @ Value::Table(inner)) if inner.len() == 1 => table,
        Some(other) => return Err(Fault::value(&key, other, what)),
    };
    let method = Section::from_value(key, value, &["inverse_fft", "frequency_domain"])?;
    if let Some(section) = method.section("inverse_fft", &["lambda", "aliases"])? {
        return Ok(KernelMethod::InverseFft {
            lambda: section.count_or("lambda", 1, 8)?,
            aliases: section.count_or("aliases", 0, 0)?,
        });
    }
    let section = method.need_section("frequency_domain", &["lambda"])?;
    Ok(KernelMethod::FrequencyDomain {
        lambda: section.count_or("lambda", 1, 8)?,
    })
}

fn save(output: &Section<'_>) -> Result<SaveFields, Fault> {
    let what = "\"branches\", \"all\" or a list of increments, counted from 1";
    let key = output.path("save");
    match output.get("save") {
        None => Ok(SaveFields::default()),
        Some(Value::String(word)) if word == "branches" => Ok(SaveFields::Branches),
        Some(Value::String(word)) if word == "all" => Ok(SaveFields::All),
        Some(Value::Array(items)) => items
            .iter()
            .enumerate()
            .map(|(i, item)| count(&format!("{key}[{i}]"), item, 1))
            .collect::<Result<_, _>>()
            .map(SaveFields::Indices),
        Some(other) => Err(Fault::value(&key, other, what)),
    }
}
