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
/// letters and digits. In a chemical formula the case counts: TiN is titanium nitride, tin a metal.
pub fn find<'a>(materials: &'a BTreeMap<String, Material>, name: &str) -> Option<&'a Material> {
    let wanted = plain(name);
    let is_it = |of: &&Material| {
        let mut names = std::iter::once(&of.name).chain(&of.also);
        names.any(|of| plain(of) == wanted && (!is_formula(of) || letters(of) == letters(name)))
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

/// Letters and digits alone.
fn letters(text: &str) -> String {
    text.chars().filter(char::is_ascii_alphanumeric).collect()
}

/// Letters and digits alone, in lower case.
fn plain(text: &str) -> String {
    letters(text).to_ascii_lowercase()
}

/// Symbols of the chemical elements to 92, uranium.
const ELEMENTS: [&str; 92] = [
    "H", "He", "Li", "Be", "B", "C", "N", "O", "F", "Ne", "Na", "Mg", "Al", "Si", "P", "S", "Cl",
    "Ar", "K", "Ca", "Sc", "Ti", "V", "Cr", "Mn", "Fe", "Co", "Ni", "Cu", "Zn", "Ga", "Ge", "As",
    "Se", "Br", "Kr", "Rb", "Sr", "Y", "Zr", "Nb", "Mo", "Tc", "Ru", "Rh", "Pd", "Ag", "Cd", "In",
    "Sn", "Sb", "Te", "I", "Xe", "Cs", "Ba", "La", "Ce", "Pr", "Nd", "Pm", "Sm", "Eu", "Gd", "Tb",
    "Dy", "Ho", "Er", "Tm", "Yb", "Lu", "Hf", "Ta", "W", "Re", "Os", "Ir", "Pt", "Au", "Hg", "Tl",
    "Pb", "Bi", "Po", "At", "Rn", "Fr", "Ra", "Ac", "Th", "Pa", "U",
];

/// Whether a name is a chemical formula of letters alone, such as TiN: symbols of elements, with letters
/// of both cases. A number in it leaves no other word to take it for.
fn is_formula(name: &str) -> bool {
    let has = |is: fn(&char) -> bool| name.chars().any(|c| is(&c));
    let of_symbols = |name: &str| {
        let mut symbols = name;
        while !symbols.is_empty() {
            let symbol = |n: &usize| {
                symbols
                    .get(..*n)
                    .is_some_and(|start| ELEMENTS.contains(&start))
            };
            let Some(length) = [2, 1].into_iter().find(symbol) else {
                return false;
            };
            symbols = &symbols[length..];
        }
        true
    };
    has(char::is_ascii_lowercase) && has(char::is_ascii_uppercase) && of_symbols(name)
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

#[cfg(test)]
mod tests {
    use super::{find, is_formula, materials, nearest};

    /// Every name of the table in lower and upper case: a formula is found in its case alone, and its
    /// right spelling is the nearest name; other names are found in any.
    #[test]
    fn case_counts_in_formulas_alone() {
        let table = materials();
        for (key, material) in &table {
            for name in std::iter::once(key).chain(&material.also) {
                assert_eq!(find(&table, name).map(|of| &of.name), Some(key), "{name}");
                for other in [name.to_ascii_lowercase(), name.to_ascii_uppercase()] {
                    if is_formula(name) && other != *name {
                        assert_eq!(find(&table, &other), None, "{other}");
                        assert_eq!(nearest(&table, &other, 1), [key.as_str()], "{other}");
                    } else {
                        assert_eq!(
                            find(&table, &other).map(|of| &of.name),
                            Some(key),
                            "{other}"
                        );
                    }
                }
            }
        }
        let formulas = ["TiN", "CrN", "AlN", "SiC", "Al"];
        assert!(formulas.into_iter().all(is_formula));
        let others = [
            "DLC", "steel", "Steel", "Inconel", "WC", "tin", "Ti6Al4V", "C45",
        ];
        assert!(!others.into_iter().any(is_formula));
        assert!(find(&table, "tin").is_none() && find(&table, "TiN").is_some());
    }
}
