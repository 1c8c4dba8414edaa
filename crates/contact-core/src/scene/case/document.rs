//! The TOML document: changed by settings, and asked for the line of a key.

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use super::fault::Fault;
use super::measure;
use super::synonyms::full_key;
use crate::error::Error;
use crate::shown::abridge;

/// A scene file with the settings applied.
pub(super) struct Document<'a> {
    text: &'a str,
    file: &'a str,
    settings: &'a [String],
    /// The file's own values with their places.
    places: Spanned<DeTable<'a>>,
    root: Table,
}

impl<'a> Document<'a> {
    /// Parses the text and applies the settings (`key=value`).
    pub(super) fn parse(
        text: &'a str,
        file: &'a str,
        settings: &'a [String],
    ) -> Result<Self, Error> {
        let broken = |e: &toml::de::Error| Error::SceneFile {
            file: file.to_owned(),
            line: line_at(text, e.span().map_or(0, |span| span.start)),
            message: one_line(e.message().trim_end()),
        };
        let places = DeTable::parse(text).map_err(|e| broken(&e))?;
        let mut root: Table = toml::from_str(text).map_err(|e| broken(&e))?;
        for withdraws in [true, false] {
            for setting in settings {
                let applied = if withdraws {
                    withdraw_old_material(&mut root, setting, settings)
                } else {
                    apply(&mut root, setting)
                };
                applied.map_err(|message| Error::Setting {
                    setting: one_line(&abridge(setting)),
                    message: one_line(&message),
                })?;
            }
        }
        Ok(Self {
            text,
            file,
            settings,
            places,
            root,
        })
    }

    /// The values.
    pub(super) fn root(&self) -> &Table {
        &self.root
    }

    /// The error for a user: at the setting that brought the key in, or at its line in the file.
    pub(super) fn error(&self, fault: &Fault) -> Error {
        let path = steps(&fault.key);
        let related = |setting: &&String| {
            let setting_key = setting.split('=').next().unwrap_or_default().trim();
            let setting_path = steps(full_key(setting_key));
            setting_path
                .iter()
                .zip(&path)
                .all(|(a, b)| a == b || *a == EVERY)
                && !path.is_empty()
        };
        if let Some(setting) = self.settings.iter().rev().find(related) {
            return Error::Setting {
                setting: one_line(&abridge(setting)),
                message: one_line(&fault.message),
            };
        }
        Error::SceneFile {
            file: self.file.to_owned(),
            line: line_at(self.text, self.offset(&path)),
            message: one_line(&fault.message),
        }
    }

    /// Offset of the key in the file, or of the innermost table above it that the file has.
    fn offset(&self, path: &[&str]) -> usize {
        let Some((first, steps_below)) = path.split_first() else {
            return 0;
        };
        let Some((mut offset, mut value)) = entry(self.places.get_ref(), first) else {
            return 0;
        };
        for step in steps_below {
            let child = match value {
                DeValue::Table(table) => entry(table, step),
                DeValue::Array(array) => step
                    .parse::<usize>()
                    .ok()
                    .and_then(|i| array.get(i))
                    .map(|item| (item.span().start, item.get_ref())),
                _ => None,
            };
            let Some(inner) = child else { break };
            (offset, value) = inner;
        }
        offset
    }
}

/// Returns an entry of a table with the offset of its key.
fn entry<'t, 'a>(table: &'t DeTable<'a>, name: &str) -> Option<(usize, &'t DeValue<'a>)> {
    let (key, value) = table.iter().find(|(key, _)| key.get_ref() == name)?;
    Some((key.span().start, value.get_ref()))
}

/// Replaces line breaks by spaces: an error is one sentence.
fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// Line of a byte of the text, from 1.
fn line_at(text: &str, offset: usize) -> usize {
    1 + text.bytes().take(offset).filter(|&b| b == b'\n').count()
}

/// The steps of a key: `body2.coatings[0].E` and `body2.coatings.0.E` have the same four.
pub(super) fn steps(key: &str) -> Vec<&str> {
    key.split(['.', '[', ']'])
        .map(str::trim)
        .filter(|step| !step.is_empty())
        .collect()
}

/// Stands in a key for every element of a list.
const EVERY: &str = "*";

/// Applies `key=value` to the values; the message describes the fault.
pub(super) fn apply(root: &mut Table, setting: &str) -> Result<(), String> {
    let (key, value) = setting
        .split_once('=')
        .ok_or("a setting must be of the form key=value")?;
    set_every(root, &steps(full_key(key)), &parse_value(value.trim())?)
}

/// The key of a material, and the numbers beside it that belong to the material. A number stands in
/// place of the number of the table of materials, so that a new material needs the old numbers out.
const MATERIAL: &str = "material";
const NUMBERS_OF_MATERIAL: [&str; 2] = ["E", "nu"];
const YIELDING: &str = "plastic";

/// Removes the numbers of the old material where a setting names another one. The other settings are
/// applied afterwards, so that a modulus set in the same call stays.
///
/// # Errors
///
/// The old material yields, and no setting has the yield stress of the new one.
fn withdraw_old_material(
    root: &mut Table,
    setting: &str,
    settings: &[String],
) -> Result<(), String> {
    let key = |setting: &'_ str| {
        setting
            .split_once('=')
            .map_or("", |(key, _)| key)
            .to_owned()
    };
    let material = key(setting);
    let path = steps(&material);
    let Some((&MATERIAL, body)) = path.split_last() else {
        return Ok(());
    };
    let matches = |a: &str, b: &str| a == b || a == EVERY || b == EVERY;
    let yields_anew = settings.iter().any(|other| {
        let key = key(other);
        let steps = steps(&key);
        steps.get(body.len()) == Some(&YIELDING)
            && steps.iter().zip(body).all(|(a, b)| matches(a, b))
    });
    let mut stays = None;
    for_tables(root, body, &mut |table| {
        for number in NUMBERS_OF_MATERIAL {
            table.remove(number);
        }
        if yields_anew {
            table.remove(YIELDING);
        } else if let Some(law) = table.get(YIELDING) {
            stays = Some(law.to_string());
        }
    });
    match stays {
        Some(law) => Err(format!(
            "the old material yields by plastic = {law}: set {}.plastic.s_y of the new one as well",
            body.join(".")
        )),
        None => Ok(()),
    }
}

/// Calls a function for the tables at a key, or of every element of the list before a star; for none
/// where the key leads to no table.
fn for_tables(table: &mut Table, path: &[&str], change: &mut impl FnMut(&mut Table)) {
    /// Calls `change` for the tables below a value at the remaining steps of a key: for [`EVERY`] element of a
    /// list, or for the one of an index.
    fn descend(value: &mut Value, path: &[&str], change: &mut impl FnMut(&mut Table)) {
        match (value, path) {
            (Value::Table(table), path) => for_tables(table, path, change),
            (Value::Array(array), [step, steps @ ..]) => {
                let index = step.parse::<usize>();
                for (n, item) in array.iter_mut().enumerate() {
                    if *step == EVERY || index.as_ref() == Ok(&n) {
                        descend(item, steps, change);
                    }
                }
            }
            _ => {}
        }
    }
    match path {
        [] => change(table),
        [step, steps @ ..] => {
            if let Some(value) = table.get_mut(*step) {
                descend(value, steps, change);
            }
        }
    }
}

/// Sets the value at a key, or at every element of the list before a star.
fn set_every(root: &mut Table, path: &[&str], value: &Value) -> Result<(), String> {
    let Some(star) = path.iter().position(|&step| step == EVERY) else {
        return set_value(root, path, value.clone());
    };
    let list = path[..star].join(".");
    let list_value = path[..star].split_first().and_then(|(first, inner_steps)| {
        inner_steps
            .iter()
            .try_fold(root.get(*first)?, |node, step| match node {
                Value::Array(array) => array.get(step.parse::<usize>().ok()?),
                table => table.get(step),
            })
    });
    let Some(Value::Array(array)) = list_value else {
        return Err(format!("{list} is no list: * stands for its elements"));
    };
    for n in 0..array.len() {
        let index = n.to_string();
        let mut element_path = path.to_vec();
        element_path[star] = &index;
        set_every(root, &element_path, value)?;
    }
    Ok(())
}

/// Sets the value at a key, and makes the tables on the way to it.
fn set_value(root: &mut Table, path: &[&str], value: Value) -> Result<(), String> {
    let (last, parents) = path.split_last().ok_or("the key is empty")?;
    let Some((first, parents)) = parents.split_first() else {
        root.insert((*last).to_owned(), value);
        return Ok(());
    };
    let mut node = table_entry(root, first, parents.first().unwrap_or(last));
    let mut key_so_far = (*first).to_owned();
    for (i, step) in parents.iter().enumerate() {
        let next_step = parents.get(i + 1).unwrap_or(last);
        node = match node {
            Value::Array(array) => element(array, step, &key_so_far)?,
            table => table_entry(as_table(table), step, next_step),
        };
        key_so_far = format!("{key_so_far}.{step}");
    }
    match node {
        Value::Array(array) => *element(array, last, &key_so_far)? = value,
        table => {
            let table = as_table(table);
            if measure::is_measure(last) {
                table.clear();
            }
            table.insert((*last).to_owned(), value);
        }
    }
    Ok(())
}

/// Returns the entry `name` of a table, and creates it where it is missing.
fn table_entry<'t>(table: &'t mut Table, name: &str, next: &str) -> &'t mut Value {
    let missing = if next.parse::<usize>().is_ok() {
        Value::Array(Vec::new())
    } else {
        Value::Table(Table::new())
    };
    table.entry(name.to_owned()).or_insert(missing)
}

/// Makes the value a table, in place of a plain number, and returns it.
fn as_table(value: &mut Value) -> &mut Table {
    if !value.is_table() {
        *value = Value::Table(Table::new());
    }
    match value {
        Value::Table(table) => table,
        _ => unreachable!("made a table above"),
    }
}

/// The element of a list that a step of a key names by its index; the error gives the number of elements.
fn element<'t>(array: &'t mut [Value], step: &str, key: &str) -> Result<&'t mut Value, String> {
    let count = array.len();
    step.parse::<usize>()
        .ok()
        .and_then(|i| array.get_mut(i))
        .ok_or_else(|| format!("{key} has {count} entries, counted from 0, and none is `{step}`"))
}

/// A TOML value; a bare word is a string, and so is a number with its unit.
pub(super) fn parse_value(text: &str) -> Result<Value, String> {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match toml::from_str::<Table>(&format!("value = {text}")) {
        Ok(mut table) if table.len() == 1 => table.remove("value").ok_or_else(String::new),
        _ if measure::has_unit(text) || (!text.is_empty() && text.chars().all(bare)) => {
            Ok(Value::String(text.to_owned()))
        }
        _ => Err(format!("`{}` is not a TOML value", abridge(text))),
    }
}
