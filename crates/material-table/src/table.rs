//! Tables of materials: the one that comes with the program, and those of files.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::{Spanned, Value};

use crate::error::Error;
use crate::estimate::{Family, estimated};
use crate::material::{Material, Quantity, Sourced, known};

/// The form of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    schema: u32,
    #[serde(default)]
    sources: BTreeMap<String, String>,
    materials: BTreeMap<String, BTreeMap<String, Spanned<Value>>>,
}

/// The materials that come with the program.
pub fn materials() -> BTreeMap<String, Material> {
    read(include_str!("materials.toml"), "materials.toml").unwrap_or_default()
}

/// The materials of a text in the form of `materials.toml`; `file` is its name in errors.
pub fn read(text: &str, file: &str) -> Result<BTreeMap<String, Material>, Error> {
    let wrong = |at: usize, message: String| Error::Table {
        file: file.to_owned(),
        line: 1 + text[..at.min(text.len())].matches('\n').count(),
        message,
    };
    let parsed: File = toml::from_str(text)
        .map_err(|e| wrong(e.span().map_or(0, |s| s.start), e.message().to_owned()))?;
    if parsed.schema != 1 {
        return Err(wrong(0, format!("schema = {}: must be 1", parsed.schema)));
    }
    let mut materials = BTreeMap::new();
    for (name, entries) in parsed.materials {
        let mut material = Material {
            name: name.clone(),
            title: name.clone(),
            also: Vec::new(),
            numbers: BTreeMap::new(),
        };
        let mut family = None;
        for (key, entry) in entries {
            let refused = |message: String| {
                wrong(
                    entry.span().start,
                    format!("materials.{name}.{key}: {message}"),
                )
            };
            if key == "title" {
                let title = entry.get_ref().as_str();
                let title = title.ok_or_else(|| refused("must be a text".into()))?;
                title.clone_into(&mut material.title);
                continue;
            }
            if key == "also" {
                let names = entry.get_ref().as_array().and_then(|of| {
                    let texts = of.iter().map(|one| one.as_str().map(str::to_owned));
                    texts.collect::<Option<Vec<_>>>()
                });
                material.also = names.ok_or_else(|| refused("must be a list of names".into()))?;
                continue;
            }
            if key == "family" {
                let name = entry.get_ref().as_str();
                let name = name.ok_or_else(|| refused("must be a text".into()))?;
                family = Some(Family::named(name).map_err(|e| refused(e.to_string()))?);
                continue;
            }
            let quantity = known(&key).map_err(refused)?;
            let sourced = sourced(entry.get_ref(), quantity, &parsed.sources).map_err(refused)?;
            material.numbers.insert(quantity.name, sourced);
        }
        if let Some(family) = family {
            material = estimated(&material, family);
        }
        materials.insert(name, material);
    }
    Ok(materials)
}

/// The material of a name: of its own, or another one, whatever the case and the marks between its
/// letters and digits.
pub fn find<'a>(materials: &'a BTreeMap<String, Material>, name: &str) -> Option<&'a Material> {
    let wanted = plain(name);
    let is_it = |of: &&Material| {
        let mut names = std::iter::once(&of.name).chain(&of.also);
        names.any(|of| plain(of) == wanted)
    };
    materials
        .get(name)
        .or_else(|| materials.values().find(is_it))
}

/// The names that are nearest to one that is unknown, the nearest first.
pub fn nearest(materials: &BTreeMap<String, Material>, name: &str, most: usize) -> Vec<String> {
    let wanted = plain(name);
    let likeness = |of: &Material| {
        let names = std::iter::once(&of.name).chain(&of.also);
        let each = names.map(|name| strsim::jaro_winkler(&plain(name), &wanted));
        each.fold(0.0, f64::max)
    };
    let mut found: Vec<_> = (materials.values())
        .map(|of| (likeness(of), &of.name))
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let names = found.into_iter().take(most);
    names.map(|(_, name)| name.clone()).collect()
}

/// Letters and digits alone, in lower case.
fn plain(text: &str) -> String {
    let letters = text.chars().filter(char::is_ascii_alphanumeric);
    letters.map(|c| c.to_ascii_lowercase()).collect()
}

fn sourced(
    entry: &Value,
    quantity: &Quantity,
    sources: &BTreeMap<String, String>,
) -> Result<Sourced, String> {
    const FORM: &str = "must be { value = NUMBER, source = \"where it is from\" }";
    let table = entry.as_table().filter(|t| t.len() == 2).ok_or(FORM)?;
    let value = table.get("value").ok_or(FORM)?;
    let value = value
        .as_float()
        .or_else(|| value.as_integer().map(|n| n as f64));
    let value = value.ok_or(FORM)?;
    let source = table.get("source").and_then(Value::as_str).ok_or(FORM)?;
    let source = sources.get(source).map_or(source, String::as_str);
    Sourced::new(value, source.to_owned(), quantity)
}
