//! Tables of the scene file, read key by key.

use toml::{Table, Value};

use super::fault::Fault;
use super::measure::{self, Measure};
use super::synonyms::{meant_key, nearest};
use crate::shown::abridge;

/// A table of the file with its place in it.
pub struct Section<'a> {
    key: String,
    table: &'a Table,
}

impl<'a> Section<'a> {
    /// The whole file.
    pub fn root(table: &'a Table, allowed: &[&str]) -> Result<Self, Fault> {
        Self::new(String::new(), table, allowed)
    }

    /// A table with no other keys than the allowed ones.
    fn new(key: String, table: &'a Table, allowed: &[&str]) -> Result<Self, Fault> {
        let section = Self { key, table };
        match table.keys().find(|k| !allowed.contains(&k.as_str())) {
            None => Ok(section),
            Some(unknown) => {
                let key = section.path(unknown);
                let foreign = meant_key(unknown, &section.key, allowed);
                let nearest = match &foreign {
                    Some(key) => allowed
                        .iter()
                        .find(|&&name| section.path(name) == *key)
                        .map(|&name| name.to_owned()),
                    None => nearest(unknown, allowed),
                };
                let hint = match foreign.or_else(|| nearest.as_ref().map(|name| section.path(name)))
                {
                    Some(key) => format!("the nearest valid key is `{key}`{}", names(allowed)),
                    None => "no key is allowed here".to_owned(),
                };
                let message = format!("unknown key `{}`: {hint}", abridge(&key));
                Err(Fault {
                    is_unknown: true,
                    nearest,
                    ..Fault::new(key, message)
                })
            }
        }
    }

    /// The table `value` at `key` as a section; fails if it is no table or has other keys than `allowed`.
    pub(crate) fn from_value(
        key: String,
        value: &'a Value,
        allowed: &[&str],
    ) -> Result<Self, Fault> {
        match value {
            Value::Table(table) => Self::new(key, table, allowed),
            value => Err(Fault::value(
                &key,
                value,
                &format!("a table of {}", allowed.join(", ")),
            )),
        }
    }

    /// The full key of an entry.
    pub fn path(&self, name: &str) -> String {
        if self.key.is_empty() {
            name.to_owned()
        } else {
            format!("{}.{name}", self.key)
        }
    }

    /// The value of a key, if it is there.
    pub fn get(&self, name: &str) -> Option<&'a Value> {
        self.table.get(name)
    }

    /// The entry, which must be there.
    pub(crate) fn require(&self, name: &str, what: &str) -> Result<&'a Value, Fault> {
        self.get(name).ok_or_else(|| {
            let key = self.path(name);
            Fault::new(&key, format!("{key} is missing: it must be {what}"))
        })
    }

    /// A table inside; none where it is missing.
    pub fn section(&self, name: &str, allowed: &[&str]) -> Result<Option<Self>, Fault> {
        self.get(name)
            .map(|value| Self::from_value(self.path(name), value, allowed))
            .transpose()
    }

    /// A table inside, which must be there.
    pub fn require_section(&self, name: &str, allowed: &[&str]) -> Result<Self, Fault> {
        let value = self.require(name, &format!("a table of {}", allowed.join(", ")))?;
        Self::from_value(self.path(name), value, allowed)
    }

    /// The tables of the list `name`, each with the keys `allowed`; no tables where the list is missing.
    pub fn sections(&self, name: &str, allowed: &[&str]) -> Result<Vec<Self>, Fault> {
        let Some(value) = self.get(name) else {
            return Ok(Vec::new());
        };
        let key = self.path(name);
        let list = value
            .as_array()
            .ok_or_else(|| Fault::value(&key, value, &format!("a list of tables, [[{key}]]")))?;
        list.iter()
            .enumerate()
            .map(|(i, item)| Self::from_value(format!("{key}[{i}]"), item, allowed))
            .collect()
    }

    /// Reads the list `name` of pairs of numbers; `what` describes it in the error.
    pub fn pairs(&self, name: &str, what: &str) -> Result<Vec<(f64, f64)>, Fault> {
        let (key, value) = (self.path(name), self.require(name, what)?);
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
        pairs.collect()
    }

    /// Reads the list `name` of numbers; empty where it is missing. `what` describes it in the error.
    pub fn numbers(&self, name: &str, what: &str) -> Result<Vec<f64>, Fault> {
        let (key, value) = (self.path(name), self.get(name));
        let Some(value) = value else {
            return Ok(Vec::new());
        };
        let list = value.as_array().filter(|list| !list.is_empty());
        let list = list.ok_or_else(|| Fault::value(&key, value, what))?;
        list.iter().map(|v| measure::number(&key, v, &[])).collect()
    }

    /// A number that must be there, in one of its measures; `what` describes it in the error.
    pub fn number(&self, name: &str, what: &str, measures: &[Measure]) -> Result<f64, Fault> {
        measure::number(&self.path(name), self.require(name, what)?, measures)
    }

    /// A number, or its default where it is left out.
    pub fn number_or(&self, name: &str, default: f64, measures: &[Measure]) -> Result<f64, Fault> {
        Ok(self.number_if(name, measures)?.unwrap_or(default))
    }

    /// A number that may be left out.
    pub fn number_if(&self, name: &str, measures: &[Measure]) -> Result<Option<f64>, Fault> {
        let number = |value| measure::number(&self.path(name), value, measures);
        self.get(name).map(number).transpose()
    }

    /// A whole number of at least `least`.
    pub fn count(&self, name: &str, least: i64) -> Result<usize, Fault> {
        let expected = format!("a whole number >= {least}");
        count(&self.path(name), self.require(name, &expected)?, least)
    }

    /// A whole number of at least `least`, or its default where it is left out.
    pub(crate) fn count_or(&self, name: &str, least: i64, default: usize) -> Result<usize, Fault> {
        self.get(name)
            .map_or(Ok(default), |value| count(&self.path(name), value, least))
    }

    /// True or false, or the default where it is left out.
    pub(crate) fn flag_or(&self, name: &str, default: bool) -> Result<bool, Fault> {
        self.get(name).map_or(Ok(default), |value| {
            value
                .as_bool()
                .ok_or_else(|| Fault::value(&self.path(name), value, "true or false"))
        })
    }

    /// Reads a word and returns the value of that choice; where the word is missing, the first choice.
    pub fn choice<T: Copy>(&self, name: &str, choices: &[(&str, T)]) -> Result<T, Fault> {
        let Some(value) = self.get(name) else {
            return Ok(choices[0].1);
        };
        let chosen = choices
            .iter()
            .find(|(word, _)| value.as_str() == Some(word));
        chosen.map(|(_, choice)| *choice).ok_or_else(|| {
            let words: Vec<_> = choices.iter().map(|(w, _)| format!("\"{w}\"")).collect();
            Fault::value(&self.path(name), value, &words.join(" or "))
        })
    }
}

/// The allowed names, in brackets.
fn names(allowed: &[&str]) -> String {
    if allowed.is_empty() {
        String::new()
    } else {
        format!(" (of {})", allowed.join(", "))
    }
}

/// A whole number of at least `least`.
pub(crate) fn count(key: &str, value: &Value, least: i64) -> Result<usize, Fault> {
    value
        .as_integer()
        .filter(|n| *n >= least)
        .and_then(|n| usize::try_from(n).ok())
        .ok_or_else(|| Fault::value(key, value, &format!("a whole number >= {least}")))
}

/// One value for both directions, or a pair along x and y.
pub(crate) fn pair<T: Copy>(
    key: &str,
    value: &Value,
    read: impl Fn(&str, &Value) -> Result<T, Fault>,
) -> Result<(T, T), Fault> {
    match value {
        Value::Array(items) => match items.as_slice() {
            [x, y] => Ok((
                read(&format!("{key}[0]"), x)?,
                read(&format!("{key}[1]"), y)?,
            )),
            _ => Err(Fault::value(key, value, "one value, or two along x and y")),
        },
        value => read(key, value).map(|one| (one, one)),
    }
}
