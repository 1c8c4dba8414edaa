//! The values of a scene, in the order that their measures need: a_H needs the substrates, the
//! shapes and the loads; the coatings and the grid may be given in a_H.

use plasticity::NUMBERS;
use toml::{Table, Value};

use super::fault::Fault;
use super::friction::friction;
use super::measure::{self, Measure};
use super::path::path;
use super::section::{Section, count, pair};
use super::settings::settings;
use super::shape::shape;
use crate::material::in_table;
use crate::scene::files::Files;
use crate::scene::{Body, Bond, Bulk, Coating, Elastic, Grid, Plastic, Profile, Scene};

/// The version of the scene file that is read and written.
pub(super) const SCHEMA: i64 = 1;
pub(super) const ROOT: [&str; 15] = [
    "schema", "title", "body1", "body2", "friction", "grid", "path", "kernel", "solver", "skip",
    "output", "wear", "rig", "cycle", "history",
];
/// Keys of a load history: of a recording, or of a spectrum or counted loops, each a table.
const HISTORY: [&str; 10] = [
    "file",
    "columns",
    "units",
    "t",
    "frequency",
    "skip",
    "group",
    "residue",
    "spectrum",
    "matrix",
];
const SPECTRUM: [&str; 7] = [
    "channel",
    "frequencies",
    "values",
    "of",
    "duration",
    "mean",
    "distribution",
];
const MATRIX: [&str; 5] = ["channel", "range", "mean", "counts", "duration"];
const BODY: [&str; 10] = [
    "shape",
    "material",
    "E",
    "nu",
    "coatings",
    "plastic",
    "residual",
    "bulk_azimuth",
    "bulk_neutral_depth",
    "hardness",
];

/// Reads the whole scene from its table. Keys and types are checked, not yet the meaning of the values.
pub(super) fn scene(table: &Table, files: &Files<'_>) -> Result<Scene, Fault> {
    let root = Section::root(table, &ROOT)?;
    let expected = "1, the version of the scene file";
    match root.require("schema", expected)? {
        Value::Integer(SCHEMA) => {}
        other => return Err(Fault::value("schema", other, expected)),
    }
    let title = root.get("title").map_or(Ok(""), |value| {
        value
            .as_str()
            .ok_or_else(|| Fault::value("title", value, "a text in quotes"))
    })?;
    let bodies = [
        root.require_section("body1", &BODY)?,
        root.require_section("body2", &BODY)?,
    ];
    let friction = friction(&root, files)?;
    let mu = friction.mu;
    let (plane_strain, dy) = (plane_strain(&root)?, strip_width(&root)?);
    let mut scene = Scene {
        title: title.to_owned(),
        body1: uncoated_body(&bodies[0], files)?,
        body2: uncoated_body(&bodies[1], files)?,
        friction,
        grid: Grid {
            nx: 0,
            ny: 0,
            dx: 0.0,
            dy,
            plane_strain,
        },
        path: path(&root, files, mu, plane_strain.then_some(dy))?,
        settings: settings(&root)?,
    };
    scene.path.rig_stiffness = match root.section("rig", &["stiffness"])? {
        Some(rig) => Some(rig.number("stiffness", "a stiffness in N/m", &[])?),
        None => None,
    };
    scene.path.period = match root.section("cycle", &["period"])? {
        Some(cycle) => Some(cycle.number("period", "a path time", &[])?),
        None => None,
    };
    check_history_keys(&root)?;
    scene.body1.check("body1")?;
    scene.body2.check("body2")?;
    scene.friction.check(None)?;
    scene.path.check_for_friction(&scene.friction)?;
    scene.check_magnitudes()?;

    let hertz = scene.hertz();
    let a_H = Measure::a_H(hertz.map(|h| h.a));
    let p_H = Measure::p_H(hertz.map(|h| h.p0));
    scene.body1.coatings = coatings(&bodies[0], &scene.body1, &[a_H, p_H])?;
    scene.body2.coatings = coatings(&bodies[1], &scene.body2, &[a_H, p_H])?;
    scene.body1.bonds = bonds(&bodies[0])?;
    scene.body2.bonds = bonds(&bodies[1])?;
    scene.body1.plastic = plastic(&bodies[0])?;
    scene.body2.plastic = plastic(&bodies[1])?;
    scene.body1.residual = residual(&bodies[0])?;
    scene.body2.residual = residual(&bodies[1])?;
    for (body, section) in [&mut scene.body1, &mut scene.body2]
        .into_iter()
        .zip(&bodies)
    {
        body.bulk = Bulk {
            azimuth: section.number_if("bulk_azimuth", &[])?,
            neutral_depth: section.number_if("bulk_neutral_depth", &[])?,
        };
    }
    scene.grid = grid(&root, a_H)?;
    Ok(scene)
}

/// Refuses unknown keys of a load history. Its values are read by the Python package, which counts it.
fn check_history_keys(root: &Section<'_>) -> Result<(), Fault> {
    if let Some(history) = root.section("history", &HISTORY)? {
        history.section("spectrum", &SPECTRUM)?;
        history.section("matrix", &MATRIX)?;
    }
    Ok(())
}

/// Reads substrate, shape and hardness of a body.
fn uncoated_body(section: &Section<'_>, files: &Files<'_>) -> Result<Body, Fault> {
    let rigid = section.get("E").and_then(Value::as_str) == Some("rigid");
    let substrate = if rigid {
        Elastic {
            E: f64::INFINITY,
            nu: section.number_or("nu", Elastic::RIGID.nu, &[])?,
        }
    } else {
        elastic(section, "a modulus in Pa, or \"rigid\"", &[])?
    };
    Ok(Body {
        hardness: section.number_or("hardness", f64::INFINITY, &[])?,
        ..Body::homogeneous(substrate, shape(section, files)?)
    })
}

/// Reads the material of a body or of a layer: by its name in the table, by E and nu, or by both, where a
/// number of the file replaces the number of the table.
fn elastic(section: &Section<'_>, what: &str, moduli: &[Measure]) -> Result<Elastic, Fault> {
    let key = section.path("material");
    let material = section.get("material").map(|value| {
        let name = value.as_str();
        let name = name.ok_or_else(|| Fault::value(&key, value, "the name of a material"))?;
        in_table(&key, name).map_err(Fault::from)
    });
    let named_material = material.transpose()?;
    let number = |name: &str, what: &str, measures: &[Measure]| {
        let (given, named) = (section.number_if(name, measures)?, named_material);
        let tabulated = named.and_then(|of| of.numbers.get(name));
        match (given.or(tabulated.map(|of| of.value)), named) {
            (Some(number), _) => Ok(number),
            (None, Some(of)) => {
                let (key, table) = (section.path(name), &of.name);
                let message =
                    format!("{key} is missing: the table of materials has none of {table}");
                Err(Fault::new(key, format!("{message}; it must be {what}")))
            }
            (None, None) => section.number(name, what, measures),
        }
    };
    Ok(Elastic {
        E: number("E", what, moduli)?,
        nu: number("nu", "Poisson's ratio", &[])?,
    })
}

const COATING: [&str; 8] = [
    "material",
    "E",
    "nu",
    "thickness",
    "bond_normal",
    "bond_shear",
    "plastic",
    "residual",
];

/// Reads the yield laws of the layers, the substrate last; none where all stay elastic.
fn plastic(body: &Section<'_>) -> Result<Vec<Option<Plastic>>, Fault> {
    let law = |section: &Section<'_>| -> Result<Option<Plastic>, Fault> {
        let names = NUMBERS.map(|number| number.name);
        let Some(numbers) = section.section("plastic", &names)? else {
            return Ok(None);
        };
        let mut law = Plastic::perfect(numbers.number("s_y", "a yield stress in Pa", &[])?);
        for number in &NUMBERS {
            let Some(value) = numbers.get(number.name) else {
                continue;
            };
            let (key, slots) = (numbers.path(number.name), (number.of)(&mut law));
            let single = std::slice::from_ref(value);
            let values = value.as_array().map_or(single, Vec::as_slice);
            if values.is_empty()
                || values.len() > slots.len()
                || (slots.len() == 1 && value.is_array())
            {
                let expected = match slots.len() {
                    1 => "one number".to_owned(),
                    most => format!("one to {most} numbers, one for each back stress"),
                };
                return Err(Fault::value(&key, value, &expected));
            }
            for (n, value) in values.iter().enumerate() {
                let key = match slots.len() {
                    1 => key.clone(),
                    _ => format!("{key}[{n}]"),
                };
                slots[n] = measure::number(&key, value, &[])?;
            }
        }
        Ok(Some(law))
    };
    let coatings = body.sections("coatings", &COATING)?;
    let laws = coatings.iter().map(law).chain([law(body)]);
    let laws = laws.collect::<Result<Vec<_>, Fault>>()?;
    let elastic = laws.iter().all(Option::is_none);
    Ok(if elastic { Vec::new() } else { laws })
}

/// Residual stress of the layers, the substrate last; none where no layer has any.
fn residual(body: &Section<'_>) -> Result<Vec<Profile>, Fault> {
    let layer_profile = |section: &Section<'_>| -> Result<Profile, Fault> {
        let key = section.path("residual");
        section
            .get("residual")
            .map_or_else(|| Ok(Profile::default()), |value| profile(&key, value))
    };
    let coatings = body.sections("coatings", &COATING)?;
    let layers = coatings
        .iter()
        .map(layer_profile)
        .chain([layer_profile(body)]);
    let layers = layers.collect::<Result<Vec<_>, Fault>>()?;
    let stress_free = layers.iter().all(|profile| profile.rows.is_empty());
    Ok(if stress_free { Vec::new() } else { layers })
}

/// Reads a residual stress at `key`: one stress, or a table of depth and stress.
fn profile(key: &str, value: &Value) -> Result<Profile, Fault> {
    const WHAT: &str = "a stress in Pa, or a table of depth and stress, [[depth, s], ..] or \
                        [[depth, s_xx, s_yy], ..]";
    let Value::Array(rows) = value else {
        return measure::number(key, value, &[]).map(Profile::uniform);
    };
    let row = |(n, row): (usize, &Value)| {
        let wrong = || Fault::value(key, value, WHAT);
        let row = row.as_array().ok_or_else(wrong)?;
        let number = |column: usize, name: &str| {
            let key = format!("{key}[{n}][{column}]");
            measure::number_of_quantity(&key, name, &row[column], &[])
        };
        match row.len() {
            2 => {
                let s = number(1, "residual")?;
                Ok([number(0, "depth")?, s, s])
            }
            3 => Ok([
                number(0, "depth")?,
                number(1, "residual")?,
                number(2, "residual")?,
            ]),
            _ => Err(wrong()),
        }
    };
    if rows.is_empty() {
        return Err(Fault::value(key, value, WHAT));
    }
    let rows = rows.iter().enumerate().map(row);
    Ok(Profile {
        rows: rows.collect::<Result<_, Fault>>()?,
    })
}

/// Reads the bonds below the coatings; none where all are perfect.
fn bonds(section: &Section<'_>) -> Result<Vec<Bond>, Fault> {
    let bonds = section.sections("coatings", &COATING)?;
    let bonds = bonds.iter().map(|coating| {
        Ok(Bond {
            normal: coating.number_or("bond_normal", 0.0, &[])?,
            shear: coating.number_or("bond_shear", 0.0, &[])?,
        })
    });
    let bonds = bonds.collect::<Result<Vec<_>, Fault>>()?;
    let perfect = bonds.iter().all(|bond| *bond == Bond::PERFECT);
    Ok(if perfect { Vec::new() } else { bonds })
}

/// Reads the coatings of a body, outermost first, with thickness and modulus also in measures of Hertz's
/// contact.
fn coatings(
    section: &Section<'_>,
    body: &Body,
    hertz: &[Measure; 2],
) -> Result<Vec<Coating>, Fault> {
    let [a_H, p_H] = *hertz;
    let moduli = [Measure::E_substrate(body.substrate.E), p_H];
    section
        .sections("coatings", &COATING)?
        .iter()
        .map(|coating| {
            Ok(Coating {
                material: elastic(coating, "a modulus in Pa", &moduli)?,
                thickness: coating.number("thickness", "a length in m", &[a_H])?,
            })
        })
        .collect()
}

const GRID: [&str; 4] = ["n", "extent", "spacing", "plane_strain"];

/// Whether the grid is one row of cells in plane strain.
fn plane_strain(root: &Section<'_>) -> Result<bool, Fault> {
    let section = root.require_section("grid", &GRID)?;
    section.flag_or("plane_strain", false)
}

/// The length along y of the row of cells in plane strain \[m\], on which a_H depends: 1 m, so that
/// forces are those per metre, or the second of two lengths.
fn strip_width(root: &Section<'_>) -> Result<f64, Fault> {
    let section = root.require_section("grid", &GRID)?;
    let second_lengths =
        ["extent", "spacing"].map(|name| Some((name, section.get(name)?.as_array()?.get(1)?)));
    match second_lengths.into_iter().flatten().next() {
        Some((name, along_y)) if plane_strain(root)? => {
            measure::number(&format!("{}[1]", section.path(name)), along_y, &[])
        }
        _ => Ok(1.0),
    }
}

/// Cells by number, and either the extent of the grid or the size of a cell.
fn grid(root: &Section<'_>, a_H: Measure) -> Result<Grid, Fault> {
    let section = root.require_section("grid", &GRID)?;
    let plane_strain = plane_strain(root)?;
    let n = section.require("n", "the number of cells, or two along x and y")?;
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
        let value = section.require(name, "a length in m, or two along x and y")?;
        // One length in plane strain: forces are reckoned per metre.
        if plane_strain && !value.is_array() {
            return Ok((length(&section.path(name), value)?, strip_width(root)?));
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
