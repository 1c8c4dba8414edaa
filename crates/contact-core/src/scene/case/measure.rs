//! Numbers in other measures than SI, as tables of one key; numbers in other units, as texts.

use plausible::unit::times;
use toml::Value;

use super::fault::Fault;
use crate::scene::number_files::{Kind, named, names};

/// A measure that a number may be given in.
#[derive(Clone, Copy)]
pub struct Measure {
    /// Name, such as `a_H`.
    name: &'static str,
    /// Its value in SI, or the reason why it has none.
    value: Result<f64, &'static str>,
}

const NAMES: [&str; 4] = ["a_H", "p_H", "mu_W", "E_substrate"];
const NO_HERTZ: &str = "the uncoated bodies form no Hertz contact under the loads of the path";

/// Whether the name is a measure.
pub(super) fn is_measure(name: &str) -> bool {
    NAMES.contains(&name)
}

impl Measure {
    /// Hertz contact radius of the uncoated pair at the largest W \[m\].
    pub(super) fn a_H(value: Option<f64>) -> Self {
        Self {
            name: "a_H",
            value: value.ok_or(NO_HERTZ),
        }
    }

    /// Hertz peak pressure of the uncoated pair at the largest W \[Pa\].
    pub(super) fn p_H(value: Option<f64>) -> Self {
        Self {
            name: "p_H",
            value: value.ok_or(NO_HERTZ),
        }
    }

    /// Largest force that friction can carry \[N\].
    pub(super) fn mu_W(value: f64) -> Self {
        Self {
            name: "mu_W",
            value: Ok(value),
        }
    }

    /// Young's modulus of the substrate of the same body \[Pa\].
    pub(super) fn E_substrate(value: f64) -> Self {
        Self {
            name: "E_substrate",
            value: if value.is_finite() {
                Ok(value)
            } else {
                Err("the substrate is rigid")
            },
        }
    }
}

/// The kind of quantity of a key, `grid.spacing[1]`; none of a number without a unit.
fn kind_of(key: &str) -> Option<Kind> {
    let kind = plausible::of_key(key)?.kind;
    (kind != Kind::Number).then_some(kind)
}

/// Splits a text into a number and the word behind it, `3 um`.
fn split_unit(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let digit = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let mut end = text.find(|c| !digit(c)).unwrap_or(text.len());
    // The e of `3 eV` belongs to the word, the e of `3e9 Pa` to the number.
    while end > 0 {
        if let Ok(number) = text[..end].parse() {
            return Some((number, text[end..].trim()));
        }
        end -= 1;
    }
    None
}

/// Whether a text is a number with a word behind it that is a unit or a measure.
pub(super) fn has_unit(text: &str) -> bool {
    split_unit(text).is_some_and(|(_, word)| is_measure(word) || named(word).is_some())
}

/// Reads a number in SI: a plain number, a text with its unit, or a number in one of the measures.
pub(super) fn number(key: &str, value: &Value, measures: &[Measure]) -> Result<f64, Fault> {
    number_of_quantity(key, key, value, measures)
}

/// Reads a number as [`number`] does, with the units of the key `name`, such as a depth in a table.
pub(super) fn number_of_quantity(
    key: &str,
    name: &str,
    value: &Value,
    measures: &[Measure],
) -> Result<f64, Fault> {
    let plain = match value {
        Value::Float(x) => Some(*x),
        Value::Integer(n) => Some(*n as f64),
        _ => None,
    };
    if let Some(x) = plain.filter(|x| !x.is_nan()) {
        return Ok(x);
    }
    let kind = kind_of(name);
    let wrong = || Fault::value(key, value, &describe_allowed(kind, measures));
    let in_measure = |name: &str, number: f64| {
        let measure = measures.iter().find(|m| m.name == name).ok_or_else(wrong)?;
        // The fault lies in the values that the measure follows from.
        let fault = |why| Fault {
            is_of_meaning: true,
            ..Fault::new(key, format!("{key} is given in {name}, but {why}"))
        };
        Ok(number * measure.value.map_err(fault)?)
    };
    match value {
        Value::String(text) => {
            let (number, word) = split_unit(text).ok_or_else(wrong)?;
            match kind.and_then(|kind| kind.size(word)) {
                Some(size) => Ok(times(number, size)),
                None => in_measure(word, number),
            }
        }
        Value::Table(table) if table.len() == 1 && !measures.is_empty() => {
            let Some((name, inner)) = table.iter().next() else {
                return Err(wrong());
            };
            if !measures.iter().any(|m| m.name == name) {
                return Err(wrong());
            }
            in_measure(name, self::number(&format!("{key}.{name}"), inner, &[])?)
        }
        _ => Err(wrong()),
    }
}

/// Converts a text with a unit to SI, by the name of the quantity in a scene file, such as `E`; the
/// error is what is allowed.
pub fn quantity(name: &str, text: &str) -> Result<f64, String> {
    let value = Value::String(text.to_owned());
    number(name, &value, &[]).map_err(|_| describe_allowed(kind_of(name), &[]))
}

/// Converts a text with a unit to SI; returns the number and its SI unit.
pub fn convert_to_si(text: &str) -> Option<(f64, &'static str)> {
    let (number, word) = split_unit(text)?;
    let (kind, size) = plausible::unit::named(word)?;
    Some((times(number, size), kind.unit()))
}

/// Reads the load of a contact: a force per length, `300 N/mm`, if and only if cells are infinitely
/// long along y and forces are integrals over a `width` \[m\].
pub(super) fn load(
    key: &str,
    value: &Value,
    measures: &[Measure],
    width: Option<f64>,
) -> Result<f64, Fault> {
    let word = value
        .as_str()
        .and_then(split_unit)
        .map_or("", |(_, word)| word);
    let per_length = word.contains('/');
    let load = number(key, value, measures)?;
    let allowed = match (width, Kind::Force.size(word).is_some()) {
        (Some(width), true) if per_length => return Ok(load * width),
        (Some(1.0), true) => "a force per length, such as N/m or N/mm: the contact is a line",
        (None, true) if per_length => "a force, such as N or kN: the contact is no line",
        _ => return Ok(load),
    };
    Err(Fault::value(key, value, allowed))
}

/// Describes for an error what a number may be: its unit, texts with a unit, and measures.
fn describe_allowed(kind: Option<Kind>, measures: &[Measure]) -> String {
    let mut allowed = match kind {
        None if measures.is_empty() => return "a number".to_owned(),
        None => "a number in SI units".to_owned(),
        Some(kind) if names(kind).is_empty() => format!("a number in {}", kind.unit()),
        Some(kind) => format!(
            "a number in {}, a text with its unit ({})",
            kind.unit(),
            names(kind)
        ),
    };
    for measure in measures {
        allowed = format!("{allowed}, or {{ {} = number }}", measure.name);
    }
    allowed
}

#[cfg(test)]
mod tests {
    use toml::Value;

    use super::{Measure, number};

    fn read(key: &str, text: &str) -> Result<f64, String> {
        let measures = [Measure::a_H(Some(2e-4))];
        let value = Value::String(text.to_owned());
        number(key, &value, &measures).map_err(|fault| fault.message)
    }

    #[test]
    fn a_text_with_a_unit_is_a_number_in_si() {
        for (key, text, right) in [
            ("body1.E", "380 GPa", 380e9),
            ("body1.E", "2.1e5 N/mm^2", 2.1e11),
            ("body2.coatings[0].thickness", "3 um", 3e-6),
            ("body2.coatings[0].thickness", "20 um", 20e-6),
            ("body2.coatings[0].thickness", "0.7 nm", 0.7e-9),
            ("body2.coatings[0].thickness", "3µm", 3e-6),
            ("grid.extent", "2.4 a_H", 4.8e-4),
            ("grid.spacing[1]", "1 um", 1e-6),
            ("path[0].W", "10 N", 10.0),
            ("path[0].W", "300 N/mm", 3e5),
            ("path[3].phi_z", "180 deg", std::f64::consts::PI),
            ("rig.stiffness", "24 N/um", 24e6),
            ("wear.frequency", "2 kHz", 2e3),
        ] {
            let number = read(key, text).unwrap();
            assert_eq!(number, right, "{key} = {text}");
        }
    }

    #[test]
    fn a_text_without_the_right_unit_is_refused() {
        for (key, text, allowed) in [
            (
                "body1.E",
                "380 N",
                "a number in Pa, a text with its unit (Pa, ",
            ),
            ("body1.E", "380", "a number in Pa"),
            ("body1.E", "GPa", "a number in Pa"),
            ("body1.E", "nan Pa", "a number in Pa"),
            ("body1.nu", "0.3 m", "a number"),
            ("body1.nu", "0.3", "a number"),
            ("path[0].W", "10 Nm", "a number in N, a text"),
            ("grid.extent", "2 p_H", "or { a_H = number }"),
        ] {
            let message = read(key, text).unwrap_err();
            assert!(message.contains(allowed), "{message}");
        }
    }
}
