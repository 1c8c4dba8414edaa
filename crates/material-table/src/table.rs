//! Tables of materials: the one that comes with the program, and tables in files.

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
            kind: String::new(),
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
            if key == "kind" {
                let kind = entry.get_ref().as_str();
                let kind = kind.ok_or_else(|| refused("must be a text".into()))?;
                kind.clone_into(&mut material.kind);
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
/// letters and digits. In a chemical formula the case counts, and in a name that differs from a formula
/// in its case alone: TiN is titanium nitride, tin a metal, and TIN is refused.
pub fn find<'a>(materials: &'a BTreeMap<String, Material>, name: &str) -> Option<&'a Material> {
    let wanted = plain(name);
    let names_of = |m: &'a Material| std::iter::once(&m.name).chain(&m.also).map(move |n| (n, m));
    let every_name = materials.values().flat_map(names_of);
    let alike: Vec<_> = every_name.filter(|(n, _)| plain(n) == wanted).collect();
    let same_case = alike.iter().find(|(n, _)| letters(n) == letters(name));
    let any_case = alike
        .first()
        .filter(|_| !alike.iter().any(|(n, _)| is_formula(n)));
    materials
        .get(name)
        .or_else(|| same_case.or(any_case).map(|(_, material)| *material))
}

/// Likeness from which on a name is a slip of the pen in the nearest one, whatever its kind.
const CLOSE: f64 = 0.95;

/// The names that are nearest to one that is unknown, of one kind, the nearest first: metals for the
/// symbol of an element, ceramics and coatings for a compound, else the kind of the nearest name.
pub fn nearest(materials: &BTreeMap<String, Material>, name: &str, most: usize) -> Vec<String> {
    let wanted = plain(name);
    let likeness = |of: &Material| {
        let names = std::iter::once(&of.name).chain(&of.also);
        let each = names.map(|name| strsim::jaro_winkler(&plain(name), &wanted));
        each.fold(0.0, f64::max)
    };
    let mut found: Vec<_> = (materials.values()).map(|of| (likeness(of), of)).collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let likeness_of_nearest = found.first().map_or(0.0, |(likeness, _)| *likeness);
    let exact = likeness_of_nearest == 1.0;
    let nearest_kind = found.first().map_or("", |(_, of)| of.kind.as_str());
    let is_of_kind = |of: &Material| match name {
        _ if exact => of.kind == nearest_kind,
        name if ELEMENTS.contains(&name) => METALS.contains(&of.kind.as_str()),
        name if is_compound(name) && likeness_of_nearest < CLOSE => {
            COMPOUNDS.contains(&of.kind.as_str())
        }
        _ => of.kind == nearest_kind,
    };
    if found.iter().any(|(_, of)| is_of_kind(of)) {
        found.retain(|(_, of)| is_of_kind(of));
    }
    let names = found.into_iter().take(most);
    names.map(|(_, of)| of.name.clone()).collect()
}

/// Kinds of elements, and of compounds.
const METALS: [&str; 1] = ["metal"];
const COMPOUNDS: [&str; 2] = ["ceramic", "coating"];

/// Whether a name is the formula of a compound, numbers of atoms included: TiC, B4C, Al2O3.
fn is_compound(name: &str) -> bool {
    let symbols: String = name.chars().filter(char::is_ascii_alphabetic).collect();
    let counted = name.len() > symbols.len() && name.chars().all(|c| c.is_ascii_alphanumeric());
    let starts = name.starts_with(|c: char| c.is_ascii_uppercase());
    (is_formula(&symbols) || counted && starts && of_symbols(&symbols)) && !ELEMENTS.contains(&name)
}

/// Whether a name is a formula: symbols of elements alone.
fn of_symbols(name: &str) -> bool {
    let mut symbols = name;
    while !symbols.is_empty() {
        let is_symbol = |n: &usize| {
            symbols
                .get(..*n)
                .is_some_and(|start| ELEMENTS.contains(&start))
        };
        let Some(length) = [2, 1].into_iter().find(is_symbol) else {
            return false;
        };
        symbols = &symbols[length..];
    }
    true
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
    has(char::is_ascii_lowercase) && has(char::is_ascii_uppercase) && of_symbols(name)
}

/// Reads the entry of a number: its value and its source, by the key of `sources`.
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
    use super::{find, is_formula, materials, nearest, plain};
    use crate::material::Material;

    /// Every name of the table in lower and upper case: a formula is found in its case alone, and its
    /// right spelling is the nearest name; other names are found in any.
    #[test]
    fn case_counts_in_formulas_alone() {
        let table = materials();
        for (key, material) in &table {
            for name in std::iter::once(key).chain(&material.also) {
                assert_eq!(find(&table, name).map(|of| &of.name), Some(key), "{name}");
                for other in [name.to_ascii_lowercase(), name.to_ascii_uppercase()] {
                    let of_formula = |m: &Material| {
                        let mut names = std::iter::once(&m.name).chain(&m.also);
                        names.any(|n| is_formula(n) && plain(n) == plain(&other))
                    };
                    if table.values().any(of_formula) && other != *name {
                        let exact = |m: &&Material| m.name == other || m.also.contains(&other);
                        let right = table.values().find(exact).map(|of| &of.name);
                        assert_eq!(find(&table, &other).map(|of| &of.name), right, "{other}");
                        let near = nearest(&table, &other, 1).remove(0);
                        assert!(
                            of_formula(&table[&near]) || right.is_some(),
                            "{other}: {near}"
                        );
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
        let name = |text: &str| find(&table, text).map(|of| of.name.as_str());
        assert_eq!((name("tin"), name("TiN")), (Some("tin_metal"), Some("TiN")));
        assert_eq!((name("TIN"), name("Tin")), (None, None));
    }

    /// An unknown name is answered with names of its own kind.
    #[test]
    fn the_nearest_are_of_one_kind() {
        let table = materials();
        assert!(table.values().all(|of| !of.kind.is_empty()));
        assert_eq!(find(&table, "Cr").unwrap().name, "chromium");
        for (name, kinds) in [
            ("Mo", &["metal"][..]),
            ("Co", &["metal"]),
            ("Zn", &["metal"]),
            ("TiC", &["ceramic", "coating"]),
            ("B4C", &["ceramic", "coating"]),
            ("CrAlN", &["ceramic", "coating"]),
            ("steel_4330", &["steel"]),
            ("bras", &["metal"]),
            ("zirkonia", &["ceramic"]),
            ("PTFEE", &["polymer"]),
        ] {
            assert!(find(&table, name).is_none(), "{name}");
            let near = nearest(&table, name, 3);
            let is_right = |n: &String| kinds.contains(&table[n].kind.as_str());
            assert!(
                !near.is_empty() && near.iter().all(is_right),
                "{name}: {near:?}"
            );
        }
    }
}
