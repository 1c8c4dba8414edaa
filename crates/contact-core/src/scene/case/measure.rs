//! Numbers in other measures than SI: tables of one key.

use toml::Value;

use super::fault::Fault;

/// A measure that a number may be given in.
#[derive(Clone, Copy)]
pub struct Measure {
    /// Name, such as `a_H`.
    name: &'static str,
    /// Its value in SI, or why it has none.
    value: Result<f64, &'static str>,
}

const NAMES: [&str; 4] = ["a_H", "p_H", "mu_W", "E_substrate"];
const NO_HERTZ: &str = "the uncoated bodies form no Hertz contact under the loads of the path";

/// Whether the name is that of a measure.
pub(super) fn is_name(name: &str) -> bool {
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

    /// Young's modulus of the body's own substrate \[Pa\].
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

/// The number in SI: given as such, or in one of the measures.
pub(super) fn number(key: &str, value: &Value, measures: &[Measure]) -> Result<f64, Fault> {
    let plain = match value {
        Value::Float(x) => Some(*x),
        Value::Integer(n) => Some(*n as f64),
        _ => None,
    };
    if let Some(x) = plain.filter(|x| !x.is_nan()) {
        return Ok(x);
    }
    let Some((name, inner)) = value
        .as_table()
        .filter(|table| table.len() == 1 && !measures.is_empty())
        .and_then(|table| table.iter().next())
    else {
        return Err(Fault::value(key, value, &allowed(measures)));
    };
    let Some(measure) = measures.iter().find(|m| m.name == name) else {
        return Err(Fault::value(key, value, &allowed(measures)));
    };
    let factor = number(&format!("{key}.{name}"), inner, &[])?;
    let unit = measure
        .value
        .map_err(|why| Fault::new(key, format!("{key} is given in {name}, but {why}")))?;
    Ok(factor * unit)
}

fn allowed(measures: &[Measure]) -> String {
    if measures.is_empty() {
        return "a number".to_owned();
    }
    let tables: Vec<_> = measures
        .iter()
        .map(|measure| format!("{{ {} = number }}", measure.name))
        .collect();
    format!("a number in SI units, or {}", tables.join(" or "))
}
