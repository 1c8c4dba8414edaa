//! Shapes in a scene file: a table of one key, or of several that are added.

use ndarray::Array2;
use toml::Value;

use super::fault::Fault;
use super::section::{Section, pair};
use crate::scene::files::Files;
use crate::scene::{FileOfNumbers, Missing, Rough, Shape, SurfaceMap};

const SHAPES: [&str; 13] = [
    "sphere",
    "ellipsoid",
    "cylinder",
    "crowned_roller",
    "cone",
    "wedge",
    "flat_punch",
    "ring",
    "ridges",
    "waviness",
    "height_map",
    "rough",
    "sum",
];

/// Reads the shape of a body; `files` are the files that the scene may read.
pub(super) fn shape(body: &Section<'_>, files: &Files<'_>) -> Result<Shape, Fault> {
    let expected = "\"flat\" or a table such as { sphere = { R = radius in m } }";
    let value = body.require("shape", expected)?;
    shape_from_value(&body.path("shape"), value, files, expected)
}

/// Reads a shape: "flat", or a table whose entries are shapes that add up. `what` describes it in the error.
fn shape_from_value(
    key: &str,
    value: &Value,
    files: &Files<'_>,
    what: &str,
) -> Result<Shape, Fault> {
    match value {
        Value::String(word) if word == "flat" => Ok(Shape::Flat),
        Value::Table(table) if !table.is_empty() => {
            let shapes = Section::from_value(key.to_owned(), value, &SHAPES)?;
            let mut parts = Vec::with_capacity(table.len());
            for name in table.keys() {
                parts.push(named_shape(&shapes, name, files)?);
            }
            // One part stands for itself.
            Ok(if parts.len() == 1 {
                parts.remove(0)
            } else {
                Shape::Sum(parts)
            })
        }
        other => Err(Fault::value(key, other, what)),
    }
}

/// Reads the shape `name` (sphere, ellipsoid, cylinder, ...) with its parameters from its table.
fn named_shape(shapes: &Section<'_>, name: &str, files: &Files<'_>) -> Result<Shape, Fault> {
    let numbers = |keys: &[&str]| shapes.require_section(name, keys);
    let length = "a length in m";
    let slope = "the slope of the flank";
    Ok(match name {
        "sphere" => Shape::Sphere {
            R: numbers(&["R"])?.number("R", "the radius in m", &[])?,
        },
        "ellipsoid" => {
            let s = numbers(&["R_x", "R_y", "angle"])?;
            Shape::Ellipsoid {
                R_x: s.number("R_x", "a radius in m", &[])?,
                R_y: s.number("R_y", "a radius in m", &[])?,
                angle: s.number_or("angle", 0.0, &[])?,
            }
        }
        "cylinder" => {
            let s = numbers(&["R", "length", "angle"])?;
            Shape::Cylinder {
                R: s.number("R", "the radius in m", &[])?,
                length: s.number_or("length", f64::INFINITY, &[])?,
                angle: s.number_or("angle", 0.0, &[])?,
            }
        }
        "crowned_roller" => {
            let s = numbers(&["R", "length", "crown", "angle"])?;
            Shape::CrownedRoller {
                R: s.number("R", "the radius in m", &[])?,
                length: s.number("length", length, &[])?,
                crown: s.number("crown", "the radius of the crown in m", &[])?,
                angle: s.number_or("angle", 0.0, &[])?,
            }
        }
        "cone" => Shape::Cone {
            slope: numbers(&["slope"])?.number("slope", slope, &[])?,
        },
        "wedge" => {
            let s = numbers(&["slope", "angle"])?;
            Shape::Wedge {
                slope: s.number("slope", slope, &[])?,
                angle: s.number_or("angle", 0.0, &[])?,
            }
        }
        "flat_punch" => {
            let s = numbers(&["radius", "edge"])?;
            Shape::FlatPunch {
                radius: s.number("radius", length, &[])?,
                edge: s.number("edge", "the radius of the rounding in m", &[])?,
            }
        }
        "ring" => {
            let s = numbers(&["radius", "R"])?;
            Shape::Ring {
                radius: s.number("radius", "the radius of the circle in m", &[])?,
                R: s.number("R", "the radius of the cross-section in m", &[])?,
            }
        }
        "ridges" => {
            let s = numbers(&["R", "spacing", "count", "angle"])?;
            Shape::Ridges {
                R: s.number("R", "the radius in m", &[])?,
                spacing: s.number("spacing", length, &[])?,
                count: s.number_or("count", f64::INFINITY, &[])?,
                angle: s.number_or("angle", 0.0, &[])?,
            }
        }
        "waviness" => {
            let s = numbers(&["amplitude", "wavelength", "angle", "phase"])?;
            Shape::Waviness {
                amplitude: s.number("amplitude", length, &[])?,
                wavelength: s.number("wavelength", length, &[])?,
                angle: s.number_or("angle", 0.0, &[])?,
                phase: s.number_or("phase", 0.0, &[])?,
            }
        }
        "rough" => {
            let s = numbers(&["rms", "hurst", "longest", "shortest", "seed"])?;
            let seed = s.count_or("seed", 0, 0)?;
            Shape::Rough(Rough {
                rms: s.number("rms", length, &[])?,
                hurst: s.number("hurst", "a number above 0 and up to 1", &[])?,
                longest: s.number("longest", "a wavelength in m", &[])?,
                shortest: s.number("shortest", "a wavelength in m", &[])?,
                seed: u32::try_from(seed).map_err(|_| {
                    let key = s.path("seed");
                    Fault::new(&key, format!("{key} = {seed}: must be below 2^32"))
                })?,
            })
        }
        "height_map" => Shape::HeightMap(surface_map(&numbers(&MAP)?, files)?),
        _ => sum_of_shapes(shapes, files)?,
    })
}

/// Reads a list of shapes that add up.
fn sum_of_shapes(shapes: &Section<'_>, files: &Files<'_>) -> Result<Shape, Fault> {
    let expected = "a list of shapes";
    let (key, value) = (shapes.path("sum"), shapes.require("sum", expected)?);
    let parts = value
        .as_array()
        .ok_or_else(|| Fault::value(&key, value, expected))?;
    let parts = parts.iter().enumerate();
    parts
        .map(|(i, part)| shape_from_value(&format!("{key}[{i}]"), part, files, "a shape"))
        .collect::<Result<_, _>>()
        .map(Shape::Sum)
}

/// Reads the treatment of points of a file without a number.
fn missing_points(section: &Section<'_>) -> Result<Missing, Fault> {
    let Some(value) = section.get("missing") else {
        return Ok(Missing::default());
    };
    let expected = "\"refuse\", \"crop\" or \"fill\"";
    let word = value.as_str().and_then(Missing::from_word);
    word.ok_or_else(|| Fault::value(&section.path("missing"), value, expected))
}

/// The keys of numbers over the plane.
pub(super) const MAP: [&str; 7] = [
    "file", "z", "spacing", "missing", "channel", "filled", "unit",
];

/// Numbers from a file, or in the scene itself: a list along x of lists along y.
pub(super) fn surface_map(section: &Section<'_>, files: &Files<'_>) -> Result<SurfaceMap, Fault> {
    let expected = "the distance of the points in m, or two";
    let spacing = |value| {
        pair(&section.path("spacing"), value, |key, value| {
            super::measure::number(key, value, &[])
        })
    };
    if section.get("z").is_some() {
        return inline_map(section, spacing(section.require("spacing", expected)?)?);
    }
    let expected = "the name of a .npy file or a text of numbers";
    let file = section.require("file", expected)?;
    let key = section.path("file");
    let name = file
        .as_str()
        .ok_or_else(|| Fault::value(&key, file, expected))?;
    let word = |key: &str, what: &str| match section.get(key) {
        None => Ok(None),
        Some(Value::String(word)) => Ok(Some(word.clone())),
        Some(other) => Err(Fault::value(&section.path(key), other, what)),
    };
    let format = FileOfNumbers {
        spacing: section.get("spacing").map(spacing).transpose()?,
        unit: word("unit", "a unit of length in quotes, such as \"um\"")?,
        channel: word("channel", "the name of a column or channel in quotes")?,
        missing: missing_points(section)?,
    };
    let wrong = |e: &dyn std::fmt::Display| Fault::new(&key, format!("{key}: {e}"));
    let path = files.find(name).map_err(|e| wrong(&e))?;
    SurfaceMap::from_file(&path, &format).map_err(|e| wrong(&e))
}

/// Reads a surface map whose numbers `z` stand in the scene itself.
fn inline_map(section: &Section<'_>, spacing: (f64, f64)) -> Result<SurfaceMap, Fault> {
    let file_keys = ["file", "unit", "channel"];
    if let Some(key) = file_keys.into_iter().find(|key| section.get(key).is_some()) {
        let key = section.path(key);
        return Err(Fault::new(
            &key,
            format!("{key}: must be left out where z has the numbers, in SI units"),
        ));
    }
    let expected = "a list along x of lists along y of numbers, all of one length";
    let (key, value) = (section.path("z"), section.require("z", expected)?);
    let wrong = || Fault::new(&key, format!("{key}: must be {expected}"));
    let rows = value.as_array().ok_or_else(wrong)?;
    let mut heights = Vec::new();
    for row in rows {
        for z in row.as_array().ok_or_else(wrong)? {
            heights.push(super::measure::number(&key, z, &[])?);
        }
    }
    let shape = (rows.len(), heights.len() / rows.len().max(1));
    let values = Array2::from_shape_vec(shape, heights).map_err(|_| wrong())?;
    let missing = missing_points(section)?;
    let mut map = SurfaceMap::new(values, spacing, missing)
        .map_err(|e| Fault::new(&key, format!("{key}: {e}")))?;
    map.filled += section.count_or("filled", 0, 0)?;
    Ok(map)
}

/// The shape as a value of a scene file, every number in full.
pub(super) fn to_text(shape: &Shape) -> String {
    let fields = match shape {
        Shape::Flat => return "\"flat\"".to_owned(),
        Shape::Sum(parts) => {
            let parts: Vec<_> = parts.iter().map(to_text).collect();
            return format!("{{ sum = [{}] }}", parts.join(", "));
        }
        Shape::HeightMap(map) => map_text(map),
        Shape::Rough(rough) => format!(
            "rms = {:?}, hurst = {:?}, longest = {:?}, shortest = {:?}, seed = {}",
            rough.rms, rough.hurst, rough.longest, rough.shortest, rough.seed
        ),
        elementary => {
            let numbers = elementary.parameters();
            let numbers = numbers.iter().map(|(name, value, _)| {
                let name = name.rsplit('.').next().unwrap_or(name);
                format!("{name} = {value:?}")
            });
            numbers.collect::<Vec<_>>().join(", ")
        }
    };
    format!("{{ {} = {{ {fields} }} }}", shape.name())
}

/// The entries of a surface map in a scene file: spacing, number of filled points, and the rows of z.
pub(super) fn map_text(map: &SurfaceMap) -> String {
    let rows = map.values.rows().into_iter();
    let rows: Vec<_> = rows.map(|row| format!("{:?}", row.to_vec())).collect();
    let (x, y) = map.spacing;
    let filled = match map.filled {
        0 => String::new(),
        n => format!("filled = {n}, "),
    };
    format!(
        "spacing = [{x:?}, {y:?}], {filled}z = [{}]",
        rows.join(", ")
    )
}
