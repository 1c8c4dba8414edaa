//! The friction law of a scene file.

use toml::Value;

use super::fault::Fault;
use super::section::Section;
use super::shape::{MAP, map_text, surface_map};
use crate::scene::files::Files;
use crate::scene::{BedFriction, Friction, FrictionHistory, History, UserFriction};

/// The word for a user's law.
const OWN: &str = "own";
/// The words of the histories.
const HISTORIES: [(&str, History); 4] = [
    ("slip", History::Slip),
    ("dissipated", History::Dissipated),
    ("increment", History::Increment),
    ("cycles", History::Cycles),
];

/// Reads the section `[friction]`: coefficient, map, history, levels, user's law.
pub(super) fn friction(root: &Section<'_>, files: &Files<'_>) -> Result<Friction, Fault> {
    let mut friction = Friction::coulomb(f64::INFINITY);
    let coefficients = friction.coefficients_mut().map(|(key, _)| key);
    let keys = [
        &["mu"],
        &coefficients[..],
        &["map", "history", "layers", "bed", "law"],
    ]
    .concat();
    let section = root.require_section("friction", &keys)?;
    let expected = "a number >= 0, or \"stick\" for no slip";
    let layers = section.numbers("layers", "a list of coefficients, one for each layer")?;
    let mu = match section.get("mu") {
        None if !layers.is_empty() => layers[0],
        _ => mu_of(&section, expected)?,
    };
    for (key, coefficient) in friction.coefficients_mut() {
        let present = section.get(key);
        let coefficient_if_present = present.map(|_| section.number(key, "a positive number", &[]));
        *coefficient = coefficient_if_present.transpose()?;
    }
    // Its numbers have no unit.
    let map = section.section("map", &MAP[..MAP.len() - 1])?;
    Ok(Friction {
        mu,
        map: map.map(|map| surface_map(&map, files)).transpose()?,
        history: friction_history(&section)?,
        layers,
        bed: bed_friction(&section)?,
        law: user_law(&section)?,
        ..friction
    })
}

/// Reads how friction depends on the thickness of a bed of debris; none where it does not.
fn bed_friction(friction: &Section<'_>) -> Result<Option<BedFriction>, Fault> {
    let Some(section) = friction.section("bed", &["mu", "thickness"])? else {
        return Ok(None);
    };
    Ok(Some(BedFriction {
        mu: section.number("mu", "a coefficient above 0", &[])?,
        thickness: section.number("thickness", "a number above 0 in m", &[])?,
    }))
}

/// Reads the coefficient `mu`: a number, or the word for a contact that never slips. `expected` describes this
/// in the error.
fn mu_of(section: &Section<'_>, expected: &str) -> Result<f64, Fault> {
    let mu = match section.require("mu", expected)? {
        Value::String(word) if word == "stick" => f64::INFINITY,
        Value::String(_) => {
            return Err(Fault::value(
                "friction.mu",
                section.require("mu", expected)?,
                expected,
            ));
        }
        _ => section.number("mu", expected, &[])?,
    };
    if mu.is_infinite() && section.get("mu").is_some_and(|mu| !mu.is_str()) {
        let finite = "a finite number >= 0, or \"stick\" for no slip";
        return Err(Fault::value(
            "friction.mu",
            section.require("mu", expected)?,
            finite,
        ));
    }
    Ok(mu)
}

/// Reads the word for a user's law, which no file can hold.
fn user_law(friction: &Section<'_>) -> Result<Option<UserFriction>, Fault> {
    match friction.get("law") {
        None => Ok(None),
        Some(Value::String(word)) if word == OWN => Ok(Some(UserFriction::unavailable())),
        Some(other) => {
            let expected = "\"own\": it is a function, given in Python or Rust";
            Err(Fault::value("friction.law", other, expected))
        }
    }
}

/// Reads how the coefficient depends on the history of a cell; none where it does not.
fn friction_history(friction: &Section<'_>) -> Result<Option<FrictionHistory>, Fault> {
    let Some(section) = friction.section("history", &["of", "table"])? else {
        return Ok(None);
    };
    let variable = section.choice("of", &HISTORIES)?;
    let table = section.pairs("table", "a list of pairs [history, factor]")?;
    Ok(Some(FrictionHistory {
        of: variable,
        table,
    }))
}

/// The friction law as the lines of its section in a scene file.
pub(super) fn to_text(friction: &Friction) -> String {
    let mut lines = vec![if friction.mu.is_finite() {
        format!("mu = {:?}", friction.mu)
    } else {
        "mu = \"stick\"".to_owned()
    }];
    let coefficients = friction.coefficients();
    lines.extend(coefficients.map(|(key, mu)| format!("{key} = {mu:?}")));
    if !friction.layers.is_empty() {
        lines.push(format!("layers = {:?}", friction.layers));
    }
    let bed = friction.bed.as_ref();
    lines.extend(bed.map(|BedFriction { mu, thickness }| {
        format!("bed = {{ mu = {mu:?}, thickness = {thickness:?} }}")
    }));
    lines.extend(friction.law.as_ref().map(|_| format!("law = \"{OWN}\"")));
    let map = friction.map.as_ref();
    lines.extend(map.map(|map| format!("map = {{ {} }}", map_text(map))));
    if let Some(FrictionHistory { of, table }) = &friction.history {
        let word = HISTORIES.iter().find(|(_, history)| history == of);
        let word = word.map_or("", |(word, _)| word);
        let pairs: Vec<_> = table
            .iter()
            .map(|(at, f)| format!("[{at:?}, {f:?}]"))
            .collect();
        let table = pairs.join(", ");
        lines.push(format!(
            "history = {{ of = \"{word}\", table = [{table}] }}"
        ));
    }
    lines.join("\n")
}
